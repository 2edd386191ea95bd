// The chess endgame, solved backwards by its own rules and as a model that knows nothing of chess.

#include <gtest/gtest.h>

#include "quoll/env/world.hpp"
#include "quoll/env/worlds/krk_endgame.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

// The solver finds 0.99^(n - 1) in every position.
TEST(Krk, TheOptimumIsTheTable) {
  const Result<World> found = find_world("krk");
  ASSERT_TRUE(found);
  const World& world = *found;
  const krk::Endgame endgame = krk::solve_endgame();
  ASSERT_EQ(world.mdp->states(), 175'168u + 3);
  EXPECT_TRUE(world.mdp->deterministic());
  SolveSettings settings;
  settings.width = 1e-12;
  const Result<Solution> solution = solve(*world.mdp, settings);
  ASSERT_TRUE(solution);
  double power[17] = {0.0, 1.0};
  for (int n = 2; n <= 16; ++n) power[n] = 0.99 * power[n - 1];
  State s = 0;
  for (unsigned index = 0; index < krk::placements; ++index) {
    const std::uint8_t moves = endgame.mate_in[index];
    if (moves == krk::illegal) continue;
    ASSERT_LE(solution->lower[s], power[moves] + 1e-15) << world.mdp->state_name(s);
    ASSERT_GE(solution->upper[s], power[moves] - 1e-15) << world.mdp->state_name(s);
    ASSERT_LE(solution->upper[s] - solution->lower[s], 1e-12);
    ++s;
  }
  EXPECT_EQ(world.mdp->state_name(s), "mate");
}

// With both sides in the model, too; Black's positions are worth -0.99^(n - 1/2), or 0 with the
// rook to be taken.
TEST(Krk, TheGameOfBothSidesHasTheSameOptimum) {
  const Result<World> found = find_world("krk", {{"defender", "learning"}});
  ASSERT_TRUE(found);
  const Mdp& mdp = *found->mdp;
  const Result<Solution> solution = solve(mdp);
  ASSERT_TRUE(solution) << message(solution.error());
  EXPECT_TRUE(solution->converged);
  const krk::Endgame endgame = krk::solve_endgame();
  const double half = mdp.discount();
  double power[32] = {1.0};  // of half a move
  for (int n = 1; n < 32; ++n) power[n] = half * power[n - 1];
  State s = 0;
  for (const bool black : {false, true}) {
    for (unsigned index = 0; index < krk::placements; ++index) {
      const std::uint8_t n = black ? endgame.lost_in[index] : endgame.mate_in[index];
      if (n == krk::illegal || (black && (n == 0 || n == krk::stalemate))) continue;
      const double value = !black                 ? power[2 * n - 2]
                           : n == krk::rook_falls ? 0.0
                                                  : -power[2 * n - 1];
      ASSERT_LE(solution->lower[s], value + 1e-14) << mdp.state_name(s);
      ASSERT_GE(solution->upper[s], value - 1e-14) << mdp.state_name(s);
      ++s;
    }
  }
  EXPECT_EQ(mdp.state_name(s), "mate");
}

}  // namespace
}  // namespace quoll
