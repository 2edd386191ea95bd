#include "quoll/solve/span_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "quoll/solve/rounding.hpp"

namespace quoll {

ModelScale::ModelScale(const Mdp& mdp) {
  const auto [low, high] = mdp.reward_bounds();
  reward_size = std::max(std::fabs(low), std::fabs(high));
  for (State s = 0; s < mdp.states() && !has_ends; ++s) has_ends = mdp.terminal(s);
  if (mdp.deterministic()) return;
  for (std::uint64_t c = 0; c < mdp.choices(); ++c) {
    double sum = 0.0;
    for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
      sum += mdp.probability(o);
    }
    most_outcomes = std::max(most_outcomes, mdp.outcome_end(c) - mdp.outcome_begin(c));
    least_row_sum = std::min(least_row_sum, sum);
    greatest_row_sum = std::max(greatest_row_sum, sum);
  }
  const double doubt = 2.0 * half_ulp * static_cast<double>(most_outcomes);
  least_row_sum -= doubt;
  greatest_row_sum += doubt;
}

double sweep_error(const ModelScale& scale, double size) {
  const double operations = static_cast<double>(scale.most_outcomes) + 8.0;
  const double magnitude = scale.reward_size + scale.greatest_row_sum * size;
  return 4.0 * half_ulp * operations * magnitude + 1e-300;
}

// With e = sweep_error, W' = computed W and M' >= true W - V: the constant k that makes W' + k
// inductive solves k = e + g rho (M' + k), rho being the row sum that makes it largest. The
// factor 4 leaves room for the rounding of W' + k and of a checker's own sweep.
SpanBounds span_bounds(const ModelScale& scale, double discount, double least, double greatest,
                       double size) {
  if (scale.reward_size == 0.0 && size == 0.0) return {0.0, 0.0, 0.0};  // all is exactly 0
  const double error = sweep_error(scale, size);
  if (scale.has_ends) {
    least = std::min(least, 0.0);
    greatest = std::max(greatest, 0.0);
  }
  const double factor = Discount(discount).upper;
  const auto constant = [&](double difference) {  // the upper constant; the lower one by symmetry
    double worst = -infinity;
    for (const double row_sum : {scale.least_row_sum, scale.greatest_row_sum}) {
      for (const double g : {factor * row_sum, Discount(discount).lower * row_sum}) {
        const double rest = next_down(1.0 - next_up(g));
        if (!(rest > 0.0)) return infinity;
        const double sum = error + g * (difference + 2.0 * error);
        worst = std::max(worst, sum / (sum >= 0.0 ? rest : next_up(1.0 - next_down(g))));
      }
    }
    return worst + 4.0 * half_ulp * std::fabs(worst) + error;
  };
  const double rest = 1.0 - factor * scale.greatest_row_sum;
  const double rounding = rest > 0.0 ? 8.0 * error / rest : infinity;
  return {-constant(-least), constant(greatest), rounding};
}

// For a constant U >= 0: r + g rho U + e <= U if U = (r + e) / (1 - g rho), e being the error of a
// sweep over values of the size of U.
StartBounds start_bounds(const ModelScale& scale, double discount, const Mdp& mdp) {
  const double rest = next_down(1.0 - next_up(Discount(discount).upper * scale.greatest_row_sum));
  if (!(rest > 0.0)) return {-infinity, infinity};
  const auto constant = [&](double reward) {
    if (!(reward > 0.0)) return 0.0;
    const double operations = static_cast<double>(scale.most_outcomes) + 8.0;
    const double size = reward / rest;
    return (reward + 8.0 * half_ulp * operations * (reward + size)) / rest;
  };
  const auto [low, high] = mdp.reward_bounds();
  return {-constant(-low), constant(high)};
}

}  // namespace quoll
