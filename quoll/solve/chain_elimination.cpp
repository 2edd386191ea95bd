#include "quoll/solve/chain_elimination.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "quoll/solve/rounding.hpp"

// State elimination without subtraction: Grassmann, Taksar and Heyman 1985; order of least degree:
// Markowitz 1957; bounds from an inductive error: Rump 2010 (Verification methods).
//
//   1  for s in order of least |in(s)| |out(s)|:  d_s <- e_s + sum of p_sj, j != s;  for all
//      i in in(s), j in out(s): p_ij += p_is p_sj / d_s;  e_i += p_is e_s / d_s
//   2  x = (I - P)^-1 b: forward b_i += p_is b_s / d_s, then backward x_s = (b_s + p_sj x_j) / d_s
//   3  V <- V + (I - P)^-1 rho(V), rho(V) = r + sum of p (V(s') - V(s)), V kept as two doubles
//   4  b >= |rho| for every model whose numbers round to the stored ones; E <- (I - P)^-1 b, a
//      little larger; if b + P E <= E, checked with outward rounding, then |V_pi - V| <= E
//
// p, e: rows_, to_end_; d: pivot; V: value_ + rest_; b: doubt; E: error.

namespace quoll {

namespace {

struct Entry {
  State state;
  double probability;
};

// What is left of an eliminated state.
struct Step {
  State state = 0;
  double inverse = 0.0;     // 1 / d
  std::vector<Entry> into;  // p_is
  std::vector<Entry> out;   // p_sj
};

class Elimination {
 public:
  Elimination(const Mdp& chain, const std::vector<std::uint8_t>& live)
      : rows_(chain.states()),
        columns_(chain.states()),
        to_end_(chain.states(), 0.0),
        place_(chain.states(), nowhere),
        gone_(chain.states(), 1) {
    for (State s = 0; s < chain.states(); ++s) {
      if (live[s] == 0) continue;
      gone_[s] = 0;
      const std::uint64_t c = chain.choice_begin(s);
      for (std::uint64_t o = chain.outcome_begin(c); o < chain.outcome_end(c); ++o) {
        const State next = chain.next(o);
        if (live[next] == 0) {
          to_end_[s] += chain.probability(o);
        } else if (next != s) {
          add(s, next, chain.probability(o));
        }
      }
      clear(s);
    }
  }

  // Step 1.
  bool run(const std::function<bool(std::uint64_t)>& keep_going) {
    for (State s = 0; s < gone_.size(); ++s) {
      if (gone_[s] == 0) order_.push({cost(s), s});
    }
    constexpr std::uint64_t most_work = 2'000'000'000;
    while (!order_.empty()) {
      const auto [least, s] = order_.top();
      order_.pop();
      if (gone_[s] != 0 || least != cost(s)) continue;
      work_ += least;
      if (work_ > most_work || !remove(s)) return false;
      if (keep_going && steps_.size() % 256 == 0 && !keep_going(steps_.size())) return false;
    }
    return true;
  }

  // Step 2, in place.
  void solve(std::vector<double>& b) const {
    for (const Step& step : steps_) {
      const double share = b[step.state] * step.inverse;
      for (const Entry& from : step.into) b[from.state] += from.probability * share;
    }
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
      double sum = b[step->state];
      for (const Entry& to : step->out) sum += to.probability * b[to.state];
      b[step->state] = sum * step->inverse;
    }
  }

 private:
  static constexpr std::uint32_t nowhere = ~std::uint32_t{0};
  using Ranked = std::pair<std::uint64_t, State>;

  std::uint64_t cost(State s) const { return (rows_[s].size() + 1) * (columns_[s].size() + 1); }

  // place_ holds where the entries of row i are, between the first add() and clear(i).
  void add(State i, State j, double probability) {
    if (place_[j] == nowhere) {
      place_[j] = static_cast<std::uint32_t>(rows_[i].size());
      rows_[i].push_back({j, probability});
      columns_[j].push_back(i);
    } else {
      rows_[i][place_[j]].probability += probability;
    }
  }
  void clear(State i) {
    for (const Entry& entry : rows_[i]) place_[entry.state] = nowhere;
  }

