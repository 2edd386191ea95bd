#pragma once
// Exact solvers: an interval per state that contains the optimal value, and a policy whose loss is
// certified. Every bound is true in spite of rounding, and for every model whose numbers round to
// the stored ones: for the decimal 0.8 a person wrote as well as for the double nearest to it.
//
// The optimal value at discount 1 is the best total reward of the policies that end with
// probability 1; a state from which no policy does so has the value -infinity. Where two players
// move in turn (MdpArrays::alternating) it is what the player to move can be sure of.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/model/solution.hpp"

namespace quoll {

struct SolveProgress {
  std::uint64_t sweeps = 0;
  std::uint64_t backups = 0;
  double gap = 0.0;  ///< what is left to close: certified width, or an estimate of it
};

struct SolveSettings {
  double width = 1e-6;             ///< largest upper - lower over all states, absolute
  std::optional<double> discount;  ///< instead of the model's own; in (0, 1]
  bool maximise = true;  ///< false: rewards are costs; lower and upper bound the least cost
  std::uint64_t max_sweeps = 1'000'000;
  unsigned threads = 1;  ///< 0 = all processors; the answer's bits do not depend on it
  /// Called between sweeps; false stops the work, and the interval so far is returned.
  std::function<bool(const SolveProgress&)> keep_going;
};

class Solver {
 public:
  virtual ~Solver() = default;

  /// Solves the model. Error: discount outside (0, 1]; at discount 1, states that cannot reach an
  /// end or a cycle that gains, by name; a method asked for a kind of model it cannot do. A solve
  /// that was stopped, or could not certify the width, returns true bounds with converged = false.
  virtual Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) = 0;
};

struct SolverEntry {
  std::string_view name;
  std::string_view summary;  ///< one sentence
  std::unique_ptr<Solver> (*make)();
  bool needs_discount = false;  ///< for discounts below 1 only
  bool needs_total = false;     ///< for discount 1 only
};

/// All solvers, in the order they are shown.
std::span<const SolverEntry> solvers();

/// Solves with the solver of that name. "auto" takes one by the model's structure: two players in
/// turn -> backward-induction, or game-iteration where states come again below discount 1;
/// deterministic -> label-setting, many small strongly connected components -> topological, no
/// discounting -> policy-iteration, else wavefront if the ends are far from some state, or
/// modified-policy-iteration. Error: unknown name, and those of
/// Solver::solve. Solution::method says which one ran.
Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings = {},
                       std::string_view method = "auto");

}  // namespace quoll
