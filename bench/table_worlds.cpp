// Worlds that are tables, stepped in batches through the Environment border with uniform actions
// and restarts, against a loop written by hand for tables of at most three outcomes, in the same
// run:
//   ./dev bench table_worlds [LANES] [STEPS]
// The same is reached by `quoll learn frozen-lake`, which steps the packed table without the
// border.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/yardstick/stopwatch.hpp"
#include "bench/yardstick/table_loop.hpp"
#include "quoll/env/world.hpp"

namespace {

// Lanes of a world, and what a caller of the border does: actions, restarts.
struct Caller {
  std::unique_ptr<quoll::Environment> environment;
  std::vector<quoll::State> state, next;
  std::vector<quoll::Action> action;
  std::vector<quoll::Feedback> feedback;
  std::vector<std::uint8_t> restart;
  std::vector<quoll::Rng> coin;
  std::uint64_t finished = 0;

  Caller(const quoll::World& world, std::uint32_t lanes)
      : environment(world.make({lanes, 1, 0, nullptr})),
        state(lanes),
        next(lanes),
        action(lanes),
        feedback(lanes),
        restart(lanes, 1) {
    for (std::uint32_t i = 0; i < lanes; ++i) coin.push_back(quoll::stream(1, "behaviour", i));
    quoll::Experience now = columns();
    environment->restart(restart, now);
  }
  quoll::Experience columns() { return {state, action, feedback, next, {}, {}}; }

  void step(std::uint32_t actions) {
    quoll::Experience now = columns();
    const std::size_t lanes = state.size();
    for (std::size_t i = 0; i < lanes; ++i) action[i] = coin[i].below(actions);
    environment->step(now);
    std::uint64_t over = 0;
    for (std::size_t i = 0; i < lanes; ++i) {
      restart[i] = feedback[i].terminated | feedback[i].truncated;
      over += restart[i];
      state[i] = next[i];
    }
    finished += over;
    if (over > 0) environment->restart(restart, now);
  }
};

void row(const std::string& name, const quoll::Parameters& parameters, std::uint32_t lanes,
         std::uint64_t steps) {
  const quoll::Result<quoll::World> world = quoll::find_world(name, parameters);
  if (!world) return;
  Caller caller(*world, lanes);
  const quoll::Action actions = caller.environment->spaces().actions;
  yardstick::TableLoop loop(*world->mdp, actions, lanes,
                            static_cast<std::uint32_t>(world->episode_steps));
  std::vector<double> ours, ratios;
  const std::uint64_t rounds = std::max<std::uint64_t>(1, steps / lanes);
  std::uint64_t finished = 0;
  for (int round = 0; round < 9; ++round) {
    const double mine = yardstick::seconds([&] {
      for (std::uint64_t t = 0; t < rounds; ++t) caller.step(actions);
    });
    const double hand = yardstick::seconds([&] {
      for (std::uint64_t t = 0; t < rounds; ++t) finished += loop.step();
    });
    ours.push_back(static_cast<double>(rounds * lanes) / mine * 1e-6);
    ratios.push_back(hand / mine);
  }
  std::printf("%-14s %5u lanes  %7.1f M steps/s  ratio %.2f  (episodes %llu and %llu)\n",
              name.c_str(), lanes, yardstick::median(ours), yardstick::median(ratios),
              static_cast<unsigned long long>(caller.finished),
              static_cast<unsigned long long>(finished));
}

}  // namespace

int main(int argc, char** argv) {
  const auto lanes = static_cast<std::uint32_t>(argc > 1 ? std::atoi(argv[1]) : 1024);
  const std::uint64_t steps = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 4'000'000;
  for (const std::uint32_t n : {1u, lanes}) {
    row("frozen-lake", {{"map", "8x8"}}, n, steps);
    row("cliff-walking", {}, n, steps);
    row("taxi", {}, n, steps);
    row("river-swim", {}, n, steps);
  }
  return 0;
}
