#pragma once
// Bounds on total reward at discount 1 that sweeps bring together, each true at any time: the
// common part of interval iteration and optimistic value iteration. See total_bounds.cpp.

#include <cstdint>
#include <vector>

#include "quoll/model/mdp.hpp"
#include "quoll/solve/ending.hpp"
#include "quoll/solve/free_parts.hpp"
#include "quoll/solve/inductive.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {

class TotalBounds {
 public:
  /// Begins with -infinity and +infinity in the live states.
  TotalBounds(const Mdp& mdp, const SolveSettings& settings, Ending ending);

  /// Lower bound: what the policy that ends is sure of. False = episodes too long to count.
  bool start_below();
  /// Upper bound: the largest reward of a move times the moves that can be left, moves inside end
  /// components not counted. False = none was found: rewards that balance in an end component.
  bool start_above();
  /// Upper bound: `width` above the lower one, which need not be a bound yet. Balances are looked
  /// for near the lower bound.
  void guess_above(double width);

  /// One sweep that raises the lower bound; the policy takes the actions that do. Returns the
  /// largest change, 0 where only rounding is left.
  double raise_lower();
  struct Sunk {
    double change = 0.0;
    bool inductive = true;  ///< T U <= U before this sweep: U is a bound
  };
  /// One sweep that lowers the upper bound. End components whose moves are for nothing count as
  /// one state.
  Sunk sink_upper();

  /// Largest upper - lower, and whether upper is below lower somewhere.
  double width() const;
  bool crossed() const;
  /// Counts a sweep; false = stop.
  bool count(double gap);
  /// Bounds are checked once more; what does not hold is left open.
  Solution finish();

 private:
  double slack(std::uint64_t choice) const;
  double sinking(State s, std::uint64_t choice) const;
  void measure();

  const Mdp& mdp_;
  const SolveSettings& settings_;
  std::vector<std::uint8_t> live_;
  std::vector<State> states_;  // the live ones
  std::vector<bool> safe_;     // choices that keep to live states and ends
  FreeParts free_;
  Inductive inductive_;
  std::vector<double> lower_, upper_;
  std::vector<double> sink_;  // per free part
  double reward_size_ = 0.0, size_ = 0.0;
  bool backward_ = true;
  Solution solution_;
};

}  // namespace quoll
