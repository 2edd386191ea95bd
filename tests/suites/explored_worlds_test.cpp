// Worlds that are written twice, as a table and as code: going through the code gives the table.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "quoll/env/explore.hpp"
#include "quoll/env/worlds/connect_four.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

Solution values_of(const Mdp& mdp) {
  SolveSettings settings;
  settings.width = 1e-9;
  Result<Solution> solution = solve(mdp, settings);
  EXPECT_TRUE(solution) << message(solution.error());
  return std::move(*solution);
}

double start_value(const Mdp& mdp, const Solution& solution) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mdp.start().size(); ++i) {
    sum += mdp.start_probability(i) * solution.lower[mdp.start()[i]];
  }
  return sum;
}

// Each state of the code in which an episode goes on stands in the table under its name, and is
// worth the same.
void expect_equal(const std::string& name, const Parameters& parameters, const Mdp& table) {
  SCOPED_TRACE(name);
  const Result<World> world = find_world(name, parameters);
  ASSERT_TRUE(world) << message(world.error());
  const Result<Mdp> code = explore(*world);
  ASSERT_TRUE(code) << message(code.error());
  EXPECT_EQ(code->alternating(), table.alternating());
  std::map<std::string, State> place;
  for (State s = 0; s < table.states(); ++s) place[table.state_name(s)] = s;
  const Solution of_code = values_of(*code), of_table = values_of(table);
  std::uint64_t going_on = 0;
  for (State s = 0; s < code->states(); ++s) {
    if (code->terminal(s)) continue;
    ++going_on;
    const auto found = place.find(code->state_name(s));
    ASSERT_NE(found, place.end()) << code->state_name(s);
    EXPECT_NEAR(of_code.lower[s], of_table.lower[found->second], 2e-9) << found->first;
  }
  EXPECT_GT(going_on, 100u);
  EXPECT_NEAR(start_value(*code, of_code), start_value(table, of_table), 2e-9);
}

// States of blackjack's code are called by their numbers, those of its table by cards.
TEST(ExploredWorlds, Blackjack) {
  const Result<World> world = find_world("blackjack", {{"rules", "natural"}});
  ASSERT_TRUE(world);
  const Result<Mdp> code = explore(*world);
  ASSERT_TRUE(code) << message(code.error());
  const Solution of_code = values_of(*code), of_table = values_of(*world->mdp);
  for (State s = 0; s < code->states(); ++s) {
    const auto number = static_cast<State>(std::stoul(code->state_name(s)));
    EXPECT_NEAR(of_code.lower[s], of_table.lower[number], 2e-9) << number;
  }
  EXPECT_NEAR(start_value(*code, of_code), start_value(*world->mdp, of_table), 2e-9);
}

// Each state is its own number there.
TEST(ExploredWorlds, ATaxiWhosePassengerChangesHisMind) {
  for (const std::string rainy : {"false", "true"}) {
    const Result<World> world =
        find_world("taxi", {{"fickle", "true"}, {"rainy", rainy}, {"seeding", "gymnasium"}});
    ASSERT_TRUE(world) << message(world.error());
    const Result<Mdp> code = explore(*world);
    ASSERT_TRUE(code) << message(code.error());
    const Solution of_code = values_of(*code), of_table = values_of(*world->mdp);
    EXPECT_GT(code->states(), 500u);
    for (State s = 0; s < code->states(); ++s) {
      const auto number = static_cast<State>(std::stoul(code->state_name(s)));
      EXPECT_NEAR(of_code.lower[s], of_table.lower[number], 1e-7) << number;
    }
  }
}

TEST(ExploredWorlds, ConnectFour) {
  const Parameters wide{{"rows", "2"}, {"columns", "9"}, {"connect", "2"}};
  const ConnectFour game{2, 9, 2};
  board::Compiler self(game, 1.0);
  const auto played = self.self_play();
  ASSERT_TRUE(played);
  expect_equal("connect-four", wide, played->mdp);
  board::Compiler against(game, 1.0);
  const auto answered = against.against(board::Side::o, [&](const ConnectFour::Board& at) {
    return Result<board::Reply>(board::uniform_reply(game, at));
  });
  ASSERT_TRUE(answered);
  Parameters second = wide;
  second.emplace_back("opponent", "uniform");
  second.emplace_back("mark", "o");
  expect_equal("connect-four", second, answered->mdp);
}

}  // namespace
}  // namespace quoll
