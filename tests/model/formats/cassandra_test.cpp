#include "quoll/model/formats/cassandra.hpp"

#include <gtest/gtest.h>

#include "../../refusal.hpp"
#include "quoll/model/digest.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

Mdp model(std::string_view text) {
  auto mdp = parse_model(text, "m.pomdp");
  EXPECT_TRUE(mdp) << message(mdp.error());
  return *std::move(mdp);
}

std::string refusal(std::string_view text) {
  return tests::refusal_of(parse_model(text, "m.pomdp"));
}

// The outcomes of a choice: "next probability reward".
std::string outcomes(const Mdp& mdp, std::uint64_t c) {
  std::string text;
  for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
    text += (text.empty() ? "" : ", ") + mdp.state_name(mdp.next(o)) + " " +
            std::to_string(mdp.probability(o)).substr(0, 5) + " " +
            std::to_string(mdp.reward(c, o)).substr(0, 5);
  }
  return text;
}

const std::string head = "discount: 0.95\nvalues: reward\nstates: a b c\nactions: x y\n";
const std::string seen = head + "observations: dark light\n";

TEST(Cassandra, MatricesRowsAndEntries) {
  const Mdp mdp = model(head +
                        "T: x\nidentity\nT: y uniform\n"
                        "T: x : a 0.5 0.25 0.25   # a row over the identity\n"
                        "T:y:b:a 1.0\nT:y:b:b 0\nT:y:b:2 0.0\n"
                        "R: * : * : * 2\nR: x : a : b -1.5\nR: y : c 1 2 3\n");
  EXPECT_EQ(mdp.states(), 3u);
  EXPECT_EQ(outcomes(mdp, 0), "a 0.500 2.000, b 0.250 -1.50, c 0.250 2.000");
  EXPECT_EQ(outcomes(mdp, 1), "a 0.333 2.000, b 0.333 2.000, c 0.333 2.000");
  EXPECT_EQ(outcomes(mdp, 2), "b 1.000 2.000");
  EXPECT_EQ(outcomes(mdp, 3), "a 1.000 2.000");
  EXPECT_EQ(outcomes(mdp, 5), "a 0.333 1.000, b 0.333 2.000, c 0.333 3.000");
  EXPECT_EQ(mdp.discount(), 0.95);
  EXPECT_EQ(mdp.start().size(), 3u);
}

TEST(Cassandra, LaterLinesOverrideEarlierOnes) {
  const std::string rest = "T: y identity\n";
  // A wildcard after an entry wins, and an entry after that again.
  EXPECT_EQ(outcomes(model(head + rest +
                           "T: x : a : a 1\nT: * : * : * 0\nT: x : * : b 1\nT: y identity\n"),
                     0),
            "b 1.000 0.000");
  EXPECT_EQ(outcomes(model(head + rest + "T: x : a : c 1\nT: x identity\n"), 0), "a 1.000 0.000");
  EXPECT_EQ(outcomes(model(head + rest + "T: x identity\nT: x : a : c 1\nT: x : a : a 0\n"), 0),
            "c 1.000 0.000");
  EXPECT_EQ(outcomes(model(head + rest + "T: x identity\nR: x : a : a 5\nR: * : a : * 3\n"), 0),
            "a 1.000 3.000");
  EXPECT_EQ(outcomes(model(head + rest +
                           "T: x 0 1 0  0 1 0  0.5 0 0.5\nT: * : a : * 0\n"
                           "T: * : a : c 1.0\n"),
                     0),
            "c 1.000 0.000");
}