  bool remove(State s) {
    Step step;
    step.state = s;
    step.out = std::move(rows_[s]);
    double pivot = to_end_[s];
    for (const Entry& to : step.out) pivot += to.probability;
    if (!(pivot > 0.0)) return false;
    step.inverse = 1.0 / pivot;
    gone_[s] = 1;
    for (const Entry& to : step.out) std::erase(columns_[to.state], s);
    for (const State i : columns_[s]) {
      std::vector<Entry>& row = rows_[i];
      const auto found =
          std::find_if(row.begin(), row.end(), [&](const Entry& e) { return e.state == s; });
      const double probability = found->probability;
      *found = row.back();
      row.pop_back();
      step.into.push_back({i, probability});
      const double share = probability * step.inverse;
      to_end_[i] += share * to_end_[s];
      for (std::uint32_t k = 0; k < row.size(); ++k) place_[row[k].state] = k;
      for (const Entry& to : step.out) {
        if (to.state != i) add(i, to.state, share * to.probability);
      }
      clear(i);
    }
    for (const Entry& from : step.into) order_.push({cost(from.state), from.state});
    for (const Entry& to : step.out) order_.push({cost(to.state), to.state});
    columns_[s] = {};
    steps_.push_back(std::move(step));
    return true;
  }

  std::vector<std::vector<Entry>> rows_;
  std::vector<std::vector<State>> columns_;
  std::vector<double> to_end_;
  std::vector<std::uint32_t> place_;
  std::vector<std::uint8_t> gone_;
  std::vector<Step> steps_;
  std::priority_queue<Ranked, std::vector<Ranked>, std::greater<>> order_;
  std::uint64_t work_ = 0;
};

// A sum that keeps what rounding takes from it.
struct CarefulSum {
  double sum = 0.0;
  double low = 0.0;
  double low_size = 0.0;

  void add(double x) {
    const double before = sum;
    sum = before + x;
    add_low(sum_error(before, x, sum));
  }
  void add_low(double x) {
    low += x;
    low_size += std::fabs(x);
  }
  void add_product(double p, double x) {
    const double product = p * x;
    add(product);
    if (x != 0.0 && p != 1.0) add_low(product_error(p, x, product));
  }
};

struct Doubtful {
  double value;
  double doubt;  // the true number is at most this far away
};

class ChainProver {
 public:
  ChainProver(const Mdp& chain, const std::vector<std::uint8_t>& live)
      : chain_(chain), live_(live), value_(chain.states(), 0.0), rest_(chain.states(), 0.0) {
    const auto [low, high] = chain.reward_bounds();
    reward_size_ = std::max(std::fabs(low), std::fabs(high));
  }

  ChainValues run(const Elimination& elimination) {
    const std::size_t states = chain_.states();
    std::vector<double> b(states, 0.0);
    constexpr int rounds = 3;  // each gains the 10 digits or more that elimination keeps
    for (int k = 0; k < rounds; ++k) {
      for (State s = 0; s < states; ++s) b[s] = live_[s] != 0 ? residual(s).value : 0.0;
      elimination.solve(b);
      for (State s = 0; s < states; ++s) {
        const double more = rest_[s] + b[s];
        const double sum = value_[s] + more;
        rest_[s] = sum_error(value_[s], more, sum);
        value_[s] = sum;
      }
    }
    for (State s = 0; s < states; ++s) {
      if (live_[s] == 0) continue;
      const Doubtful rho = residual(s);
      b[s] = add_up(std::fabs(rho.value), rho.doubt);
    }
    std::vector<double> error = b;
    elimination.solve(error);
    for (double factor = 1.001; factor < 10.0; factor *= 2.0) {
      if (grown(b, error, factor)) return bounds(error);
    }
    return of_first_moves();
  }

 private:
  // What the first moves earn bounds the whole where rewards have one sign.
  ChainValues of_first_moves() const {
    ChainValues out = unbounded_values(live_);
    const auto [low, high] = chain_.reward_bounds();
    if (high <= 0.0) out.upper = fallen(1.0);
    if (low >= 0.0) {
      out.lower = fallen(-1.0);
      for (double& x : out.lower) x = -x;
    }
    return out;
  }

  // x >= sign * V, which is at most 0: from x = 0 on, as every sweep keeps it.
  std::vector<double> fallen(double sign) const {
    constexpr std::uint64_t work = 20'000'000, most_sweeps = 10'000;
    std::vector<double> x(chain_.states(), 0.0);
    const std::uint64_t sweeps = std::min(most_sweeps, work / (chain_.outcomes() + 1));
    for (std::uint64_t k = 0; k < sweeps; ++k) {
      for (State s = 0; s < chain_.states(); ++s) {
        if (live_[s] == 0) continue;
        const std::uint64_t c = chain_.choice_begin(s);
        double sum = sign * chain_.reward(c), outcomes = 0.0;
        for (std::uint64_t o = chain_.outcome_begin(c); o < chain_.outcome_end(c); ++o) {
          const double p = chain_.probability(o);
          const double least = meant_exactly(p) ? p : p * (1.0 - 16.0 * half_ulp);
          sum = add_up(sum, scale_up(least, x[chain_.next(o)]));
          outcomes += 1.0;
        }
        // Rewards were averaged with rounding.
        x[s] = std::min(x[s], add_up(sum, (outcomes + 3.0) * 2.0 * half_ulp * reward_size_));
      }
    }
    return x;
  }

