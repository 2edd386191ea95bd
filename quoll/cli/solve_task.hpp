#pragma once
// What 'solve' hands to its reports of other horizons, and what they share.

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "quoll/cli/common.hpp"
#include "quoll/cli/exact.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll::cli {

/// Tables show no more states than this, unless all are asked for.
inline constexpr std::uint64_t few_states = 20;

struct SolveTask {
  const World& world;
  const Mdp& mdp;
  const OutputOption& output;
  std::string input;      ///< the world as it was named
  double discount = 0.0;  ///< 0 = the world's own
  double tolerance = 0.0;
  bool tolerance_given = false;  ///< else also 1e-12 of the largest value will do
  std::string method;
  bool minimise = false;
  std::string_view proof;  ///< the flag of a proof that was asked for, and is for other answers
  unsigned threads = 0;
  double seconds_load = 0.0;
};

/// `solve --horizon` or `solve --average`, not both: solves and reports.
Exit solve_task(const SolveTask& task, std::uint64_t horizon, bool average);
Exit solve_horizon(const SolveTask& task, std::uint64_t steps);
Exit solve_average(const SolveTask& task);

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  }

 private:
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

/// "5 ms", "2.1 s".
std::string time_text(double seconds);
/// One number where both ends print alike, else "in [a, b]".
std::string interval_text(const Interval& interval);
/// The policy of a grid as arrows and a blank line, if that is how such a world is shown.
std::optional<std::string> grid_page(const Mdp& mdp, std::span<const double> value,
                                     std::span<const Action> policy, const TerminalStyle& style,
                                     bool all);
/// "3 states, 6 choices, 9 transitions".
std::string sizes_text(const Mdp& mdp);
/// Refuses a --method other than auto and `only`, the one that goes with `flag`.
Result<void> check_method(const SolveTask& task, std::string_view flag, std::string_view only);
/// The members all reports begin with: world, sizes, discount if any, objective, method.
void write_task(JsonWriter& json, const SolveTask& task, std::optional<double> discount,
                std::string_view method);
/// Shows how far the work is; false after Ctrl-C.
std::function<bool(const SolveProgress&)> show_sweeps(ProgressDisplay& display, std::uint64_t total,
                                                      bool with_gap);

}  // namespace quoll::cli
