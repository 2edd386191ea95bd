#pragma once
// Choosing actions while learning: a value with a switch inside. Every choice consumes the same
// draws (coin, action, tie), used or not, so that changing the exploration disturbs nobody else's
// dice.

#include <cstdint>
#include <string_view>

#include "quoll/act/rows.hpp"
#include "quoll/act/schedule.hpp"
#include "quoll/base/math.hpp"

namespace quoll {

inline constexpr std::string_view exploration_names[] = {"uniform", "greedy", "epsilon-greedy",
                                                         "softmax", "ucb"};
inline constexpr std::string_view exploration_summaries[] = {
    "each action with equal probability: the lecture's random choice",
    "the action with the largest Q; ties as --ties says",
    "greedy, but uniform with probability epsilon",
    "probability proportional to exp(Q / temperature)",
    "the largest Q + c * span * sqrt(ln N(s) / N(s,a)), untried actions first: the trade-off of "
    "Monte-Carlo tree search"};

/// The draws of one choice: two 64-bit words of the behaviour stream, mixed only when looked at.
struct ChoiceDraws {
  std::uint64_t first, second;  ///< states of the stream
  std::uint32_t coin() const { return static_cast<std::uint32_t>(mix(first) >> 32); }
  std::uint32_t action() const { return static_cast<std::uint32_t>(mix(first)); }
  std::uint32_t tie() const { return static_cast<std::uint32_t>(mix(second) >> 32); }
  std::uint32_t rounding() const { return static_cast<std::uint32_t>(mix(second)); }

  static ChoiceDraws of(Rng& behaviour) {
    behaviour.skip(2);
    return {behaviour.state - golden_gamma, behaviour.state};
  }
};

/// The choice: an action, and whether chance rather than Q decided for a non-greedy draw.
struct Chosen {
  Action action;
  bool explored;
};

/// The choices that a coin decides, for the loop over FourRows that has nothing else to ask:
/// uniform is epsilon 1, greedy epsilon 0. Same draws, same choices as Exploration. `always`: the
/// coin always says explore, so that nothing waits for the row.
template <bool first_tie, bool always>
struct CoinExploration {
  std::uint64_t threshold;  ///< explore when the 32-bit coin is below

  template <class Value>
  Chosen choose(const FourRows<Value>& rows, const Value*, const std::uint32_t*, State,
                const RowView<Value>& row, const ChoiceDraws& draws, std::uint64_t) const {
    if constexpr (always) return {rows.any(row, draws.action()), true};
    const bool explore = draws.coin() < threshold;
    const std::uint32_t all = 0u - std::uint32_t{explore};
    const std::uint32_t bits = (draws.action() & all) | (first_tie ? 0 : draws.tie() & ~all);
    return {rows.of(row.ties | (row.legal & all), bits), explore};
  }
};

struct Exploration {
  enum class Kind : std::uint8_t { uniform, greedy, epsilon_greedy, softmax, ucb };
  Kind kind = Kind::uniform;
  bool first_tie = false;  ///< ties to the lowest index instead of uniformly
  Schedule epsilon;        ///< epsilon-greedy
  Schedule temperature;    ///< softmax, in units of value
  double ucb_scale = 1.0;  ///< ucb: constant times the span of rewards

  /// True when CoinExploration with coin_threshold() makes the same choices.
  bool is_coin() const {
    return kind == Kind::uniform || kind == Kind::greedy ||
           (kind == Kind::epsilon_greedy && epsilon.constant());
  }
  std::uint64_t coin_threshold() const {
    if (kind == Kind::uniform) return std::uint64_t{1} << 32;
    if (kind == Kind::greedy) return 0;
    const double scaled = epsilon.from * 0x1p32;
    const auto whole = static_cast<std::uint64_t>(scaled);
    return whole + (static_cast<double>(whole) < scaled);
  }

