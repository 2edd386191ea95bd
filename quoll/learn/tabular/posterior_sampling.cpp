// Posterior sampling. Strens 2000; Osband, Russo, Van Roy 2013 ("(More) efficient reinforcement
// learning via posterior sampling").
//
//   1   draw a model from the posterior: P(.|s,a) ~ Dirichlet(N(s,a,.) + 1/S),
//       r(s,a) ~ Normal(mean of R(s,a) and the prior, range^2 / (N(s,a) + 1))
//   2   act by the optimal policy of that model until the episode ends, or some N doubled
//   3   see (s, a, r, s'); count it
//   4   the answer: the optimal policy of the counted model
//
// The prior mean of a reward is the middle of its range, counted as one sample. Of the successors
// never seen one takes the mass of all. Without noise a pair that was tried is certain. Draws come
// from their own stream, a number of them that depends on the counts. Memory: 32 bytes for each
// (s, a, s') seen, and the model drawn.

#include <algorithm>
#include <cmath>

#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/model_learning.hpp"
#include "quoll/learn/tabular/posterior.hpp"
#include "quoll/learn/tabular/rules.hpp"

namespace quoll {
namespace {

class PosteriorSampling {
 public:
  using Value = double;
  static constexpr bool looks_ahead = false;

  PosteriorSampling(const LearnSetup& setup, const ValueTable<double>& table)
      : begin_(table.begin()),
        planning_(known_pairs_only(setup)),
        posterior_{setup.rewards->low(), setup.rewards->high(), setup.world->traits.deterministic},
        dice_(stream(setup.seed, "posterior")),
        model_(table.pairs()),
        pair_value_(table.pairs(), 0.0) {}

  // 2
  Chosen choose(const ValueTable<double>&, State s, const ChoiceDraws& draws, std::uint64_t) {
    if (stale_) {
      // 1
      std::vector<double> drawn = posterior_.draw(model_, begin_, planning_, dice_);
      if (!drawn.empty()) pair_value_ = std::move(drawn);
      stale_ = false;
    }
    const RaggedRows<double> rows{begin_.data()};
    const RowView<double> row = rows.view(pair_value_.data(), s);
    return {rows.pick(pair_value_.data(), s, row, draws.tie()), false};
  }

  // 3
  Change learn(const Step& step, ValueTable<double>& table, const ChoiceDraws&) {
    count(model_, step);
    const std::uint32_t n = model_.tried(step.pair);
    stale_ = stale_ || (n & (n - 1)) == 0;
    const double best_next = table.best_after(step.carry, step.next);
    const double target =
        model_.backup(step.pair, planning_.discount, [&](State y) { return table.best(y); });
    table.set(step.state, step.pair, target);
    return {best_next, target, 1.0};
  }
  void end_episode(ValueTable<double>&) { stale_ = true; }

  // 4
  void estimates(const ValueTable<double>& table, Estimates& out) const {
    tell(plan(model_, table.begin(), planning_), out);
  }

  void persist(Archive& archive) {
    model_.persist(archive, begin_.size() - 1);
    const std::size_t pairs = pair_value_.size();
    archive("dice", dice_);
    archive("pair_value", pair_value_);
    archive("stale", stale_);
    if (pair_value_.size() == pairs) return;
    archive.fail("values of another world");
    pair_value_.resize(pairs);
  }

 private:
  const std::vector<std::uint64_t>& begin_;
  Planning planning_;
  Posterior posterior_;
  Rng dice_;
  CountedModel model_;
  std::vector<double> pair_value_;  // optimal in the model drawn last
  bool stale_ = true;
};

std::unique_ptr<Learner> make(const LearnSetup& setup) {
  return std::make_unique<MethodLearner<PosteriorSampling>>(setup);
}

}  // namespace

const LearnerEntry posterior_sampling{
    .method = "posterior-sampling",
    .rule = "",
    .summary = "acts by the optimal policy of a model drawn from what experience leaves possible",
    .sound = true,
    .make = make,
    .replay = nullptr,
    .traits = {.plans = true, .directed = true, .ignores = "step_size, precision, explore, ties"},
    .check = needs_value_range,
    .formula =
        "Q(s,a) := mean of r + discount * max Q(s',.) over the counts of (s, a); acts by the "
        "solution for P(.|s,a) drawn from Dirichlet(N(s,a,.) + 1/S)"};

}  // namespace quoll
