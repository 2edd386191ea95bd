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

inline constexpr std::string_view exploration_names[] = {
    "uniform", "greedy", "epsilon-greedy", "softmax", "ucb", "count-bonus", "mellowmax"};
inline constexpr std::string_view exploration_summaries[] = {
    "each action with equal probability: the lecture's random choice",
    "the action with the largest Q; ties as --ties says",
    "greedy, but uniform with probability epsilon",
    "probability proportional to exp(Q / temperature)",
    "the largest Q + c * span * sqrt(ln N(s) / N(s,a)), untried actions first: the trade-off of "
    "Monte-Carlo tree search",
    "the largest Q + c * span / sqrt(N(s,a)), untried actions first: rare actions look better",
    "softmax at the temperature that a bounded mean of Q asks for, chosen anew in each state"};

/// The draws of one choice: two 64-bit words of the behaviour stream, mixed only when looked at.
struct ChoiceDraws {
  std::uint64_t first, second;  ///< states of the stream
  std::uint32_t coin() const { return static_cast<std::uint32_t>(mix(first) >> 32); }
  std::uint32_t action() const { return static_cast<std::uint32_t>(mix(first)); }
  std::uint32_t tie() const { return static_cast<std::uint32_t>(mix(second) >> 32); }
  std::uint32_t rounding() const { return static_cast<std::uint32_t>(mix(second)); }
  /// More words of the same choice, for methods that toss coins of their own.
  std::uint32_t own(std::uint64_t which = 0) const {
    return static_cast<std::uint32_t>(mix(mix(first) + which) >> 32);
  }

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
  enum class Kind : std::uint8_t {
    uniform,
    greedy,
    epsilon_greedy,
    softmax,
    ucb,
    count_bonus,
    mellowmax
  };
  Kind kind = Kind::uniform;
  bool first_tie = false;    ///< ties to the lowest index instead of uniformly
  Schedule epsilon;          ///< epsilon-greedy
  Schedule temperature;      ///< softmax, in units of value
  double ucb_scale = 1.0;    ///< ucb: constant times the span of rewards
  double count_scale = 1.0;  ///< count-bonus: constant times the span of rewards
  double omega = 1.0;        ///< mellowmax, per unit of value

