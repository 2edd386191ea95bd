#pragma once
// Choosing an action from the values of one state, however they were found.

#include <span>

#include "quoll/act/exploration.hpp"
#include "quoll/act/rows.hpp"

namespace quoll {

/// Chooses among the actions whose values are given, at least one. Explorations that count visits
/// (ucb, count-bonus) cannot be asked here.
inline Chosen choose(const Exploration& exploration, std::span<const float> q,
                     const ChoiceDraws& draws, std::uint64_t step) {
  const std::uint64_t begin[] = {0, q.size()};
  const RaggedRows<float> rows{begin};
  return exploration.choose(rows, q.data(), nullptr, 0, rows.view(q.data(), 0), draws, step);
}

/// The action with the largest value, the first of several.
inline Action greedy(std::span<const float> q) {
  Action best = 0;
  for (Action a = 1; a < q.size(); ++a) {
    if (q[a] > q[best]) best = a;
  }
  return best;
}

}  // namespace quoll
