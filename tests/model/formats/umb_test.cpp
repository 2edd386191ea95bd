#include "quoll/model/formats/umb.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <map>

#include "../../refusal.hpp"
#include "quoll/base/bytes.hpp"
#include "quoll/model/digest.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/tar.hpp"

namespace quoll {
namespace {

using Parts = std::map<std::string, std::string>;

template <class T>
std::string bytes(std::initializer_list<T> numbers) {
  std::string out;
  for (const T number : numbers) append_little(out, number);
  return out;
}
std::string words(std::initializer_list<std::uint64_t> numbers) {
  return bytes<std::uint64_t>(numbers);
}
std::string doubles(std::initializer_list<double> numbers) {
  std::string out;
  for (const double number : numbers) append_little(out, std::bit_cast<std::uint64_t>(number));
  return out;
}

std::string archive(const Parts& parts) {
  std::string out;
  for (const auto& [name, content] : parts) {
    out +=
        tar_head(name, content.size()) + content + std::string(tar_padding(content.size()), '\0');
  }
  return out + tar_end();
}

std::string index(const std::string& more = "", const std::string& states = "3",
                  const std::string& probability = "\"type\":\"double\"") {
  return R"({"format-version":1,"format-revision":0,"transition-system":{"time":"discrete",)"
         R"("#players":1,"#states":)" +
         states +
         R"(,"#initial-states":1,"#choices":3,"#choice-actions":2,"#branches":4,)"
         R"("#branch-actions":0,"#observations":0,"branch-probability-type":{)" +
         probability + "}}" + more + "}";
}

// Three states: 0 goes by "up" to 1 or 2, half each, and by "down" to 2; 1 stays by "up"; 2 is an
// end.
Parts small() {
  return {{"index.json", index()},
          {"state-to-choices.bin", words({0, 2, 3, 3})},
          {"choice-to-branches.bin", words({0, 2, 3, 4})},
          {"branch-to-target.bin", words({1, 2, 2, 1})},
          {"branch-to-probability.bin", doubles({0.5, 0.5, 1, 1})},
          {"state-is-initial.bin", words({1})},
          {"actions/choices/values.bin", bytes<std::uint32_t>({0, 1, 0})},
          {"actions/choices/string-mapping.bin", words({0, 2, 6})},
          {"actions/choices/strings.bin", "updown"}};
}

Parts with(Parts parts, const std::string& name, std::string content) {
  parts[name] = std::move(content);
  return parts;
}

Mdp model(const Parts& parts) {
  auto mdp = parse_model(archive(parts), "small.umb");
  EXPECT_TRUE(mdp) << message(mdp.error());
  return *std::move(mdp);
}

std::string refusal(const Parts& parts) {
  return tests::refusal_of(parse_model(archive(parts), "m.umb"));
}

TEST(Umb, ArraysBecomeTheModel) {
  const Mdp mdp = model(small());
  EXPECT_EQ(mdp.states(), 3u);
  EXPECT_EQ(mdp.choices(), 3u);
  EXPECT_EQ(mdp.outcomes(), 4u);
  EXPECT_EQ(mdp.action_name(1), "down");
  EXPECT_EQ(mdp.next(1), 2u);
  EXPECT_EQ(mdp.probability(0), 0.5);
  EXPECT_EQ(mdp.reward(0), 0.0);
  EXPECT_TRUE(mdp.terminal(2));
  EXPECT_FALSE(mdp.terminal(1));
  ASSERT_EQ(mdp.start().size(), 1u);
  EXPECT_EQ(mdp.start()[0], 0u);
  EXPECT_EQ(mdp.discount(), 1.0);
  EXPECT_EQ(mdp.state_name(2), "2");
}

TEST(Umb, RewardsOfStatesChoicesAndBranchesAddUp) {
  Parts parts = small();
  parts["index.json"] =
      index(R"(,"annotations":{"rewards":{"cost":{"alias":"Cost","applies-to":["states","choices",)"
            R"("branches"],"type":{"type":"double"}},"r":{"applies-to":["choices"],)"
            R"("type":{"type":"rational"}}},"aps":{"goal":{"applies-to":["states"],)"
            R"("type":{"type":"bool"}},"a":{"alias":"any","applies-to":["states"],)"
            R"("type":{"type":"bool"}}}})");
  parts["annotations/rewards/cost/states/values.bin"] = doubles({1, 10, 100});
  parts["annotations/rewards/cost/choices/values.bin"] = doubles({0.25, 0.5, 0});
  parts["annotations/rewards/cost/branches/values.bin"] = doubles({0, 2, 0, 0});
  // -3/4, 1/2, 0/1
  parts["annotations/rewards/r/choices/values.bin"] =
      words({static_cast<std::uint64_t>(-3), 4, 1, 2, 0, 1});
  parts["annotations/aps/goal/states/values.bin"] = words({4});
  parts["annotations/aps/a/states/values.bin"] = words({7});
  const Mdp mdp = model(parts);
  EXPECT_EQ(mdp.arrays().reward_name, "Cost");
  EXPECT_EQ(mdp.reward(0, 0), 1.25);
  EXPECT_EQ(mdp.reward(0, 1), 3.25);
  EXPECT_EQ(mdp.reward(0), 2.25);
  EXPECT_EQ(mdp.reward(1), 1.5);
  EXPECT_EQ(mdp.reward(2), 10.0);
  const RewardStructure* const other = mdp.find_rewards("r");
  ASSERT_NE(other, nullptr);
  EXPECT_EQ(other->reward, (std::vector<double>{-0.75, 0.5, 0.0}));
  ASSERT_EQ(mdp.arrays().labels.size(), 2u);
  EXPECT_EQ(mdp.arrays().labels[0].name, "any");
  EXPECT_EQ(mdp.find_label("goal")->states, std::vector<State>{2});
}

TEST(Umb, RationalProbabilities) {
  Parts parts = with(small(), "index.json", index("", "3", "\"type\":\"rational\",\"size\":128"));
  parts["branch-to-probability.bin"] = words({1, 4, 3, 4, 1, 1, 2, 2});
  const Mdp mdp = model(parts);
  EXPECT_EQ(mdp.probability(0), 0.25);
  EXPECT_EQ(mdp.probability(1), 0.75);
  EXPECT_EQ(mdp.probability(3), 1.0);
  parts["branch-to-probability.bin"] = words({1, 4, 3, 4, 1, 1, 2, 0});
  EXPECT_EQ(refusal(parts), "m.umb: branch-to-probability.bin: fraction 3 over 0");
}

// Per state one byte: x in 2 bits from -1 on, b in 1, an optional y of 2, padding.
TEST(Umb, ValuationsNameTheStates) {
  Parts parts = small();
  parts["index.json"] =
      index(R"(,"valuations":{"states":{"unique":true,"classes":[{"variables":[{"name":"x",)"
            R"("type":{"type":"uint","size":2},"offset":-1},{"name":"b","type":{"type":"bool"}},)"
            R"({"name":"y","is-optional":true,"type":{"type":"int","size":2}},{"padding":2}]}]}})");
  parts["valuations/states/valuations.bin"] = {'\x00', '\x07', '\x3a'};
  const Mdp mdp = model(parts);
  EXPECT_EQ(mdp.state_name(0), "(x=-1,b=false,y=none)");
  EXPECT_EQ(mdp.state_name(1), "(x=2,b=true,y=none)");
  EXPECT_EQ(mdp.state_name(2), "(x=1,b=false,y=-1)");
  // Two equal names: numbers instead, and a remark.
  parts["valuations/states/valuations.bin"] = {'\x00', '\x07', '\x07'};
  const auto arrays = parse_model_arrays(archive(parts), "m.umb");
  ASSERT_TRUE(arrays);
  EXPECT_EQ(arrays->state_names[2], "2");
  EXPECT_EQ(arrays->remarks, std::vector<std::string>{
                                 "states are numbered: state (x=2,b=true,y=none) stands twice"});
}

TEST(Umb, ChoicesWithOneActionAreToldApart) {
  Parts parts = with(small(), "actions/choices/values.bin", bytes<std::uint32_t>({1, 1, 1}));
  const auto arrays = parse_model_arrays(archive(parts), "m.umb");
  ASSERT_TRUE(arrays);
  EXPECT_EQ(arrays->action_names[arrays->action[0]], "down");
  EXPECT_EQ(arrays->action_names[arrays->action[1]], "down.1");
  EXPECT_EQ(arrays->action_names[arrays->action[2]], "down");
  ASSERT_EQ(arrays->remarks.size(), 1u);
  EXPECT_TRUE(Mdp::make(*arrays));
  parts.erase("actions/choices/string-mapping.bin");
  EXPECT_EQ(model(parts).action_name(0), "1");
}

TEST(Umb, DefaultsOfAbsentFiles) {
  // A chain 0 -> 1 -> 1: one choice per state, one branch per choice, no chance.
  const Parts parts{
      {"index.json", R"({"format-version":1,"transition-system":{"time":"discrete","#players":0,)"
                     R"("#states":2,"#initial-states":0,"#choices":2,"#choice-actions":0,)"
                     R"("#branches":2,"#branch-actions":0,"#observations":0}})"},
      {"branch-to-target.bin", words({1, 1})}};
  const Mdp mdp = model(parts);
  EXPECT_TRUE(mdp.deterministic());
  EXPECT_EQ(mdp.start().size(), 2u);
  EXPECT_EQ(mdp.action_name(1), "0");
}

TEST(Umb, FaultsAreNamedInOneLine) {
  EXPECT_EQ(refusal({}), "m.umb: expected a tar archive with index.json");
  EXPECT_EQ(refusal({{"index.json", "{"}}), "m.umb: index.json:1:2: a text in quotes expected");
  EXPECT_EQ(refusal({{"index.json", "{}"}}),
            "m.umb: index.json: format-version: a whole number expected");
  // 2^40 states
  EXPECT_EQ(refusal(with(small(), "index.json", index("", "1099511627776"))),
            "m.umb: index.json: transition-system.#states: a whole number from 0 to 2147483647 "
            "expected");
  EXPECT_EQ(refusal(with(small(), "index.json", index("", "2000000000"))),
            "m.umb: state-to-choices.bin: 16000000008 bytes expected, found 32");
  EXPECT_EQ(refusal(with(small(), "state-to-choices.bin", words({0, 3, 2, 3}))),
            "m.umb: state-to-choices.bin: numbers that ascend from 0 to 3 expected");
  EXPECT_EQ(refusal(with(small(), "branch-to-target.bin", words({1, 2, 3, 1}))),
            "m.umb: branch-to-target.bin: state 3 of 3");
  EXPECT_EQ(refusal(with(small(), "branch-to-target.bin", words({1, 2, 1ull << 32, 1}))),
            "m.umb: branch-to-target.bin: state 4294967296 of 3");
  EXPECT_EQ(refusal(with(small(), "branch-to-probability.bin", doubles({0.5, 0.4, 1, 1}))),
            "m.umb: state 0, action up: probabilities sum to 0.9, expected 1");
  EXPECT_EQ(refusal(with(small(), "branch-to-probability.bin", doubles({1.5, -0.5, 1, 1}))),
            "m.umb: state 0, action up: probability 1.5 is outside [0, 1]");
  EXPECT_EQ(refusal(with(small(), "branch-to-probability.bin",
                         doubles({std::numeric_limits<double>::quiet_NaN(), 0.5, 1, 1}))),
            "m.umb: state 0, action up: probability nan is outside [0, 1]");
  EXPECT_EQ(refusal(with(small(), "state-is-initial.bin", words({3}))),
            "m.umb: state-is-initial.bin: 1 state expected, found 2");
  EXPECT_EQ(refusal(with(small(), "state-is-initial.bin", words({9}))),
            "m.umb: state-is-initial.bin: zeros expected behind the last state's bit");
  EXPECT_EQ(refusal(with(small(), "actions/choices/values.bin", bytes<std::uint32_t>({0, 2, 0}))),
            "m.umb: actions/choices/values.bin: action 2 of 2");
  Parts missing = small();
  missing.erase("branch-to-probability.bin");
  EXPECT_EQ(refusal(missing), "m.umb: branch-to-probability.bin: missing");
  EXPECT_EQ(refusal(with(small(), "index.json", index("", "3", "\"type\":\"double-interval\""))),
            "m.umb: branch-to-probability.bin: type double, or rational of 128 bits, expected, "
            "found double-interval of 128");
}

TEST(Umb, ACutArchiveIsRefusedAtEveryLength) {
  const std::string whole = archive(small());
  // Before its last file: without that one every state has one choice, which fits, too.
  for (std::size_t size = 0; size + 8 < whole.find("state-is-initial.bin") + 512; size += 8) {
    EXPECT_FALSE(parse_model(whole.substr(0, size), "m.umb")) << size;
  }
  const std::size_t last = whole.find("state-to-choices.bin");
  for (std::size_t size = last + 8; size < last + 512 + 32; size += 8) {
    EXPECT_FALSE(parse_model(whole.substr(0, size), "m.umb")) << size;
  }
  EXPECT_TRUE(parse_model(whole.substr(0, last + 512 + 32), "m.umb"));
}

// Everything a model may hold comes back: names, labels, rewards, ends with choices, layout.
TEST(Umb, ReadsBackWhatItWrites) {
  MdpArrays arrays;
  arrays.choice_begin = {0, 2, 3, 4};
  arrays.outcome_begin = {0, 2, 3, 4, 6};
  arrays.next = {1, 2, 2, 1, 0, 2};
  arrays.probability = {1.0 / 3, 2.0 / 3, 1, 1, 0.1, 0.9};
  arrays.outcome_reward = {1, -2.5, 1e-300, 0, 7, 8};
  arrays.action = {0, 1, 0, 1};
  arrays.start = {0, 1};
  arrays.start_probability = {0.25, 0.75};
  arrays.terminal = {2};
  for (const char* name : {"HALL", "CAVE, \"deep\"", "Höhle"}) arrays.state_names.push_back(name);
  for (const char* name : {"up", "down"}) arrays.action_names.push_back(name);
  arrays.labels = {{"Goal 1", {2}}, {"goal_1", {0, 1, 2}}};
  arrays.reward_name = "money";
  arrays.other_rewards = {{"time", {1, 2, 3, 4}, {}}, {"Time", {}, {1, 2, 3, 4, 5, 6}}};
  arrays.discount = 0.93;
  arrays.alternating = true;
  Layout layout{2, 2, {0, 1, 3}, {{1, 0}, {0, -1}}, Layout::Frame{0.05, -1, 2.5, 0.1}};
  arrays.layout = layout;
  const auto mdp = Mdp::make(arrays);
  ASSERT_TRUE(mdp) << message(mdp.error());
  const auto written = write_umb(*mdp);
  ASSERT_TRUE(written) << message(written.error());
  const auto read = parse_model(*written, "m.umb");
  ASSERT_TRUE(read) << message(read.error());
  EXPECT_EQ(digest(*read), digest(*mdp));
  EXPECT_EQ(read->arrays().reward_name, "money");
  ASSERT_EQ(read->arrays().labels.size(), 2u);
  EXPECT_EQ(read->find_label("Goal 1")->states, std::vector<State>{2});
  EXPECT_EQ(read->find_label("goal_1")->states, (std::vector<State>{0, 1, 2}));
  ASSERT_EQ(read->arrays().other_rewards.size(), 2u);
  EXPECT_EQ(read->find_rewards("Time")->outcome_reward, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(read->find_rewards("time")->reward, (std::vector<double>{1, 2, 3, 4}));
  ASSERT_NE(read->layout(), nullptr);
  EXPECT_EQ(read->layout()->cell, layout.cell);
  EXPECT_EQ(read->layout()->direction, layout.direction);
  EXPECT_EQ(read->layout()->frame->y, 2.5);
  EXPECT_TRUE(read->arrays().remarks.empty());
  const auto again = write_umb(*read);
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, *written);
}

TEST(Umb, NamesByRuleAreNotStored) {
  const auto grid = parse_model("S.\n.G\n", "g.txt");
  ASSERT_TRUE(grid) << message(grid.error());
  const auto written = write_umb(*grid);
  ASSERT_TRUE(written);
  const auto read = parse_model(*written, "g.umb");
  ASSERT_TRUE(read) << message(read.error());
  EXPECT_EQ(digest(*read), digest(*grid));
  EXPECT_FALSE(read->arrays().state_names.is_stored());
}

}  // namespace
}  // namespace quoll
