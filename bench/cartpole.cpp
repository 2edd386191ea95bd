// Many carts and poles at once: the world `cartpole` behind the Environment border against loops
// written by hand for that one case, in the same run:
//   ./dev bench cartpole [LANES] [STEPS OF EACH LANE]
// What is measured of the Environment is what a caller pays: step() with feedback and rows of
// observations, and restart() of the lanes that are over. The actions are drawn beforehand.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/yardstick/cartpole_loop.hpp"
#include "bench/yardstick/stopwatch.hpp"
#include "quoll/env/world.hpp"

namespace {

constexpr int rounds = 200, patterns = 61;

// The actions of all lanes in 61 steps; step t takes the (t mod 61)th column.
std::vector<std::uint32_t> coins(std::size_t lanes) {
  std::vector<std::uint32_t> actions(lanes * patterns);
  quoll::Rng rng = quoll::stream(1, "coins");
  for (std::uint32_t& action : actions) action = rng.below(2);
  return actions;
}

struct Through {
  std::unique_ptr<quoll::Environment> environment;
  std::vector<quoll::Action> action;
  std::vector<quoll::Feedback> feedback;
  std::vector<float> seen, next_seen;

  Through(const quoll::World& world, std::uint32_t lanes)
      : environment(world.make({lanes, 1, 0, nullptr})),
        action(lanes),
        feedback(lanes),
        seen(4 * lanes),
        next_seen(4 * lanes) {
    begin(std::vector<std::uint8_t>(lanes, 1));
  }
  void begin(std::span<const std::uint8_t> restart) {
    quoll::Experience now{{}, action, feedback, {}, seen, next_seen};
    environment->restart(restart, now);
  }
  void run(std::vector<std::uint32_t>& actions, int steps) {
    const std::size_t lanes = action.size();
    for (int t = 0; t < steps; ++t) {
      const std::span<quoll::Action> chosen(actions.data() + t % patterns * lanes, lanes);
      quoll::Experience now{{}, chosen, feedback, {}, seen, next_seen};
      environment->step(now);
      std::swap(seen, next_seen);
      begin({});
    }
  }
};

template <class Real, bool rows>
struct ByHand {
  yardstick::CartPoleLoop<Real, rows> loop;

  void run(const std::vector<std::uint32_t>& actions, int steps) {
    for (int t = 0; t < steps; ++t) loop.step(actions.data() + t % patterns * loop.lanes);
  }
};

template <class Real>
void compare(const char* precision, std::uint32_t lanes, int steps) {
  const quoll::Result<quoll::World> world =
      quoll::find_world("cartpole", {{"precision", precision}});
  std::vector<std::uint32_t> actions = coins(lanes);
  Through through(*world, lanes);
  ByHand<Real, true> rows{{lanes, 500}};
  ByHand<Real, false> columns{{lanes, 500}};
  double fastest[] = {1e9, 1e9, 1e9};
  const auto measure = [&](int which, auto& subject) {
    fastest[which] =
        std::min(fastest[which], yardstick::seconds([&] { subject.run(actions, steps); }));
  };
  for (int round = 0; round < rounds; ++round) {
    measure(0, through);
    measure(1, rows);
    measure(2, columns);
  }
  const double all = static_cast<double>(lanes) * steps * 1e-6;
  std::printf("%-6s  %u lanes, M steps/s: Environment %.1f\n", precision, lanes, all / fastest[0]);
  const char* const names[] = {"", "by hand, rows", "by hand, columns"};
  for (int i = 1; i <= 2 && lanes % 16 == 0; ++i) {  // the loops take whole vectors
    std::printf("  %-16s %6.1f   ratio %.2f\n", names[i], all / fastest[i],
                fastest[i] / fastest[0]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const auto lanes = static_cast<std::uint32_t>(argc > 1 ? std::atoi(argv[1]) : 1024);
  const int steps = argc > 2 ? std::atoi(argv[2]) : 1000;
  compare<float>("float", lanes, steps);
  compare<double>("double", lanes, steps);
}
