// Steps per second of processor time of MinAtar's games through the Environment interface: random
// actions of all six, sticky, ended episodes begun again, one lane and many, with observations and
// without:
//   ./dev bench minatar [STEPS]
// Best of 5 rounds each. Beside it the original program's rate (NumPy, act and state, one core of
// the same machine kind, with observations), and the ratio of one lane with observations to that;
// the last column is the mean return of the episodes with its standard error.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/env/world.hpp"

namespace {

struct Game {
  const char* name;
  double original;  // steps per second
};
constexpr Game games[] = {{"minatar-asterix", 450e3},
                          {"minatar-breakout", 562e3},
                          {"minatar-freeway", 217e3},
                          {"minatar-seaquest", 363e3},
                          {"minatar-space-invaders", 61e3}};

struct Returns {
  double sum = 0.0, squares = 0.0, count = 0.0;

  void add(double value) {
    sum += value;
    squares += value * value;
    count += 1.0;
  }
  double mean() const { return sum / count; }
  double error() const { return std::sqrt((squares / count - mean() * mean()) / count); }
};

double rate(const quoll::World& world, std::uint32_t lanes, bool observed, std::uint64_t steps,
            Returns& returns) {
  const auto environment = world.make({lanes, 1, 0, nullptr});
  const std::size_t size = observed ? environment->spaces().observation : 0;
  std::vector<quoll::State> state(lanes), next(lanes);
  std::vector<quoll::Action> action(lanes);
  std::vector<quoll::Feedback> feedback(lanes);
  std::vector<float> x(lanes * size), y(lanes * size);
  std::vector<std::uint8_t> restart(lanes, 1);
  std::vector<double> earned(lanes);
  quoll::Experience now{state, action, feedback, next, x, y};
  quoll::Rng coins = quoll::stream(1, "bench");
  double best = 0.0;
  environment->restart(restart, now);
  for (int round = 0; round < 5; ++round) {
    const std::clock_t begun = std::clock();
    for (std::uint64_t t = 0; t < steps / lanes; ++t) {
      for (quoll::Action& one : action) one = coins.below(6);
      environment->step(now);
      bool any = false;
      for (std::uint32_t lane = 0; lane < lanes; ++lane) {
        earned[lane] += feedback[lane].reward;
        restart[lane] = feedback[lane].terminated;
        if (!restart[lane]) continue;
        any = true;
        returns.add(earned[lane]);
        earned[lane] = 0.0;
      }
      if (any) environment->restart(restart, now);
    }
    const double time = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
    best = std::max(best, static_cast<double>(steps / lanes * lanes) / time);
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t steps = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 2'000'000;
  std::printf(
      "million steps/s          1 lane           64 lanes         original  ratio  return\n");
  std::printf("                         blind  observed  blind  observed\n");
  for (const Game& game : games) {
    const quoll::Result<quoll::World> world = quoll::find_world(game.name);
    if (!world) return std::printf("%s\n", quoll::message(world.error()).c_str()), 1;
    Returns returns;
    const double blind = rate(*world, 1, false, steps, returns);
    Returns ignored;
    const double seeing = rate(*world, 1, true, steps, ignored);
    const double many = rate(*world, 64, false, steps, ignored);
    const double many_seeing = rate(*world, 64, true, steps, ignored);
    std::printf("%-22s %7.1f %9.1f %6.1f %9.1f %10.3f %5.0fx  %.3f +- %.3f (%.0f episodes)\n",
                game.name, blind * 1e-6, seeing * 1e-6, many * 1e-6, many_seeing * 1e-6,
                game.original * 1e-6, seeing / game.original, returns.mean(), returns.error(),
                returns.count);
  }
  return 0;
}
