// Exact solvers against hand-written loops in the same run (yardstick/bellman_loop.hpp):
//   ./dev bench solve [ROW]
// Each row is also one line `quoll solve ...`, printed with it; its JSON `seconds` is the figure.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "bench/yardstick/bellman_loop.hpp"
#include "bench/yardstick/stopwatch.hpp"
#include "quoll/env/world.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/solver.hpp"

namespace {

struct Row {
  const char* name;
  const char* world;
  const char* arguments;  // as --with takes them, with commas between
  double discount;
  double width;     // certified: largest upper - lower
  bool span;        // the yardstick: MacQueen's bounds, or Gauss-Seidel
  const char* bar;  // of the solver with one thread
};

constexpr Row rows[] = {
    {"garnet", "garnet", "states=100000,actions=10,branching=10", 0.99, 1e-8, true, "0.35 s"},
    {"grid-300", "gridworld", "size=300", 0.99, 1e-6, false, "0.25 s"},
    {"grid-1000", "gridworld", "size=1000", 0.99, 1e-6, false, "2.5 s"},
};

quoll::Parameters parameters(std::string text) {
  quoll::Parameters out;
  while (!text.empty()) {
    const std::string part = text.substr(0, text.find(','));
    text.erase(0, part.size() + 1);
    out.emplace_back(part.substr(0, part.find('=')), part.substr(part.find('=') + 1));
  }
  return out;
}

constexpr int rounds = 5;

int measure(const Row& row) {
  const auto world = quoll::find_world(row.world, parameters(row.arguments));
  if (!world) return std::printf("%s\n", quoll::message(world.error()).c_str()), 1;
  const quoll::Mdp& mdp = *world->mdp;
  std::string with;
  for (const auto& [key, value] : parameters(row.arguments)) with += " --with " + key + "=" + value;
  std::printf("%s: quoll solve %s%s --discount %g --tolerance %g --json\n", row.name, row.world,
              with.c_str(), row.discount, row.width);
  std::printf(
      "  %llu states, %llu choices, %llu transitions, model %.0f MB = %.1f bytes each\n",
      static_cast<unsigned long long>(mdp.states()), static_cast<unsigned long long>(mdp.choices()),
      static_cast<unsigned long long>(mdp.outcomes()), static_cast<double>(mdp.bytes()) * 1e-6,
      static_cast<double>(mdp.bytes()) / static_cast<double>(mdp.outcomes()));
  yardstick::Answer answer;
  double by_hand;
  {
    const yardstick::Rows plain(mdp);
    by_hand = yardstick::seconds([&] {
      answer = row.span ? yardstick::span_iteration(plain, row.discount, row.width)
                        : yardstick::gauss_seidel(plain, row.discount,
                                                  row.width * (1.0 - row.discount) / row.discount);
    });
  }
  std::printf("  %-28s %8.3f s %6llu sweeps\n",
              row.span ? "by hand, span" : "by hand, Gauss-Seidel", by_hand,
              static_cast<unsigned long long>(answer.sweeps));
  // One thread and two in turn, so that a machine that is busy for a while slows both.
  std::array<std::vector<double>, 2> times;
  std::vector<double> ratios;
  std::array<quoll::Result<quoll::Solution>, 2> solutions{quoll::Error{}, quoll::Error{}};
  for (int round = 0; round < rounds; ++round) {
    for (unsigned i = 0; i < 2; ++i) {
      quoll::SolveSettings settings;
      settings.discount = row.discount;
      settings.width = row.width;
      settings.threads = i + 1;
      times[i].push_back(yardstick::seconds([&] { solutions[i] = quoll::solve(mdp, settings); }));
    }
    ratios.push_back(times[0].back() / times[1].back());
  }
  for (unsigned i = 0; i < 2; ++i) {
    const quoll::Result<quoll::Solution>& solution = solutions[i];
    if (!solution) return std::printf("%s\n", quoll::message(solution.error()).c_str()), 1;
    const double time = yardstick::median(times[i]);
    double outside = 0.0;  // how far the hand-written answer lies outside the certified intervals
    for (quoll::State s = 0; s < mdp.states(); ++s) {
      outside = std::max(
          {outside, solution->lower[s] - answer.value[s], answer.value[s] - solution->upper[s]});
    }
    std::printf("  %-22s %u thread %8.3f s %6llu sweeps  ratio %5.2f  gap %.1e  bar %s%s\n",
                solution->method.c_str(), i + 1, time,
                static_cast<unsigned long long>(solution->sweeps), by_hand / time,
                quoll::largest_gap(mdp, *solution), row.bar,
                solution->converged ? "" : "  NOT CERTIFIED");
    std::printf("  by hand outside the interval by at most %.1e\n", outside);
  }
  std::printf("  two threads %.2f x one (median of %d pairs; bar 1.6)\n", yardstick::median(ratios),
              rounds);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  int status = 0;
  for (const Row& row : rows) {
    if (argc > 1 && std::strcmp(argv[1], row.name) != 0) continue;
    status |= measure(row);
  }
  return status;
}
