#include "quoll/learn/tabular/posterior.hpp"

#include <algorithm>
#include <cmath>

#include "quoll/base/math.hpp"
#include "quoll/base/normal.hpp"
#include "quoll/learn/tabular/model_writer.hpp"
#include "quoll/solve/optimality.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {

double draw_gamma(double shape, Rng& dice) {
  if (shape < 1.0) {
    const double whole = draw_gamma(shape + 1.0, dice);
    return whole * math::pow(1.0 - dice.uniform(), 1.0 / shape);
  }
  const double d = shape - 1.0 / 3.0, c = 1.0 / std::sqrt(9.0 * d);
  for (;;) {
    const double x = draw_normal(dice);
    const double root = 1.0 + c * x;
    const double u = 1.0 - dice.uniform();
    if (root <= 0.0) continue;
    const double v = root * root * root;
    if (math::log(u) < 0.5 * x * x + d - d * v + d * math::log(v)) return d * v;
  }
}

namespace {

struct Drawn {
  State next;
  double weight;
};

// P(.|s,a) ~ Dirichlet(N(s,a,.) + 1/S); all that was never seen goes to one of the S states.
void draw_successors(const CountedModel& model, std::uint64_t pair, std::uint64_t states, Rng& dice,
                     std::vector<Drawn>& drawn) {
  drawn.clear();
  const double prior = 1.0 / static_cast<double>(states);
  double sum = 0.0;
  model.each(pair, [&](const CountedModel::Outcome& seen) {
    drawn.push_back({seen.next, draw_gamma(seen.count + prior, dice)});
    sum += drawn.back().weight;
  });
  const double unseen =
      prior * static_cast<double>(states - std::min<std::uint64_t>(drawn.size(), states - 1));
  const State other = dice.below(static_cast<std::uint32_t>(states));
  drawn.push_back({other, draw_gamma(unseen, dice)});
  sum += drawn.back().weight;
  for (Drawn& one : drawn) one.weight /= sum;
}

}  // namespace

std::vector<double> Posterior::draw(const CountedModel& model,
                                    const std::vector<std::uint64_t>& begin,
                                    const Planning& planning, Rng& dice) const {
  const std::uint64_t states = begin.size() - 1;
  ModelWriter writer(states, begin.back());
  std::vector<Drawn> drawn;
  for (State s = 0; s < states; ++s) {
    writer.begin_state();
    for (std::uint64_t pair = begin[s]; pair < begin[s + 1]; ++pair) {
      const std::uint32_t n = model.tried(pair);
      if (certain && n > 0) {
        writer.take(model, pair, 0.0);
        continue;
      }
      draw_successors(model, pair, states, dice, drawn);
      for (const Drawn& one : drawn) writer.outcome(one.next, one.weight);
      double sum = (low + high) / 2;
      model.each(pair, [&](const CountedModel::Outcome& seen) { sum += seen.reward_sum; });
      const double spread = (high - low) / std::sqrt(n + 1.0);
      writer.finish_choice(sum / (n + 1.0) + spread * draw_normal(dice));
    }
  }
  // Drawn models need not end: at discount 1 they are planned for a thousand steps ahead.
  const double discount = std::min(planning.discount, 0.999);
  const Result<Mdp> mdp = writer.model(discount);
  if (!mdp) return {};
  SolveSettings settings;
  settings.width = 1e-3 * (high - low);
  const Result<Solution> solution = solve(*mdp, settings);
  if (!solution) return {};
  std::vector<double> value(begin.back());
  for (State s = 0; s < states; ++s) {
    const std::uint64_t first = mdp->choice_begin(s);
    for (std::uint64_t pair = begin[s]; pair < begin[s + 1]; ++pair) {
      value[pair] = q_star(*mdp, solution->lower, first + pair - begin[s], discount);
    }
  }
  return value;
}

}  // namespace quoll
