#include "quoll/env/table.hpp"

#include <algorithm>

namespace quoll {
namespace {

std::uint32_t packed(const Mdp& mdp, State next) {
  return next | (mdp.terminal(next) ? end_bit : 0);
}

// 2^64 * cumulative probability, saturating; the draw 0 belongs to the first outcome.
std::uint64_t threshold(double cumulative) {
  if (cumulative >= 1.0) return ~std::uint64_t{0};
  const double scaled = cumulative * 0x1p64;
  return scaled < 1.0 ? 0 : static_cast<std::uint64_t>(scaled) - 1;
}

// The largest number of outcomes of a choice, if it is at most `most` and padding at most doubles
// the table; else 0.
std::uint64_t common_width(const Mdp& mdp, std::uint64_t most) {
  std::uint64_t width = 1;
  for (std::uint64_t c = 0; c < mdp.choices(); ++c) {
    width = std::max(width, mdp.outcome_end(c) - mdp.outcome_begin(c));
  }
  const bool small = mdp.choices() * width <= 4096;
  return width <= most && (small || mdp.choices() * width <= 2 * mdp.outcomes()) ? width : 0;
}

}  // namespace

PairLayout pair_layout(const Mdp& mdp) {
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.actions(s) > 4) return {0, mdp.choices()};
  }
  if (mdp.states() > 64 && mdp.states() * 4 > 2 * mdp.choices()) return {0, mdp.choices()};
  return {4, mdp.states() * 4};
}

template <class Value>
DeterministicTable<Value> deterministic_table(const Mdp& mdp, PairLayout layout) {
  DeterministicTable<Value> table;
  table.moves.resize(layout.pairs);
  for (State s = 0; s < mdp.states(); ++s) {
    for (Action a = 0; a < mdp.actions(s); ++a) {
      const std::uint64_t choice = mdp.choice_begin(s) + a;
      const std::uint64_t outcome = mdp.outcome_begin(choice);
      table.moves[layout.pair(mdp, s, a)] = {packed(mdp, mdp.next(outcome)),
                                             static_cast<Value>(mdp.reward(choice, outcome))};
    }
  }
  return table;
}

template <class Value>
StochasticTable<Value> stochastic_table(const Mdp& mdp, PairLayout layout) {
  StochasticTable<Value> table;
  table.width = common_width(mdp, StochasticTable<Value>::short_row);
  if (table.width > 0) {
    table.moves.reserve(layout.pairs * table.width);
  } else {
    table.begin.reserve(layout.pairs + 1);
    table.moves.reserve(mdp.outcomes());
  }
  for (State s = 0; s < mdp.states(); ++s) {
    const Action row = layout.width == 0 ? mdp.actions(s) : layout.width;
    for (Action a = 0; a < row; ++a) {
      const std::size_t first = table.moves.size();
      if (table.width == 0) table.begin.push_back(first);
      if (a < mdp.actions(s)) {
        const std::uint64_t choice = mdp.choice_begin(s) + a;
        double cumulative = 0.0;
        for (std::uint64_t o = mdp.outcome_begin(choice); o < mdp.outcome_end(choice); ++o) {
          if (mdp.probability(o) <= 0.0) continue;
          cumulative += mdp.probability(o);
          table.moves.push_back({threshold(cumulative), packed(mdp, mdp.next(o)),
                                 static_cast<Value>(mdp.reward(choice, o))});
        }
        table.moves.back().threshold = ~std::uint64_t{0};
      }
      if (table.width > 0) table.moves.resize(first + table.width);
    }
  }
  if (table.width == 0) table.begin.push_back(table.moves.size());
  return table;
}

template DeterministicTable<float> deterministic_table<float>(const Mdp&, PairLayout);
template DeterministicTable<double> deterministic_table<double>(const Mdp&, PairLayout);
template StochasticTable<float> stochastic_table<float>(const Mdp&, PairLayout);
template StochasticTable<double> stochastic_table<double>(const Mdp&, PairLayout);

}  // namespace quoll
