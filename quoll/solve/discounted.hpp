#pragma once
// What the methods for discounts below 1 share: where they begin, the sweep that bounds, the end.

#include <string_view>
#include <vector>

#include "quoll/solve/components.hpp"
#include "quoll/solve/policy_rows.hpp"
#include "quoll/solve/rounding.hpp"
#include "quoll/solve/solver.hpp"
#include "quoll/solve/span_bounds.hpp"

namespace quoll {

/// A solve under way. V: value(), at first the lower one of start_bounds() and 0 at ends, a bound
/// on V* that sweeps in place keep.
class Discounted {
 public:
  Discounted(const Mdp& mdp, const SolveSettings& settings, double discount,
             std::string_view method);

  /// V <- T V with the greedy policy and MacQueen's bounds (span_bounds.hpp), on the settings'
  /// threads. True = narrow enough, or told to stop.
  bool certify();
  /// The same, and packs the rows of the greedy policy.
  bool certify(PolicyRows& rows);
  /// The same bounds after a sweep of the caller's own: `backed_up` = T V, `change` = T V - V; the
  /// policy is the caller's to set.
  bool certify_with(std::vector<double>& backed_up, const Differences& change);

  const Mdp& mdp() const { return mdp_; }
  double discount() const { return discount_; }
  std::vector<double>& value() { return value_; }
  std::vector<Action>& policy() { return solution_.policy; }
  const SpanBounds& bounds() const { return bounds_; }
  /// Greatest - least difference of the last sweep that bounded, ends not counted.
  double span() const { return span_; }
  /// Largest |difference| of it.
  double residual() const { return residual_; }
  unsigned threads() const { return settings_.threads; }
  /// The change per sweep in place below which bounds are narrow enough, or rounding is all.
  double aim() const;
  bool stopped() const { return stopped_; }
  void set_method(std::string_view name) { solution_.method = name; }

  /// Counts sweeps in place over so many states and tells keep_going; false = stop now.
  bool count(std::uint64_t updates, double change);
  /// The bounds of the last certify(); call that last.
  Solution finish();

 private:
  Residual residual_of_value();

  const Mdp& mdp_;
  const SolveSettings& settings_;
  double discount_;
  ModelScale scale_;
  StartBounds start_;
  Solution solution_;
  std::vector<double> value_, backed_up_;
  SpanBounds bounds_{-infinity, infinity, infinity};
  double span_ = infinity, residual_ = infinity;
  std::uint64_t updates_ = 0;  // of single states, not yet a whole sweep
  bool stopped_ = false;
};

/// Wavefront if it fits, else modified policy iteration.
Solution solve_discounted(const Mdp& mdp, const SolveSettings& settings, double discount);

/// Each takes a run to its end.
void modified_policy_iteration(Discounted& run);
void gauss_seidel(Discounted& run);
/// False, and nothing done: every state is so near to an end that there is no wave to follow.
bool wavefront(Discounted& run, std::size_t least_bands);
void topological(Discounted& run, const Components& parts);

}  // namespace quoll
