#include "quoll/env/world.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "played.hpp"

namespace quoll::world_tests {
namespace {

Tree tuple(std::int64_t sum, std::int64_t dealer, std::int64_t usable) {
  return Tree(Tree::List{Tree(sum), Tree(dealer), Tree(usable)});
}

Played with_cards(const Parameters& parameters, std::vector<double> draws,
                  const std::vector<Action>& actions) {
  return play(
      made("blackjack", parameters), 1, static_cast<int>(actions.size()),
      [&](int t) { return actions[t]; }, std::make_shared<const std::vector<double>>(draws));
}

// Backward induction over the rules of Gymnasium's program (Blackjack-v1), confirmed by 60,000
// simulated games.
TEST(Blackjack, HasTheKnownOptima) {
  struct Row {
    const char* rules;
    double far, near, undiscounted;
  };
  const Row rows[] = {{"sab", -0.043026190, -0.042220653, -0.043113105},
                      {"natural", -0.025642267, -0.024836730, -0.025729183},
                      {"plain", -0.046469062, -0.045663525, -0.046555977}};
  for (const Row& row : rows) {
    const World world = made("Blackjack-v1", {{"rules", row.rules}});
    EXPECT_NEAR(optimum(world, 0.99), row.far, 6e-10) << row.rules;
    EXPECT_NEAR(optimum(world, 0.9), row.near, 6e-10) << row.rules;
    EXPECT_NEAR(optimum(world, 1.0), row.undiscounted, 6e-10) << row.rules;
  }
}

TEST(Blackjack, NamesItsHands) {
  const World world = made("blackjack");
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 293u);
  EXPECT_EQ(mdp.state_name(0), "hard-4-vs-A");
  EXPECT_EQ(mdp.state_name(179), "hard-21-vs-10");
  EXPECT_EQ(mdp.state_name(180), "soft-12-vs-A");
  EXPECT_EQ(mdp.state_name(279), "soft-21-vs-10");
  EXPECT_EQ(mdp.state_name(285), "natural-vs-6");
  EXPECT_EQ(mdp.state_name(292), "won");
  EXPECT_TRUE(mdp.terminal(290) && mdp.terminal(291) && mdp.terminal(292));
  EXPECT_EQ(world.episode_steps, 0u);
  const auto environment = world.make({1, 1, 0, nullptr});
  for (State s = 0; s < mdp.states(); ++s) {  // every hand is made of some cards
    ASSERT_TRUE(environment->set(0, s));
    State state = 0;
    Inspector& look = *environment->inspector();
    ASSERT_TRUE(look.set(0, look.state(0, s), state));
    EXPECT_EQ(state, s);
  }
}

// Draws: the dealer's 10 (a queen of hearts) and 6, the player's ace and 5, then a 10 (hard 16);
// the dealer takes a 5.
TEST(Blackjack, TakesCardsInGymnasiumsOrder) {
  const Played played = with_cards({}, {9, 5, 0, 4, 2, 1, 12, 4}, {1, 0});
  EXPECT_EQ(played.starts[0], tuple(16, 10, 1));
  EXPECT_EQ(played.observed[0], tuple(16, 10, 0));
  EXPECT_EQ(played.observed[1], tuple(16, 10, 0));
  EXPECT_EQ(played.rewards, (std::vector<double>{0, -1}));
  EXPECT_FALSE(played.terminated[0]);
  EXPECT_TRUE(played.terminated[1]);
  EXPECT_EQ(played.text, "dealer  Q of hearts, 6, 5: 21\nplayer  A, 5, 10: 16, lost\n");
}

// The player's ace and ten against the dealer's 5, 6, 10: 21 with three cards.
TEST(Blackjack, PaysANaturalByTheRules) {
  const std::vector<double> against_21{4, 5, 0, 9, 0, 9};
  EXPECT_EQ(with_cards({{"rules", "sab"}}, against_21, {0}).rewards[0], 1.0);
  EXPECT_EQ(with_cards({{"rules", "natural"}}, against_21, {0}).rewards[0], 0.0);
  EXPECT_EQ(with_cards({{"rules", "plain"}}, against_21, {0}).rewards[0], 0.0);
  const std::vector<double> against_17{6, 9, 9, 0, 0};
  EXPECT_EQ(with_cards({{"rules", "sab"}}, against_17, {0}).rewards[0], 1.0);
  EXPECT_EQ(with_cards({{"rules", "natural"}}, against_17, {0}).rewards[0], 1.5);
  EXPECT_EQ(with_cards({{"rules", "plain"}}, against_17, {0}).rewards[0], 1.0);
  const std::vector<double> against_natural{0, 9, 9, 0, 0};
  EXPECT_EQ(with_cards({{"rules", "sab"}}, against_natural, {0}).rewards[0], 0.0);
}

// Gymnasium 1.4 in preparation, Blackjack-v1, env.reset(seed=42), actions 1, 1, 0, 1, 1, 0, ...
TEST(Blackjack, FollowsGymnasiumForTheSameSeed) {
  const World world = made("Blackjack-v1", {{"seeding", "gymnasium"}});
  const Played played = play(world, 42, 16, [](int t) { return Action(t % 3 != 2); });
  const std::vector<Tree> starts{tuple(15, 2, 0), tuple(5, 2, 0),   tuple(17, 10, 0),
                                 tuple(13, 7, 0), tuple(14, 6, 0),  tuple(21, 2, 1),
                                 tuple(20, 9, 0), tuple(19, 6, 0),  tuple(18, 5, 1),
                                 tuple(15, 9, 0), tuple(18, 10, 1), tuple(12, 2, 0)};
  EXPECT_EQ(played.starts, starts);
  EXPECT_EQ(played.rewards,
            (std::vector<double>{-1, 0, 1, -1, -1, -1, 0, -1, 1, -1, 0, 1, 0, -1, 1, 0}));
  EXPECT_EQ(played.observed[0], tuple(25, 2, 0));
  EXPECT_EQ(played.observed[10], tuple(21, 5, 1));
  EXPECT_EQ(played.observed[15], tuple(20, 2, 0));
}

TEST(Blackjack, RefusesImpossibleHands) {
  const auto environment = made("blackjack").make({1, 1, 0, nullptr});
  Inspector& look = *environment->inspector();
  State at = 0;
  Tree state = look.state(0, 0);
  ASSERT_TRUE(look.set(0, state, at));
  Tree& player = std::get<Tree::Object>(state.value)[0].second;
  player = Tree(Tree::List{Tree(std::int64_t{10}), Tree(std::int64_t{4})});
  ASSERT_TRUE(look.set(0, state, at));
  player = Tree(Tree::List{Tree(std::int64_t{10}), Tree(std::int64_t{11})});
  EXPECT_FALSE(look.set(0, state, at));
  player = Tree(Tree::List{Tree(std::int64_t{10})});
  EXPECT_FALSE(look.set(0, state, at));
}

}  // namespace
}  // namespace quoll::world_tests
