// Solves a built-in world with nothing but Quoll's public headers.
#include <cstdio>
#include <quoll/env/world.hpp>
#include <quoll/solve/solver.hpp>

int main() {
  const auto world = quoll::find_world("adventure");
  if (!world) return 1;
  const auto solution = quoll::solve(*world->mdp);
  if (!solution || solution->lower.empty()) return 1;
  std::printf("%s: V* of the first state >= %g\n", world->name.c_str(), solution->lower[0]);
  return 0;
}