// After x in a or b one sees dark with probability 0.9 or 0.2; the reward for light is 10, for dark
// -1 unless it is known otherwise: 0.9 * -1 + 0.1 * 10 = 0.1 and 0.2 * -1 + 0.8 * 10 = 7.8.
TEST(Cassandra, RewardsAreExpectationsOverObservations) {
  const Mdp mdp = model(seen +
                        "T: * uniform\nO: x\n0.9 0.1\n0.2 0.8\n0.5 0.5\nO: y uniform\n"
                        "R: x : a : * : * -1\nR: x : a : * : light 10\n"
                        "R: x : b : a 4 14\n"
                        "R: y : b\n1 3  5 7  9 11\n"
                        "R: y : c : * : dark 8\nR: y : c : * : * 2\n");
  EXPECT_EQ(outcomes(mdp, 0), "a 0.333 0.100, b 0.333 7.800, c 0.333 4.500");
  EXPECT_EQ(outcomes(mdp, 2), "a 0.333 5.000, b 0.333 0.000, c 0.333 0.000");
  EXPECT_EQ(outcomes(mdp, 3), "a 0.333 2.000, b 0.333 6.000, c 0.333 10.00");
  EXPECT_EQ(outcomes(mdp, 5), "a 0.333 2.000, b 0.333 2.000, c 0.333 2.000");
  const auto arrays = parse_model_arrays(seen + "T: * uniform\n", "m.pomdp");
  ASSERT_TRUE(arrays);
  EXPECT_EQ(arrays->remarks, std::vector<std::string>{
                                 "2 observations (dark, light): read as if the state were seen, "
                                 "they are not kept"});
}

TEST(Cassandra, CostsAreNegativeRewards) {
  const Mdp mdp = model(
      "discount: 1.0 values: cost states: 2 actions: 1 start: 1\n"
      "T: 0 identity R: 0 : * : * 3\n");
  EXPECT_EQ(mdp.reward(0), -3.0);
  EXPECT_EQ(mdp.state_name(1), "1");
  ASSERT_EQ(mdp.start().size(), 1u);
  EXPECT_EQ(mdp.start()[0], 1u);
}

TEST(Cassandra, FormsOfTheStart) {
  const auto starts = [](const std::string& line) {
    const Mdp mdp = model(head + line + "\nT: * identity\n");
    std::string text;
    for (std::size_t i = 0; i < mdp.start().size(); ++i) {
      text += mdp.state_name(mdp.start()[i]) + " " +
              std::to_string(mdp.start_probability(i)).substr(0, 5) + " ";
    }
    return text;
  };
  EXPECT_EQ(starts("start: uniform"), "a 0.333 b 0.333 c 0.333 ");
  EXPECT_EQ(starts("start: b"), "b 1.000 ");
  EXPECT_EQ(starts("start: 2"), "c 1.000 ");
  EXPECT_EQ(starts("start: 0.25 0 0.75"), "a 0.250 c 0.750 ");
  EXPECT_EQ(starts("start: 0 1 0"), "b 1.000 ");
  EXPECT_EQ(starts("start include: c a"), "a 0.500 c 0.500 ");
  EXPECT_EQ(starts("start exclude: 0"), "b 0.500 c 0.500 ");
  EXPECT_EQ(starts("start: 0.333333 0.333333 0.333333"), "a 0.333 b 0.333 c 0.333 ");
}

TEST(Cassandra, RowsWithFewDigitsAreRescaled) {
  const auto arrays = parse_model_arrays(head + "T: * : * 0.333333 0.333333 0.333333\n", "m.mdp");
  ASSERT_TRUE(arrays);
  EXPECT_EQ(arrays->remarks,
            std::vector<std::string>{"6 rows of probabilities rescaled, whose sum is 1 only within "
                                     "1e-5"});
  const auto mdp = Mdp::make(*arrays);
  ASSERT_TRUE(mdp);
  EXPECT_EQ(mdp->probability(0), 0.333333 / (0.333333 + 0.333333 + 0.333333));
  EXPECT_EQ(refusal(head + "T: * identity\nT: x : b 0.5 0.4999 0\n"),
            "m.pomdp:6: state b, action x: probabilities sum to 0.9999, expected 1");
}

