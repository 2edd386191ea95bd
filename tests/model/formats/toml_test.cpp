#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "quoll/base/file.hpp"
#include "quoll/base/random.hpp"
#include "quoll/model/builder.hpp"
#include "quoll/model/check.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/toml_text.hpp"

namespace quoll {
namespace {

Result<Mdp> parsed(std::string_view text) {
  return parse_model(text, "w.toml");
}

std::string refusal(std::string_view text) {
  const auto mdp = parsed(text);
  return mdp ? "accepted" : message(mdp.error());
}

TEST(Toml, ReadsTheAdventure) {
  const auto mdp = read_model(QUOLL_SOURCE "/worlds/adventure.toml");
  ASSERT_TRUE(mdp) << message(mdp.error());
  // Counted in the file: GATE 1, HALL 2, POOL 4, CAVE 3, WELL 2, GOAL 0.
  EXPECT_EQ(mdp->states(), 6u);
  EXPECT_EQ(mdp->choices(), 12u);
  EXPECT_TRUE(mdp->deterministic());
  EXPECT_EQ(mdp->discount(), 0.8);
  const char* names[] = {"GATE", "HALL", "POOL", "CAVE", "WELL", "GOAL"};
  const Action actions[] = {1, 2, 4, 3, 2, 0};
  for (State s = 0; s < 6; ++s) {
    EXPECT_EQ(mdp->state_name(s), names[s]);
    EXPECT_EQ(mdp->actions(s), actions[s]);
  }
  EXPECT_EQ(mdp->start().size(), 5u);
  EXPECT_EQ(mdp->start_probability(0), 0.2);
  const std::uint64_t to_goal = mdp->choice_begin(3);
  EXPECT_EQ(mdp->action_name(to_goal), "To-GOAL");
  EXPECT_EQ(mdp->reward(to_goal), 100.0);
  EXPECT_EQ(mdp->next(to_goal), 5u);
  EXPECT_EQ(mdp->reward_bounds(), std::pair(0.0, 100.0));
  EXPECT_TRUE(check(*mdp).empty());
}

TEST(Toml, ReadsEveryFormOfAMove) {
  const auto mdp = parsed(R"(
reward = -1
discount = 0.5
[states.A]
plain = "B"
table = { to = "B", reward = 2 }
several = { to = { B = 0.25, A = 0.75 }, reward = 3 }
list = [ { to = "A", probability = 0.5 }, { to = "B", probability = 0.5, reward = 7 } ]
one = [ { to = "A" } ]
[states.A.header]
to = "B"
[states.B]
)");
  ASSERT_TRUE(mdp) << message(mdp.error());
  ASSERT_EQ(mdp->choices(), 6u);
  const double rewards[] = {-1, 2, 3, 3, -1, -1};  // list: 0.5 * -1 + 0.5 * 7
  const char* names[] = {"plain", "table", "several", "list", "one", "header"};
  for (std::uint64_t c = 0; c < 6; ++c) {
    EXPECT_EQ(mdp->reward(c), rewards[c]) << c;
    EXPECT_EQ(mdp->action_name(c), names[c]);
  }
  EXPECT_EQ(mdp->outcome_end(2) - mdp->outcome_begin(2), 2u);
  EXPECT_EQ(mdp->next(2), 1u);
  EXPECT_EQ(mdp->probability(2), 0.25);
  EXPECT_EQ(mdp->reward(3, mdp->outcome_begin(3)), -1.0);
}

TEST(Toml, KeepsTheOrderOfTheFile) {
  const auto mdp = parsed("[states.Z]\nb = \"M\"\na = \"Z\"\n[states.M]\na = \"A\"\n[states.A]\n");
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_EQ(mdp->state_name(0), "Z");
  EXPECT_EQ(mdp->state_name(1), "M");
  EXPECT_EQ(mdp->state_name(2), "A");
  EXPECT_EQ(mdp->action_name(0), "b");
  EXPECT_EQ(mdp->action_name(1), "a");
  EXPECT_EQ(mdp->discount(), 1.0);
}

TEST(Toml, Starts) {
  const std::string states = "[states.A]\non = \"B\"\n[states.B]\non = \"C\"\n[states.C]\n";
  const auto uniform = parsed("start = \"uniform\"\n" + states);
  ASSERT_TRUE(uniform);
  EXPECT_EQ(uniform->start().size(), 2u);
  const auto one = parsed("start = \"B\"\n" + states);
  ASSERT_TRUE(one);
  EXPECT_EQ(one->start()[0], 1u);
  const auto list = parsed("start = [\"C\", \"A\"]\n" + states);
  ASSERT_TRUE(list);
  EXPECT_EQ(list->arrays().start, (std::vector<State>{0, 2}));
  const auto table = parsed("start = { B = 0.75, A = 0.25 }\n" + states);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->start_probability(0), 0.25);
  EXPECT_EQ(table->start_probability(1), 0.75);
  EXPECT_EQ(refusal("start = { B = 0.75 }\n" + states),
            "w.toml: start probabilities sum to 0.75, expected 1");
  EXPECT_EQ(refusal("start = \"D\"\n" + states), "w.toml:1:9: no state 'D'");
  EXPECT_EQ(refusal("start = [\"A\", \"A\"]\n" + states), "w.toml:1:15: state 'A' stands twice");
  EXPECT_EQ(refusal("start = []\n" + states), "w.toml:1:9: expected at least one start state");
}

TEST(Toml, DeclaredEnds) {
  const std::string states = "[states.A]\non = \"B\"\n[states.B]\non = \"A\"\n";
  for (const char* line : {"terminal = \"B\"\n", "terminal = [\"B\"]\n"}) {
    const auto mdp = parsed(line + states);
    ASSERT_TRUE(mdp) << message(mdp.error());
    EXPECT_TRUE(mdp->terminal(1));
    EXPECT_EQ(mdp->actions(1), 1u);
  }
}

TEST(Toml, ErrorsNameThePlaceAndTheNearestName) {
  EXPECT_EQ(refusal("[states.CAVE]\n[states.HALL]\nTo-CAVE = \"CAEV\"\n"),
            "w.toml:3:11: no state 'CAEV'; did you mean 'CAVE'?");
  EXPECT_EQ(refusal("dicount = 0.9\n[states.A]\n"),
            "w.toml:1:1: unknown key 'dicount', expected name, discount, alternating, start, "
            "terminal, reward, actions, labels or states; did you mean 'discount'?");
  EXPECT_EQ(refusal("[states.A]\ngo = { to = \"A\", rewrd = 1 }\n"),
            "w.toml:2:18: unknown key 'rewrd', expected to, probability or reward; "
            "did you mean 'reward'?");
  EXPECT_EQ(refusal("discount = \"high\"\n[states.A]\n"), "w.toml:1:12: expected a number");
  EXPECT_EQ(
      refusal("[states.A]\ngo = 3\n"),
      "w.toml:2:6: expected the next state in quotes, a table { to = \"STATE\", reward = R }, "
      "or a list of such tables with probabilities");
  EXPECT_EQ(refusal("[states.A]\ngo = { reward = 3 }\n"),
            "w.toml:2:6: expected 'to', the next state");
  EXPECT_EQ(refusal("[states.A]\ngo = [{ to = \"A\" }, { to = \"A\", probability = 1 }]\n"),
            "w.toml:2:7: expected 'probability', because there are several outcomes");
  EXPECT_EQ(refusal("[states]\nA = 3\n"), "w.toml:2:5: expected a table: action = \"NEXT STATE\"");
  EXPECT_EQ(refusal("discount = 0.5\n"), "w.toml:1:1: expected states, for example [states.HALL]");
  EXPECT_EQ(refusal("actions = 3\n[states.A]\n"), "w.toml:1:11: expected a list of action names");
}

TEST(Toml, SyntaxErrorsHaveAPlace) {
  for (const char* text : {"discount = \n", "[states.A\n", "[states.A]\n[states.A]\n", "\xff",
                           "[=]", "\xc3\xa4 = 1\n", "[\xd0\xb7 ALL]\n"}) {
    const auto mdp = parsed(text);
    ASSERT_FALSE(mdp) << text;
    EXPECT_GT(mdp.error().line, 0u) << text;
    EXPECT_FALSE(mdp.error().expected.empty());
  }
}

TEST(Toml, ValuesAreCheckedWithTheLineOfTheMove) {
  EXPECT_EQ(refusal("[states.A]\ngo = { to = \"A\", reward = nan }\n"),
            "w.toml:2: state A, action go: reward nan, expected a finite number");
  EXPECT_EQ(refusal("[states.A]\n\ngo = { to = { A = 0.9 } }\n"),
            "w.toml:3: state A, action go: probabilities sum to 0.9, expected 1");
  EXPECT_EQ(refusal("[states.A]\ngo = { to = \"A\", probability = 2 }\n"),
            "w.toml:2: state A, action go: probability 2 is outside [0, 1]");
  EXPECT_EQ(refusal("discount = 1.5\n[states.A]\ngo = \"A\"\n"),
            "w.toml: discount 1.5 is outside (0, 1]");
}

TEST(Toml, RemarksOnDuplicateMoves) {
  const auto arrays = read_toml(
      "[states.A]\ngo = [{ to = \"A\", probability = 0.5 }, { to = \"A\", probability = 0.5 }]\n"
      "try = [{ to = \"A\", probability = 0.5 }, { to = \"A\", probability = 0.5, reward = 1 }]\n",
      "w.toml");
  ASSERT_TRUE(arrays);
  EXPECT_EQ(arrays->remarks,
            std::vector<std::string>{"state A, action go: successor A stands twice"});
}

TEST(Toml, RefusesKeysThatWouldOverflowTheStack) {
  std::string key = "a";
  for (int i = 0; i < 100'000; ++i) key += ".a";
  EXPECT_EQ(refusal("\n" + key + " = 1\n"), "w.toml:2: a key of over 100 parts");
  EXPECT_EQ(refusal("[" + key + "]\n"), "w.toml:1: a key of over 100 parts");
  EXPECT_EQ(refusal("x = \"\"\"a\"b\"\"\"\n" + key + " = 1"), "w.toml:2: a key of over 100 parts");
  EXPECT_EQ(refusal("x = '''\\''' \n'#'." + key + " = 1"), "w.toml:2: a key of over 100 parts");
  EXPECT_EQ(refusal("x = {\"\\\"\"." + key + " = 1"), "w.toml:1: a key of over 100 parts");
  // Dots in comments, strings and numbers are no key.
  std::string numbers = "0.5";
  for (int i = 0; i < 200; ++i) numbers += ", 0.5";
  const std::string dots(200, '.');
  EXPECT_EQ(line_with_deep_key("# " + dots + "\nx = \"" + dots + "\"\ny = [" + numbers + "]"), 0u);
}

// The worlds printed in docs/worlds.md are read; its lines about starts are tried one by one.
TEST(Toml, TheExamplesOfTheManualAreTrue) {
  const auto page = read_file(QUOLL_SOURCE "/docs/worlds.md");
  ASSERT_TRUE(page);
  std::vector<std::string> blocks;
  const std::string open = "```toml\n";
  for (std::size_t at = page->find(open); at != std::string::npos; at = page->find(open, at)) {
    at += open.size();
    blocks.push_back(page->substr(at, page->find("```", at) - at));
  }
  ASSERT_EQ(blocks.size(), 3u);
  const auto home = parsed(blocks[0]);
  ASSERT_TRUE(home) << message(home.error());
  EXPECT_EQ(home->choices(), 3u);
  const auto pool = parsed(blocks[1]);
  ASSERT_TRUE(pool) << message(pool.error());
  EXPECT_EQ(pool->outcomes(), 6u);
  int lines = 0;
  for (std::size_t at = 0; at < blocks[2].size(); ++lines) {
    const std::size_t end = blocks[2].find('\n', at);
    const auto mdp = parsed(blocks[2].substr(at, end - at) +
                            "\n[states.HALL]\non = \"GATE\"\n[states.GATE]\non = \"GATE\"\n");
    EXPECT_TRUE(mdp) << message(mdp.error());
    at = end + 1;
  }
  EXPECT_EQ(lines, 4);
}

// Damaged files: any answer but a crash (run under sanitizers), and valid models stay valid.
TEST(Toml, DamagedFilesAreAnsweredCalmly) {
  const auto file = read_file(QUOLL_SOURCE "/worlds/adventure.toml");
  ASSERT_TRUE(file);
  Rng rng = stream(11, "toml");
  int accepted = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::string text = *file;
    for (std::uint32_t i = 0; i < 1 + rng.below(3); ++i) {
      const std::size_t at = rng.below(static_cast<std::uint32_t>(text.size()));
      constexpr std::string_view letters = "[]{}=\",.#'\n\\0A-\xff";
      if (rng.below(2)) {
        text[at] = letters[rng.below(static_cast<std::uint32_t>(letters.size()))];
      } else {
        text.erase(at, 1 + rng.below(20));
      }
    }
    const auto mdp = parsed(text);
    if (!mdp) {
      ASSERT_FALSE(message(mdp.error()).empty());
      ASSERT_EQ(message(mdp.error()).find('\n'), std::string::npos) << message(mdp.error());
      continue;
    }
    ++accepted;
    ASSERT_TRUE(write_toml(*mdp));
  }
  EXPECT_GT(accepted, 100);
  EXPECT_LT(accepted, 900);
}

void expect_equal(const Mdp& a, const Mdp& b) {
  const MdpArrays& x = a.arrays();
  const MdpArrays& y = b.arrays();
  EXPECT_EQ(x.choice_begin, y.choice_begin);
  EXPECT_EQ(x.outcome_begin, y.outcome_begin);
  EXPECT_EQ(x.next, y.next);
  EXPECT_EQ(x.probability, y.probability);
  EXPECT_EQ(x.reward, y.reward);
  EXPECT_EQ(x.outcome_reward, y.outcome_reward);
  EXPECT_EQ(x.action, y.action);
  EXPECT_EQ(x.start, y.start);
  EXPECT_EQ(x.start_probability, y.start_probability);
  EXPECT_EQ(x.terminal, y.terminal);
  EXPECT_EQ(x.discount, y.discount);
  ASSERT_EQ(x.state_names.size(), y.state_names.size());
  for (std::uint64_t i = 0; i < x.state_names.size(); ++i) {
    EXPECT_EQ(x.state_names[i], y.state_names[i]);
  }
  ASSERT_EQ(x.action_names.size(), y.action_names.size());
  for (std::uint64_t i = 0; i < x.action_names.size(); ++i) {
    EXPECT_EQ(x.action_names[i], y.action_names[i]);
  }
}

void expect_round_trip(const Mdp& mdp) {
  const auto text = write_toml(mdp);
  ASSERT_TRUE(text);
  const auto back = parsed(*text);
  ASSERT_TRUE(back) << message(back.error()) << "\n" << *text;
  expect_equal(mdp, *back);
}

TEST(Toml, RoundTripOfTheAdventure) {
  const auto mdp = read_model(QUOLL_SOURCE "/worlds/adventure.toml");
  ASSERT_TRUE(mdp);
  expect_round_trip(*mdp);
}

TEST(Toml, RoundTripOfOddNames) {
  MdpBuilder builder(0.1 + 0.2);
  builder.action("never used");
  builder.move("a b", "#", "\"quoted\"", 1e300).move("uniform", "x.y", "'", -0.0);
  builder.move("[a]\\", "=", "\xc3\xa4", 123456789012345680.0).move("1", "2", "3", 5e-324);
  builder.start("uniform").terminal("3").terminal("a b");
  const auto mdp = builder.build();
  ASSERT_TRUE(mdp) << message(mdp.error());
  expect_round_trip(*mdp);
  const auto back = parsed(*write_toml(*mdp));
  EXPECT_FALSE(std::signbit(back->reward(1)));  // a model has one zero
}

TEST(Toml, RefusesNamesThatAreNone) {
  EXPECT_EQ(refusal("[states.A]\n\"g\\to\" = \"A\"\n"),
            "w.toml:2:1: expected a name without control characters");
  EXPECT_EQ(refusal("[states.\"\\u001b[31m\"]\ngo = \"A\"\n"),
            "w.toml:1:9: expected a name without control characters");
  EXPECT_EQ(refusal("[states.\"\"]\n"), "w.toml:1:9: expected a name that is not empty");
  EXPECT_EQ(refusal("actions = [\"\"]\n[states.A]\ngo = \"A\"\n"),
            "w.toml:1:12: expected a name that is not empty");
  const auto mdp = MdpBuilder(0.5).move("A\n", "go", "B").build();
  ASSERT_TRUE(mdp);
  const auto text = write_toml(*mdp);
  ASSERT_FALSE(text);
  EXPECT_EQ(message(text.error()), "name of state 0: expected a name without control characters");
}

TEST(Toml, SyntaxErrorsSayWhatToDo) {
  EXPECT_EQ(refusal("[states.A]\ngo = \"A\n")
                .find("w.toml:2:8: expected TOML: a closing quotation mark on the same line ("),
            0u);
  EXPECT_EQ(
      refusal("[states.A]\n[states.A]\n").find("w.toml:2:1: expected TOML: every name once ("), 0u);
  EXPECT_EQ(refusal("discount 3\n").find("w.toml:1:"), 0u);
  EXPECT_NE(refusal("discount 3\n").find("expected TOML: KEY = VALUE or [TABLE] ("),
            std::string::npos)
      << refusal("discount 3\n");
}

TEST(Toml, RoundTripOfRandomModels) {
  Rng rng = stream(7, "toml");
  for (int trial = 0; trial < 300; ++trial) {
    MdpBuilder builder(rng.uniform() * 0.5 + 0.25);
    const std::uint32_t states = 1 + rng.below(6);
    for (State s = 0; s < states; ++s) builder.state("s" + std::to_string(s));
    for (std::uint32_t a = 0; a < 3; ++a) builder.action("a" + std::to_string(a));
    builder.move(0, rng.below(3), rng.below(states), 0.0, 1.0);
    for (State s = 1; s < states; ++s) {
      for (std::uint32_t a = 0; a < rng.below(4); ++a) {
        const double p = rng.uniform();
        const double reward = rng.uniform() * 10 - 5;
        builder.move(s, a, rng.below(states), reward, p);
        builder.move(s, a, rng.below(states), rng.below(2) ? reward : rng.uniform(), 1.0 - p);
      }
    }
    if (rng.below(2)) {
      builder.start("s0", rng.uniform() + 0.1);
      if (states > 1) builder.start("s1", rng.uniform() + 0.1);
    }
    const auto mdp = builder.build();
    ASSERT_TRUE(mdp) << message(mdp.error());
    expect_round_trip(*mdp);
  }
}

TEST(Toml, NumbersKeepTheirBits) {
  EXPECT_EQ(toml_number(100.0), "100");
  EXPECT_EQ(toml_number(-0.0), "-0.0");
  EXPECT_EQ(toml_number(0.1), "0.1");
  EXPECT_EQ(toml_number(1e30), "1e+30");
  EXPECT_EQ(toml_number(12345678901234567890.0).find_first_of(".e") != std::string::npos, true);
  EXPECT_EQ(toml_key("To-CAVE"), "To-CAVE");
  EXPECT_EQ(toml_key("a.b"), "\"a.b\"");
  EXPECT_EQ(toml_key(""), "\"\"");
}

}  // namespace
}  // namespace quoll
