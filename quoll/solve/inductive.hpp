#pragma once
// The check that makes a vector a bound at discount 1: T U <= U, or T_pi L >= L, move by move with
// outward rounding.

#include <cstdint>
#include <vector>

#include "quoll/model/mdp.hpp"
#include "quoll/solve/free_parts.hpp"

namespace quoll {

/// Over the live states of a model; ends count 0, others -infinity in bounds. Its references must
/// outlive it.
class Inductive {
 public:
  Inductive(const Mdp& mdp, const std::vector<std::uint8_t>& live, const FreeParts& free);

  /// An upper bound on sign * (r + sum of p (bound(s') - bound(s))) for a choice of s.
  double gain_up(const std::vector<double>& bound, double sign, State s,
                 std::uint64_t choice) const;
  /// Whether T_pi L >= L.
  bool holds_below(const std::vector<double>& lower, const std::vector<Action>& policy) const;
  /// Whether T U <= U, after raising U a little where it fails, some sweeps long.
  bool raise_above(std::vector<double>& upper) const;
  /// Whether the policy keeps to live states and comes to its end from each.
  bool ends(const std::vector<Action>& policy) const;
  /// 0 at ends, -infinity in states that are not live, else `unknown`.
  std::vector<double> constant(double unknown) const;

 private:
  const Mdp& mdp_;
  const std::vector<std::uint8_t>& live_;
  const FreeParts& free_;
  double reward_size_ = 0.0;
};

}  // namespace quoll
