#include <algorithm>
#include <memory>
#include <utility>

#include "quoll/solve/methods.hpp"
#include "quoll/solve/rounding.hpp"
#include "quoll/solve/total_bounds.hpp"

// Interval iteration and optimistic value iteration, at discount 1.
//
// Interval iteration (Haddad and Monmege 2018; Baier et al. 2017):
//   1  L0 <= V* <= U0; sweep both until U - L is narrow enough
//
// Optimistic value iteration (Hartmanns and Kaminski 2020):
//   1  sweep L until no value rises by more than e, at first half the width asked for
//   2  guess U = L + nine tenths of the width; sweep U where that lowers it, until T U <= U
//      everywhere: then V* <= U
//   3  if U falls below L, or that takes as long as 1 did: e <- e / 4 and 1 again; after 30 guesses
//      interval iteration goes on
//
// The bounds and their sweeps: total_bounds.hpp.

namespace quoll {

Solution iterate_intervals(const Mdp& mdp, const SolveSettings& settings, Ending ending) {
  TotalBounds bounds(mdp, settings, std::move(ending));
  bool below = bounds.start_below();
  bool above = bounds.start_above();
  while (below || above) {
    const double raised = below ? bounds.raise_lower() : 0.0;
    const double sunk = above ? bounds.sink_upper().change : 0.0;
    const double width = bounds.width();
    if (!bounds.count(width) || width <= 0.99 * settings.width) break;
    below = below && raised > 0.0;
    above = above && sunk > 0.0;
  }
  return bounds.finish();
}

Solution iterate_optimistically(const Mdp& mdp, const SolveSettings& settings, Ending ending) {
  constexpr unsigned most_guesses = 30;
  TotalBounds bounds(mdp, settings, ending);
  if (!bounds.start_below()) return bounds.finish();
  double aim = 0.5 * settings.width;
  std::uint64_t sweeps = 0;
  for (unsigned guess = 0; guess < most_guesses; ++guess, aim *= 0.25) {
    for (double rise = infinity; rise > aim && rise > 0.0; ++sweeps) {
      rise = bounds.raise_lower();
      if (!bounds.count(rise)) return bounds.finish();
    }
    bounds.guess_above(0.9 * settings.width);
    for (std::uint64_t k = 0; k < std::max<std::uint64_t>(sweeps, 100); ++k) {
      const TotalBounds::Sunk sunk = bounds.sink_upper();
      if (sunk.inductive) return bounds.finish();
      if (!bounds.count(settings.width)) return bounds.finish();
      if (sunk.change == 0.0 || bounds.crossed()) break;
    }
  }
  return iterate_intervals(mdp, settings, std::move(ending));
}

namespace {

template <TotalMethod method>
class TotalSolver : public Solver {
 public:
  Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) override {
    if (!settings.maximise) return solve_minimised(*this, mdp, settings);
    const Result<double> discount = discount_of_one(mdp, settings);
    if (!discount) return discount.error();
    const std::string_view name =
        method == TotalMethod::intervals ? "interval-iteration" : "optimistic-value-iteration";
    if (*discount == 1.0) return solve_undiscounted(mdp, settings, name, method);
    return Error{"--method", 0, 0,
                 std::string(name) + " is for discount 1; value-iteration has bounds below it",
                 "value-iteration"};
  }
};

}  // namespace

std::unique_ptr<Solver> make_interval_iteration() {
  return std::make_unique<TotalSolver<TotalMethod::intervals>>();
}

std::unique_ptr<Solver> make_optimistic_value_iteration() {
  return std::make_unique<TotalSolver<TotalMethod::optimistic>>();
}

}  // namespace quoll