TEST(Cassandra, FaultsArePlaced) {
  EXPECT_EQ(refusal(""), "m.pomdp: expected discount, states and actions");
  EXPECT_EQ(refusal("discount 0.9"), "m.pomdp:1:10: expected ':', found '0.9'");
  EXPECT_EQ(refusal("discuont: 0.9").substr(0, 13), "m.pomdp:1:1: ");
  EXPECT_TRUE(refusal("discuont: 0.9").ends_with("found 'discuont'; did you mean 'discount'?"));
  EXPECT_EQ(refusal(head + "T: z identity"), "m.pomdp:5:4: expected an action or *, found 'z'");
  EXPECT_EQ(refusal(head + "T: x : a 0.5 0.5\n"),
            "m.pomdp:6:1: expected 3 numbers from line 5 on, found 2");
  EXPECT_EQ(refusal(head + "T: x : a : b : c 1"), "m.pomdp:5:14: expected a number, found ':'");
  EXPECT_EQ(refusal(head + "T: x identity"), "m.pomdp: state a, action y: no outcome");
  EXPECT_EQ(refusal(head + "T: * identity\nT: x : a : a nan"),
            "m.pomdp:6: state a, action x: probability nan is outside [0, 1]");
  EXPECT_EQ(refusal(head + "T: * identity\nT: x : a : a -1\nT: x : a : b 2"),
            "m.pomdp:7: state a, action x: probability -1 is outside [0, 1]");
  EXPECT_EQ(refusal(head + "O: x uniform"),
            "m.pomdp:5:4: expected observations to be declared before O");
  EXPECT_EQ(refusal("discount: 0.9 states: 1099511627776 actions: 1"),
            "m.pomdp:1:23: expected a count from 1 to 2147483647, found '1099511627776'");
  EXPECT_EQ(refusal("discount: 0.9 states: 2000000000 actions: 1 T: * uniform"),
            "m.pomdp: expected fewer states, actions and outcomes by wildcards in a file of this "
            "size");
  EXPECT_EQ(refusal("discount: 0.9 states: 200000 actions: 1 T: * uniform"),
            "m.pomdp: expected fewer states, actions and outcomes by wildcards in a file of this "
            "size");
}

TEST(Cassandra, ReadsBackWhatItWrites) {
  for (const char* path : {"m.mdp", "m.pomdp"}) {
    const Mdp mdp = model(
        "discount: 0.9 values: reward states: hall cave-1 actions: go stay\n"
        "start: 0.25 0.75\nT: go 0.3 0.7 0.1 0.9 T: stay identity\n"
        "R: go : hall : hall 5 R: go : hall : cave-1 -1e-3 R: stay : * : * 1\n");
    const auto format = format_of(path);
    ASSERT_TRUE(format);
    const auto written = (*format)->write(mdp);
    ASSERT_TRUE(written) << message(written.error());
    const auto read = parse_model(*written, path);
    ASSERT_TRUE(read) << message(read.error()) << *written;
    EXPECT_EQ(digest(*read), digest(mdp)) << *written;
  }
}

// B cannot go on: there "on" does what "off" does, and C stays where it is.
TEST(Cassandra, EveryStateGetsEveryAction) {
  const auto some = parse_model(
      "discount = 0.5\n[states.A]\non = { to = \"B\", reward = 2 }\noff = \"C\"\n"
      "[states.B]\noff = { to = \"A\", reward = 3 }\n[states.C]\n",
      "m.toml");
  ASSERT_TRUE(some) << message(some.error());
  const auto written = write_cassandra_mdp(*some);
  ASSERT_TRUE(written);
  const Mdp read = model(*written);
  ASSERT_EQ(read.choices(), 6u);
  EXPECT_EQ(outcomes(read, 0), "B 1.000 2.000");
  EXPECT_EQ(outcomes(read, 1), "C 1.000 0.000");
  EXPECT_EQ(outcomes(read, 2), "A 1.000 3.000");
  EXPECT_EQ(outcomes(read, 3), "A 1.000 3.000");
  EXPECT_EQ(outcomes(read, 5), "C 1.000 0.000");
}

TEST(Cassandra, TwoPlayersAreRefused) {
  MdpArrays arrays;
  arrays.choice_begin = {0, 1};
  arrays.next = {0};
  arrays.reward = {1};
  arrays.action = {0};
  arrays.discount = 0.5;
  arrays.alternating = true;
  arrays.state_names.push_back("s");
  arrays.action_names.push_back("a");
  const auto mdp = Mdp::make(arrays);
  ASSERT_TRUE(mdp);
  EXPECT_EQ(write_cassandra_mdp(*mdp).error().expected,
            "this format holds no model of two players");
}

}  // namespace
}  // namespace quoll
