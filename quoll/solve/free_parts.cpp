#include "quoll/solve/free_parts.hpp"

#include <algorithm>
#include <cmath>

#include "quoll/solve/growth.hpp"
#include "quoll/solve/rounding.hpp"
#include "quoll/solve/sweep.hpp"

// Balance: with V the optimum and C an end component of choices with r + P V = V, the differences
// of V are the only heights h with r + P h = h. Rounded to a coarse grid they are exact, if the
// true ones lie on it, and the equality can be checked without rounding.

namespace quoll {

namespace {

// The expected reward if no rounding and no doubt is in it, else not a number.
double certain_reward(const Mdp& mdp, std::uint64_t choice) {
  const double reward = mdp.reward(choice);
  bool certain = meant_exactly(reward);
  if (!mdp.arrays().outcome_reward.empty()) {
    double low = 0.0, high = 0.0;
    for (std::uint64_t o = mdp.outcome_begin(choice); o < mdp.outcome_end(choice); ++o) {
      const double p = mdp.probability(o), r = mdp.reward(choice, o);
      certain = certain && (meant_exactly(p) || r == 0.0) && meant_exactly(r);
      low = add_down(low, scale_down(p, r));
      high = add_up(high, scale_up(p, r));
    }
    certain = certain && low == reward && high == reward;
  }
  return certain ? reward : std::nan("");
}

}  // namespace

FreeParts::FreeParts(const Mdp& mdp, const std::vector<std::uint8_t>& live)
    : mdp_(mdp), live_(live) {
  std::vector<bool> allowed(mdp.choices(), false);
  for (State s = 0; s < mdp.states(); ++s) {
    if (live[s] == 0) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      bool free = keeps_to_live(c);
      for (std::uint64_t o = mdp.outcome_begin(c); free && o < mdp.outcome_end(c); ++o) {
        free = mdp.reward(c, o) == 0.0;
      }
      allowed[c] = free;
    }
  }
  parts_ = maximal_end_components(mdp, allowed);
}

bool FreeParts::keeps_to_live(std::uint64_t choice) const {
  for (std::uint64_t o = mdp_.outcome_begin(choice); o < mdp_.outcome_end(choice); ++o) {
    if (live_[mdp_.next(o)] == 0) return false;
  }
  return true;
}

bool FreeParts::balanced(State s, std::uint64_t choice) const {
  const double reward = certain_reward(mdp_, choice);
  return growth_up(mdp_, height_, 1.0, s, choice, reward) <= 0.0 &&
         growth_up(mdp_, height_, -1.0, s, choice, -reward) <= 0.0;
}

void FreeParts::balance(const std::vector<double>& value, double size) {
  const auto [low, high] = mdp_.reward_bounds();
  if (!(low < 0.0 && high > 0.0 && size < 1e280)) return;
  std::vector<bool> near(mdp_.choices(), false);
  for (State s = 0; s < mdp_.states(); ++s) {
    if (live_[s] == 0) continue;
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      if (!keeps_to_live(c)) continue;
      near[c] = std::fabs(backup(mdp_, 1.0, value.data(), c) - value[s]) <= 1e-9 * size;
    }
  }
  const EndComponents parts = maximal_end_components(mdp_, near);
  double scale = 0x1p-900;
  while (scale < size) scale *= 2.0;
  const double step = 0x1p-26 * scale;
  std::vector<double> base(parts.count, infinity);
  height_.assign(mdp_.states(), 0.0);
  bool level = true;
  for (State s = 0; s < mdp_.states(); ++s) {
    const std::uint32_t k = parts.component[s];
    if (k == no_component) continue;
    if (base[k] == infinity) base[k] = value[s];
    height_[s] = step * std::floor((value[s] - base[k]) / step + 0.5);
    level = level && height_[s] == 0.0;
  }
  if (level) {
    height_.clear();
    return;
  }
  for (State s = 0; s < mdp_.states(); ++s) {
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      near[c] = parts_.inside[c] || (parts.inside[c] && balanced(s, c));
    }
  }
  parts_ = maximal_end_components(mdp_, near);
  grid_ = 0x1p-40 * scale;
}

void FreeParts::share(std::vector<double>& number) const {
  if (count() == 0) return;
  std::vector<double> greatest(count(), -infinity);
  for (State s = 0; s < mdp_.states(); ++s) {
    if (part(s) != no_component) greatest[part(s)] = std::max(greatest[part(s)], number[s]);
  }
  for (State s = 0; s < mdp_.states(); ++s) {
    if (part(s) != no_component) number[s] = greatest[part(s)];
  }
}

template <class Round>
void FreeParts::level(std::vector<double>& value, double sign, Round round) const {
  if (count() == 0) return;
  std::vector<double> best(count(), -infinity);
  for (State s = 0; s < mdp_.states(); ++s) {
    const std::uint32_t k = part(s);
    if (k != no_component) best[k] = std::max(best[k], sign * (value[s] - height(s)));
  }
  for (double& b : best) b = height_.empty() ? sign * b : grid_ * round(sign * b / grid_);
  for (State s = 0; s < mdp_.states(); ++s) {
    if (part(s) != no_component) value[s] = best[part(s)] + height(s);
  }
}

void FreeParts::level_up(std::vector<double>& value) const {
  level(value, 1.0, [](double x) { return std::ceil(x); });
}

void FreeParts::level_down(std::vector<double>& value) const {
  level(value, -1.0, [](double x) { return std::floor(x); });
}

}  // namespace quoll
