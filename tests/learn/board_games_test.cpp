// Learning tic-tac-toe: from nothing but its own games to the exact values, and against an
// opponent.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "quoll/env/world.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/solve/optimality.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

struct Learned {
  World world;
  Solution exact;
  Estimates estimates;
  double error = 0.0;  ///< largest |Q - Q*|
  Optimality judged;
};

Learned learn(const Parameters& parameters, LearnSettings settings, std::uint64_t steps) {
  Result<World> world = find_world("tic-tac-toe", parameters);
  EXPECT_TRUE(world);
  Learned out{std::move(*world), {}, {}, 0.0, {}};
  const Mdp& mdp = *out.world.mdp;
  const Result<std::unique_ptr<Learner>> learner = make_learner(settings, out.world);
  EXPECT_TRUE(learner) << (learner ? "" : message(learner.error()));
  (*learner)->advance(steps, {});
  out.estimates = (*learner)->estimates();
  const Result<Solution> exact = solve(mdp);
  EXPECT_TRUE(exact);
  out.exact = *exact;
  std::vector<double> middle(mdp.states());
  for (State s = 0; s < mdp.states(); ++s) middle[s] = 0.5 * (exact->lower[s] + exact->upper[s]);
  for (State s = 0; s < mdp.states(); ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      const double error = std::fabs(out.estimates.q[c] - q_star(mdp, middle, c, 1.0));
      out.error = std::max(out.error, error);
    }
  }
  out.judged = judge(mdp, *exact, greedy_policy(out.estimates), mdp.start(), 1.0);
  return out;
}

// With the defaults (uniform play, whole steps) every one of the 16,167 moves is seen often enough.
TEST(BoardGames, SelfPlayLearnsTheExactValues) {
  LearnSettings settings;
  const Learned learned = learn({}, settings, 4'000'000);
  EXPECT_EQ(learned.world.mdp->choices(), 16'167u);
  EXPECT_EQ(learned.error, 0.0);
  EXPECT_EQ(learned.judged.optimal, true) << learned.judged.proof;
}

// Against chance with steps of 1/N^0.8, from all positions: the policy loses nothing at all, the
// value of the start is near; the rarest of the moves (200 visits) are still some way off.
TEST(BoardGames, LearnsTheBestGameAgainstARandomPlayer) {
  LearnSettings settings;
  settings.start = "uniform";
  settings.step_size = "1/N^0.8";
  const Learned learned = learn({{"opponent", "uniform"}}, settings, 8'000'000);
  EXPECT_LE(learned.judged.regret, 1e-12) << learned.judged.proof;
  double best = -1.0;
  for (std::uint64_t c = 0; c < learned.estimates.row_begin[1]; ++c) {
    best = std::max(best, learned.estimates.q[c]);
  }
  EXPECT_NEAR(best, 191.0 / 192.0, 2e-3);
  EXPECT_LE(learned.error, 0.3);
}

}  // namespace
}  // namespace quoll
