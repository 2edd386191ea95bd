// One learned adventure, printed bit by bit: the same program is built natively and for
// WebAssembly.

#include <bit>
#include <cinttypes>
#include <cstdio>

#include "quoll/env/world.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/solve/solver.hpp"

namespace {

void print_bits(const char* name, double value) {
  std::printf("%s %016" PRIx64 " %.9g\n", name, std::bit_cast<std::uint64_t>(value), value);
}

// Learns with these words for `steps` steps and prints the whole table.
int learn(const quoll::World& world, const char* explore, const char* step_size, const char* rule) {
  quoll::LearnSettings settings;
  settings.explore = explore;
  settings.step_size = step_size;
  settings.rule = rule;
  if (settings.explore == "softmax") settings.temperature = "20";
  settings.until_stable = false;
  auto learner = quoll::make_learner(settings, world);
  if (!learner) {
    std::printf("%s\n", message(learner.error()).c_str());
    return 1;
  }
  const auto progress = (*learner)->advance(5000, {});
  std::printf("%s %s %s: steps %" PRIu64 ", episodes %" PRIu64 "\n", explore, step_size, rule,
              progress.steps, progress.episodes);
  for (const double q : (*learner)->estimates().q) print_bits("q", q);
  return 0;
}

}  // namespace

int main() {
  const auto world = quoll::find_world("adventure");
  if (!world) {
    std::printf("%s\n", message(world.error()).c_str());
    return 1;
  }
  int failed = learn(*world, "uniform", "1", "standard");
  failed |= learn(*world, "softmax", "0.3", "standard");
  failed |= learn(*world, "ucb", "1", "reward-estimate");
  const auto solution = quoll::solve(*world->mdp);
  if (!solution) return 1;
  for (const double lower : solution->lower) print_bits("lower", lower);
  return failed;
}