  std::string_view name() const { return exploration_names[static_cast<std::size_t>(kind)]; }
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
      case Kind::mellowmax: {
        const Values<Value> q = row_of(rows, values, visits, state, row);
        return softmax(q, draws, heat(q, step));
      }
      case Kind::ucb:
      case Kind::count_bonus:
        return best_score(row_of(rows, values, visits, state, row), draws);
      case Kind::greedy:
        break;
    }
    return {best(rows, values, state, row, draws.tie()), false};
  }

  /// share[a] = the probability with which choose() takes action a, for each action of `state`.
  template <class Rows, class Value>
  void probabilities(const Rows& rows, const Value* values, const std::uint32_t* visits,
                     State state, const RowView<Value>& row, std::uint64_t step,
                     double* share) const {
    const Values<Value> q = row_of(rows, values, visits, state, row);
    if (kind == Kind::softmax || kind == Kind::mellowmax) {
      const double hot = heat(q, step);
      double sum = 0.0;
      for (Action a = 0; a < q.legal; ++a) sum += share[a] = q.weight(a, hot);
      for (Action a = 0; a < q.legal; ++a) share[a] /= sum;
      return;
    }
    const bool scored = kind == Kind::ucb || kind == Kind::count_bonus;
    const Leaders lead = scored ? leaders(q) : Leaders{};
    const double chance = kind == Kind::uniform          ? 1.0
                          : kind == Kind::epsilon_greedy ? epsilon.at(step)
                                                         : 0.0;
    const auto leads = [&](Action a) {
      return scored ? score(q, lead.log_total, a) == lead.score : q.value[a] == q.best;
    };
    std::uint32_t ties = 0;
    for (Action a = 0; a < q.legal; ++a) ties += leads(a);
    if (first_tie) ties = 1;
    std::uint32_t left = ties;
    for (Action a = 0; a < q.legal; ++a) {
      share[a] = chance / q.legal;
      if (left > 0 && leads(a)) {
        share[a] += (1.0 - chance) / ties;
        --left;
      }
    }
  }

 private:
  template <class Value>
  struct Values {
    const Value* value;
    const std::uint32_t* visits;
    std::uint32_t legal;
    Value best;

    // exp((Q(s,a) - max) / T).
    double weight(Action a, double heat) const {
      return math::exp((double{value[a]} - double{best}) / heat);
    }
  };

  template <class Rows, class Value>
  static Values<Value> row_of(const Rows& rows, const Value* values, const std::uint32_t* visits,
                              State state, const RowView<Value>& row) {
    const std::uint64_t first = rows.pair(state, 0);
    return {values + first, visits + first, rows.legal(row), row.best};
  }

  template <class Rows, class Value>
  Action best(const Rows& rows, const Value* values, State state, const RowView<Value>& row,
              std::uint32_t tie) const {
    return first_tie ? rows.first(values, state, row) : rows.pick(values, state, row, tie);
  }

  template <class Value>
  double heat(const Values<Value>& q, std::uint64_t step) const {
    return kind == Kind::softmax ? temperature.at(step) : mellow_heat(q);
  }

  // Boltzmann: P(a) = exp((Q(s,a) - max) / T) / sum. The coin is cut at the running sums.
  template <class Value>
  [[gnu::noinline]] static Chosen softmax(const Values<Value>& q, const ChoiceDraws& draws,
                                          double heat) {
    double sum = 0.0;
    for (Action a = 0; a < q.legal; ++a) sum += q.weight(a, heat);
    double rest = draws.coin() * 0x1p-32 * sum;
    Action a = 0;
    for (; a + 1 < q.legal; ++a) {
      rest -= q.weight(a, heat);
      if (rest < 0) break;
    }
    return {a, q.value[a] != q.best};
  }

  // Asadi, Littman 2017 ("An alternative softmax operator for reinforcement learning"), section 4:
  // the policy of largest entropy whose mean is mm = log(mean of exp(omega Q)) / omega is softmax
  // at temperature 1 / beta, where sum_a exp(beta (Q(a) - mm)) (Q(a) - mm) = 0. With d = max - mm
  // and y = beta d the root lies in [0, max(1, log n)]: there y e^y > (n - 1) / e, the most that
  // the terms below mm can take away. 33 n exponentials.
  template <class Value>
  [[gnu::noinline]] double mellow_heat(const Values<Value>& q) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double mean = 0.0;
    for (Action a = 0; a < q.legal; ++a) mean += q.weight(a, 1.0 / omega);
    const double d = -math::log(mean / q.legal) / omega;
    if (!(d > 0.0)) return infinity;  // all alike: any temperature does
    double low = 0.0, high = math::log(static_cast<double>(q.legal));
    if (high < 1.0) high = 1.0;
    for (int i = 0; i < 32; ++i) {
      const double y = 0.5 * (low + high);
      double sum = 0.0;
      for (Action a = 0; a < q.legal; ++a) {
        sum += q.weight(a, d / y) * (double{q.value[a]} - double{q.best} + d);
      }
      (sum < 0.0 ? low : high) = y;
    }
    return d / (0.5 * (low + high));
  }

  // The largest score of a row; the actions that attain it are as good as each other.
  struct Leaders {
    double score = 0.0, log_total = 0.0;
    Action first = 0;
    std::uint32_t ties = 0;
  };

  // UCB1 (Auer, Cesa-Bianchi, Fischer 2002) on the row, as UCT (Kocsis, Szepesvari 2006) does in a
  // tree; or a bonus that falls with the action's own count alone (Strehl, Littman 2008). What was
  // never tried comes first.
  template <class Value>
  double score(const Values<Value>& q, double log_total, Action a) const {
    const auto n = static_cast<double>(q.visits[a]);
    if (q.visits[a] == 0) return std::numeric_limits<double>::infinity();
    const double value = double{q.value[a]};
    if (kind == Kind::count_bonus) return value + count_scale / __builtin_sqrt(n);
    return value + ucb_scale * __builtin_sqrt(log_total / n);
  }

  template <class Value>
  Leaders leaders(const Values<Value>& q) const {
    Leaders lead;
    lead.score = -std::numeric_limits<double>::infinity();
    std::uint64_t total = 0;
    for (Action a = 0; a < q.legal; ++a) total += q.visits[a];
    if (kind == Kind::ucb) lead.log_total = math::log(static_cast<double>(total));
    for (Action a = 0; a < q.legal; ++a) {
      const double value = score(q, lead.log_total, a);
      if (value > lead.score) {
        lead = {value, lead.log_total, a, 1};
      } else {
        lead.ties += value == lead.score;
      }
    }
    return lead;
  }

  template <class Value>
  [[gnu::noinline]] Chosen best_score(const Values<Value>& q, const ChoiceDraws& draws) const {
    const Leaders lead = leaders(q);
    Action choice = lead.first;
    if (lead.ties > 1 && !first_tie) {
      std::uint32_t k = scale(draws.tie(), lead.ties);
      while (score(q, lead.log_total, choice) != lead.score || k-- > 0) ++choice;
    }
    return {choice, q.visits[choice] == 0 || q.value[choice] != q.best};
  }
};

}  // namespace quoll