  // rho of one state and what is not known of it.
  Doubtful residual(State s) const {
    const std::uint64_t c = chain_.choice_begin(s);
    CarefulSum sum;
    sum.add(chain_.reward(c));
    double outcomes = 0.0;
    double doubt = 0.0;
    double size = 0.0;
    for (std::uint64_t o = chain_.outcome_begin(c); o < chain_.outcome_end(c); ++o) {
      const State next = chain_.next(o);
      const double p = chain_.probability(o);
      const double step = value_[next] - value_[s];
      const double left = sum_error(value_[next], -value_[s], step) + (rest_[next] - rest_[s]);
      sum.add_product(p, step);
      sum.add_low(p * left);
      // A product of a choice's and an outcome's probability is rounded up to three times.
      if (!meant_exactly(p)) doubt += 8.0 * half_ulp * p * (std::fabs(step) + std::fabs(left));
      size += std::fabs(left);
      outcomes += 1.0;
    }
    const double value = sum.sum + sum.low;
    // Rewards were averaged with rounding; so were the parts of the sum.
    doubt += (outcomes + 3.0) * 2.0 * half_ulp * reward_size_;
    doubt += (4.0 * outcomes + 8.0) * 2.0 * half_ulp * (sum.low_size + size);
    doubt += 2.0 * half_ulp * std::fabs(value) + 1e-290;
    return {value, doubt * (1.0 + 64.0 * (outcomes + 4.0) * half_ulp)};
  }

  // Step 4: whether factor * error is inductive.
  bool grown(const std::vector<double>& b, std::vector<double> error, double factor) {
    for (double& e : error) e *= factor;
    for (State s = 0; s < chain_.states(); ++s) {
      if (live_[s] == 0) continue;
      const std::uint64_t c = chain_.choice_begin(s);
      double sum = b[s];
      for (std::uint64_t o = chain_.outcome_begin(c); o < chain_.outcome_end(c); ++o) {
        const double step = add_up(error[chain_.next(o)], -error[s]);
        const double p = chain_.probability(o);
        const double doubt = meant_exactly(p) ? 0.0 : 8.0 * half_ulp;
        sum = add_up(sum, scale_up(p, step));
        sum = add_up(sum, 2.0 * doubt * p * std::fabs(step));
      }
      if (!(sum <= 0.0)) return false;
    }
    factor_ = factor;
    return true;
  }

  ChainValues bounds(const std::vector<double>& error) const {
    ChainValues out{std::vector<double>(chain_.states(), 0.0), {}};
    out.upper = out.lower;
    for (State s = 0; s < chain_.states(); ++s) {
      if (live_[s] == 0) continue;
      const double e = error[s] * factor_;
      out.lower[s] = add_down(value_[s], add_down(rest_[s], -e));
      out.upper[s] = add_up(value_[s], add_up(rest_[s], e));
    }
    return out;
  }

  const Mdp& chain_;
  const std::vector<std::uint8_t>& live_;
  std::vector<double> value_;
  std::vector<double> rest_;
  double reward_size_ = 0.0;
  double factor_ = 1.0;
};

}  // namespace

ChainValues unbounded_values(const std::vector<std::uint8_t>& live) {
  ChainValues out{std::vector<double>(live.size(), 0.0), {}};
  out.upper = out.lower;
  for (std::size_t s = 0; s < live.size(); ++s) {
    if (live[s] == 0) continue;
    out.lower[s] = -infinity;
    out.upper[s] = infinity;
  }
  return out;
}

std::optional<ChainValues> eliminate_chain(const Mdp& chain, const std::vector<std::uint8_t>& live,
                                           const std::function<bool(std::uint64_t)>& keep_going) {
  const auto [low, high] = chain.reward_bounds();
  if (low == 0.0 && high == 0.0) {
    const std::vector<double> zero(chain.states(), 0.0);
    return ChainValues{zero, zero};
  }
  Elimination elimination(chain, live);
  if (!elimination.run(keep_going)) return std::nullopt;
  return ChainProver(chain, live).run(elimination);
}

}  // namespace quoll
