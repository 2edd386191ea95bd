#pragma once
// Sparse linear systems without rounding. Only builds that found GMP define these functions.

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "quoll/solve/rational.hpp"

namespace quoll {

/// x = P x + b for the states of a Markov chain that may leave them, where P is not negative and no
/// row sums to more than 1.
class RationalSystem {
 public:
  explicit RationalSystem(std::size_t size) : row_(size), right_(size), column_(size) {}

  /// Row i: P(i, j) for some j, each once, and b(i).
  void set_row(std::size_t i, const std::map<std::size_t, Rational>& p, Rational b);

  enum class Outcome : unsigned char { solved, endless, stopped };
  /// Solves for x, once. endless: some states are never left, so that x is not determined. Calls
  /// keep_going now and then with the number of unknowns that are done; false stops the work.
  Outcome solve(std::vector<Rational>& x, const std::function<bool(std::size_t)>& keep_going);

 private:
  std::size_t cheapest(const std::set<std::size_t>& open) const;
  bool eliminate(std::size_t k);

  std::vector<std::map<std::size_t, Integer>> row_;
  std::vector<Rational> right_;
  std::vector<std::set<std::size_t>> column_;  // rows other than k that hold x_k
};

}  // namespace quoll
