// Tabular Q-learning against a loop written by hand for the same grid, in the same run, in turn:
//   ./dev bench tabular [SIDE] [STEPS]
// prints steps per second of both, the ratio pair by pair, and whether the tables are the same
// bits.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "bench/yardstick/q_loop.hpp"
#include "bench/yardstick/stopwatch.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/model/grid.hpp"

namespace {

quoll::World grid_world(std::uint32_t side) {
  quoll::Grid grid;
  grid.rows.assign(side, std::string(side, '.'));
  grid.rows.front().front() = 'S';
  grid.rows.back().back() = 'G';
  grid.discount = 0.99;
  quoll::Result<quoll::Mdp> mdp = quoll::to_mdp(grid);
  return quoll::to_world("grid", std::move(*mdp));
}

bool same_bits(const quoll::Estimates& learned, const yardstick::GridLoop& loop) {
  // The goal has no choices in the model and four zero entries in the hand-written table.
  for (std::size_t i = 0; i < learned.q.size(); ++i) {
    if (static_cast<float>(learned.q[i]) != loop.q[i] || learned.visits[i] != loop.visits[i]) {
      return false;
    }
  }
  return true;
}

template <bool first_tie>
void row(const quoll::World& world, std::uint32_t side, const char* epsilon, std::uint64_t steps) {
  quoll::LearnSettings settings;
  settings.explore = "epsilon-greedy";
  settings.epsilon = epsilon;
  settings.step_size = "0.5";
  settings.until_stable = false;
  settings.ties = first_tie ? quoll::Ties::first : quoll::Ties::uniform;
  auto learner = quoll::make_learner(settings, world);
  yardstick::GridLoop loop(side, 0.99, 0.5, std::atof(epsilon), settings.seed);
  std::vector<double> ratios, ours, theirs;
  for (int round = 0; round < 15; ++round) {
    const double mine = yardstick::seconds([&] { (*learner)->advance(steps, {}); });
    const double hand = yardstick::seconds([&] { loop.run<first_tie>(steps); });
    ours.push_back(static_cast<double>(steps) / mine * 1e-6);
    theirs.push_back(static_cast<double>(steps) / hand * 1e-6);
    ratios.push_back(hand / mine);
  }
  std::printf("%ux%u epsilon %-4s ties %-8s %8.1f M/s  hand-written %8.1f M/s  ratio %.3f  %s\n",
              side, side, epsilon, first_tie ? "first" : "uniform", yardstick::median(ours),
              yardstick::median(theirs), yardstick::median(ratios),
              same_bits((*learner)->estimates(), loop) ? "same bits" : "DIFFERENT");
  std::printf(
      "    quoll learn GRID.txt --discount 0.99 --explore epsilon-greedy --epsilon %s "
      "--step-size 0.5%s --steps %llu\n",
      epsilon, first_tie ? " --ties first" : "", static_cast<unsigned long long>(steps * 15));
}

}  // namespace

int main(int argc, char** argv) {
  const auto side = static_cast<std::uint32_t>(argc > 1 ? std::atoi(argv[1]) : 8);
  const std::uint64_t steps = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 4'000'000;
  const quoll::World world = grid_world(side);
  row<false>(world, side, "0.1", steps);
  row<false>(world, side, "1.0", steps);
  row<true>(world, side, "0.1", steps);
  row<true>(world, side, "1.0", steps);
  return 0;
}
