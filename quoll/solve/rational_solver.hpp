#pragma once
// The optimal value and an optimal policy without rounding, as fractions; for small models.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/model/solution.hpp"

namespace quoll {

/// A number of any size, in lowest terms. No numerator: no finite value, `rounded` says why.
struct Fraction {
  std::string numerator, denominator;
  /// The nearer double towards 0. An infinity: no policy ends from here with probability 1. Not a
  /// number: a state of which nothing is known, since a part of the model that gains for ever can
  /// follow.
  double rounded = 0.0;
};

struct RationalSettings {
  bool maximise = true;
  std::uint64_t most_outcomes = 1'000'000;  ///< of models that are tried at all
  std::uint64_t most_together = 20'000;     ///< states of one strongly connected component
  /// Called now and then with the number of states that are done; false stops the work.
  std::function<bool(std::uint64_t)> keep_going;
};

struct RationalSolution {
  std::vector<Fraction> value;  ///< per state: V*, exactly
  Fraction start;               ///< expected over the start distribution
  std::vector<Action> policy;   ///< attains V* exactly
  std::uint64_t switched = 0;   ///< states whose action had to be changed
  /// The first state whose V* lies outside the bounds of the solution that was given; not looked
  /// for if some probability had to be read as another number than its double stands for.
  std::optional<State> outside;
};

/// Whether this build can count in fractions at all (found GMP).
bool has_rationals();

/// Takes the policy of `from`, values it in rational arithmetic and checks every action of every
/// state against it; where one is better the policy is improved and valued again (Howard 1960), so
/// that the end is a proof. At discount 1 policies end with probability 1, as in solver.hpp. The
/// model's doubles are read as in meant.hpp. Error: a build without GMP; probabilities that sum to
/// 1 in no reading; a model over the limits; a policy that gains for ever; stopped. Cost: some n^2
/// to n^3 multiplications of numbers of up to n * 50 bits per component of n states.
Result<RationalSolution> solve_in_rationals(const Mdp& mdp, const Solution& from,
                                            const RationalSettings& settings = {});

}  // namespace quoll