  /// Chooses for `state`, whose row was seen as `row`. `visits` = visits per pair, same indices.
  template <class Rows, class Value>
  Chosen choose(const Rows& rows, const Value* values, const std::uint32_t* visits, State state,
                const RowView<Value>& row, const ChoiceDraws& draws, std::uint64_t step) const {
    switch (kind) {
      case Kind::uniform:
        return {rows.any(row, draws.action()), true};
      case Kind::epsilon_greedy: {
        const double e = epsilon.at(step);
        const bool explore = draws.coin() < e * 0x1p32;
        const Action greedy = best(rows, values, state, row, draws.tie());
        return {explore ? rows.any(row, draws.action()) : greedy, explore};
      }
      case Kind::softmax:
        return softmax(rows, values, state, row, draws, temperature.at(step));
      case Kind::ucb:
        return ucb(rows, values, visits, state, row, draws);
      case Kind::greedy:
        break;
    }
    return {best(rows, values, state, row, draws.tie()), false};
  }

 private:
  template <class Rows, class Value>
  Action best(const Rows& rows, const Value* values, State state, const RowView<Value>& row,
              std::uint32_t tie) const {
    return first_tie ? rows.first(values, state, row) : rows.pick(values, state, row, tie);
  }

  // Boltzmann: P(a) = exp((Q(s,a) - max) / T) / sum. The coin is cut at the running sums.
  template <class Rows, class Value>
  Chosen softmax(const Rows& rows, const Value* values, State state, const RowView<Value>& row,
                 const ChoiceDraws& draws, double heat) const {
    const Value* q = values + rows.pair(state, 0);
    const std::uint32_t legal = rows.legal(row);
    double sum = 0.0;
    for (Action a = 0; a < legal; ++a) {
      sum += math::exp((double{q[a]} - double{row.best}) / heat);
    }
    double rest = draws.coin() * 0x1p-32 * sum;
    Action a = 0;
    for (; a + 1 < legal; ++a) {
      rest -= math::exp((double{q[a]} - double{row.best}) / heat);
      if (rest < 0) break;
    }
    return {a, q[a] != row.best};
  }

  // UCB1 (Auer, Cesa-Bianchi, Fischer 2002) on the row, as UCT (Kocsis, Szepesvari 2006) does in a
  // tree.
  template <class Rows, class Value>
  Chosen ucb(const Rows& rows, const Value* values, const std::uint32_t* visits, State state,
             const RowView<Value>& row, const ChoiceDraws& draws) const {
    const Value* q = values + rows.pair(state, 0);
    const std::uint32_t legal = rows.legal(row);
    const std::uint32_t* n = visits + rows.pair(state, 0);
    std::uint64_t total = 0;
    std::uint32_t untried = 0;
    for (Action a = 0; a < legal; ++a) {
      total += n[a];
      untried += n[a] == 0;
    }
    if (untried > 0) {
      std::uint32_t k = first_tie ? 0 : scale(draws.tie(), untried);
      for (Action a = 0; a < legal; ++a) {
        if (n[a] == 0 && k-- == 0) return {a, true};
      }
    }
    const double log_total = math::log(static_cast<double>(total));
    Action choice = 0;
    double highest = -std::numeric_limits<double>::infinity();
    std::uint32_t ties = 0;
    const auto score = [&](Action a) {
      return double{q[a]} + ucb_scale * __builtin_sqrt(log_total / static_cast<double>(n[a]));
    };
    for (Action a = 0; a < legal; ++a) {
      const double value = score(a);
      if (value > highest) {
        highest = value;
        choice = a;
        ties = 1;
      } else {
        ties += value == highest;
      }
    }
    if (ties > 1 && !first_tie) {
      std::uint32_t k = scale(draws.tie(), ties);
      for (Action a = choice; a < legal; ++a) {
        if (score(a) == highest && k-- == 0) return {a, q[a] != row.best};
      }
    }
    return {choice, q[choice] != row.best};
  }
};

}  // namespace quoll
