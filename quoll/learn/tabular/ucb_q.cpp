// Q-learning with upper confidence bounds, for discounted worlds. Jin, Allen-Zhu, Bubeck, Jordan
// 2018 ("Is Q-learning provably efficient?"); Dong, Wang, Chen, Wang 2019 (arXiv 1901.09311),
// algorithm 1, with a bonus for use instead of the one of the proof.
//
//   Q, Q^ <- Qmax = the most that any policy can earn
//   for each episode: s <- start()
//     until s is an end or the episode is cut off:
//   1   a <- argmax_a Q^(s,a), ties at random; see r and s'; k <- N(s,a) <- N(s,a) + 1
//   2   b <- c range sqrt(H / k)
//   3   Q(s,a) <- Q(s,a) + alpha(k) (r + b + gamma max_a' Q^(s',a') - Q(s,a))
//   4   Q^(s,a) <- min(Q^(s,a), Q(s,a));  s <- s'
//
// c -> ucb_bonus; H -> horizon(discount); range -> that of the rewards; alpha -> StepSize, (H + 1)
// / (H + k) under noise; gamma, 0 after the end -> carry; Q^ -> the table. In a deterministic world
// one step tells all: alpha = 1 and b = 0. Q^ never rises, so H must not be chosen smaller: then
// one unlucky outcome counts too much, for ever. --explore has no say. Memory: 8 bytes a pair more.

#include <cmath>

#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/model_learning.hpp"
#include "quoll/learn/tabular/rules.hpp"
#include "quoll/learn/tabular/towards.hpp"

namespace quoll {
namespace {

template <class V>
class UcbQ {
 public:
  using Value = V;
  static constexpr bool looks_ahead = false;

  UcbQ(const LearnSetup& setup, const ValueTable<V>& table)
      : step_size_(setup.step_size),
        greedy_(setup.exploration),
        q_(table.begin(), static_cast<V>(setup.initial_value)) {
    greedy_.kind = Exploration::Kind::greedy;
    if (setup.world->traits.deterministic) return;
    bonus_ = setup.of_method.ucb_bonus * setup.rewards->span() * std::sqrt(horizon(setup.discount));
  }

  // 1
  Chosen choose(const ValueTable<V>& table, State state, const ChoiceDraws& draws,
                std::uint64_t step) const {
    return greedy_.choose(table.rows(), table.values(), table.visits(), state, table.row(state),
                          draws, step);
  }

  Change learn(const Step& step, ValueTable<V>& table, const ChoiceDraws& draws) {
    // 2
    const double bonus = bonus_ / std::sqrt(static_cast<double>(step.n));
    // 3
    const double best_next = table.best_after(step.carry, step.next);
    const double target = step.reward + bonus + step.carry * best_next;
    const double alpha = step_size_.at(step.n);
    step_towards(q_, step.state, step.pair, target, alpha, step_size_, draws.rounding());
    // 4
    if (q_[step.pair] < table[step.pair]) table.set(step.state, step.pair, q_[step.pair]);
    return {best_next, target, alpha};
  }
  void end_episode(ValueTable<V>&) {}
  void persist(Archive& archive) { archive("q", q_); }

 private:
  StepSize step_size_;
  Exploration greedy_;
  ValueTable<V> q_;
  double bonus_ = 0.0;  // c range sqrt(H)
};

}  // namespace

const LearnerEntry ucb_q{
    .method = "ucb-q",
    .rule = "",
    .summary = "hope shrinks with each visit, and the most hopeful action is taken",
    .sound = true,
    .make = method_learner<UcbQ>,
    .replay = nullptr,
    .traits = {.directed = true, .optimistic = true, .ignores = "explore"},
    .check = needs_value_range,
    .formula =
        "Q(s,a) := Q(s,a) + step size * (r + b + discount * max Q^(s',.) - Q(s,a)), Q^ := "
        "min(Q^, Q), b = c * range * sqrt(H / N(s,a))"};

}  // namespace quoll
