#include "quoll/solve/solver.hpp"

#include <gtest/gtest.h>

#include "models.hpp"
#include "quoll/solve/evaluate.hpp"

namespace quoll {
namespace {

TEST(Solver, FindsTheLecturesValues) {
  const Mdp mdp = test::adventure();
  for (const SolverEntry& entry : solvers()) {
    const Result<Solution> found = solve(mdp, {}, entry.name);
    ASSERT_TRUE(found) << message(found.error());
    const auto at = [&](const char* name) { return *mdp.find_state(name); };
    const std::pair<const char*, double> expected[] = {{"CAVE", 100}, {"WELL", 100}, {"POOL", 80},
                                                       {"HALL", 80},  {"GATE", 64},  {"GOAL", 0}};
    for (const auto& [name, value] : expected) {
      EXPECT_LE(found->lower[at(name)], value) << entry.name << " " << name;
      EXPECT_GE(found->upper[at(name)], value) << entry.name << " " << name;
      EXPECT_LE(found->upper[at(name)] - found->lower[at(name)], 1e-6) << entry.name;
    }
    EXPECT_EQ(found->policy[at("GOAL")], no_action);
    EXPECT_EQ(found->policy[at("POOL")], 0u);
    EXPECT_TRUE(found->converged);
    EXPECT_EQ(found->method, entry.name);
  }
}

}  // namespace
}  // namespace quoll
