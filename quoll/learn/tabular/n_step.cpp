// n-step Q-learning with returns that are cut where the behaviour left the greedy way. Watkins 1989
// (thesis, "corrected truncated returns", section 7.4); Sutton, Barto 2018, chapter 7.
//
//   for each episode: s_0 <- start()
//     for t = 0, 1, .. until s_t is an end or the episode is cut off:
//   1   choose a_t in A(s_t);  if Q(s_t,a_t) < max_a Q(s_t,a): learn(e_k) for all e_k kept, and
//       forget them
//   2   see r_t and s_(t+1);  keep e_t = (s_t, a_t, r_t)
//   3   if n are kept: learn from the oldest, e_(t-n+1), and forget it
//     learn from all that are kept
//
//   learn from e_k with e_k .. e_t kept:
//   4   G <- V(s_(t+1)) = max_a Q(s_(t+1),a);  for i = t .. k: G <- r_i + gamma G
//   5   Q(s_k,a_k) <- Q(s_k,a_k) + alpha(N(s_k,a_k)) (G - Q(s_k,a_k))
//
// n -> return_steps; e -> kept_; alpha -> StepSize; gamma, 0 after the end -> carry. An action that
// ties with the best is greedy. G is rounded as the table is, so that the values of n = 1 are the
// fixed point of every n. Cost: n multiply-adds a step. Memory: 40 n bytes.

#include <vector>

#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/past_step.hpp"
#include "quoll/learn/tabular/rules.hpp"

namespace quoll {
namespace {

template <class V>
class NStep {
 public:
  using Value = V;
  static constexpr bool looks_ahead = false;

  NStep(const TabularSetup& setup, const ValueTable<V>& table)
      : step_size_(setup.step_size), begin_(table.begin()), most_(setup.of_method.return_steps) {}

  Change learn(const Step& step, ValueTable<V>& table, const ChoiceDraws& draws) {
    // 1
    if (double{table[step.pair]} < table.best(step.state)) end_episode(table);
    const double best_next = table.best_after(step.carry, step.next);
    // 2
    kept_.push_back(PastStep::of(step, draws));
    // 3
    if (kept_.size() >= most_) {
      double value = best_next;
      for (auto e = kept_.rbegin(); e != kept_.rend(); ++e) value = back(*e, value);  // 4
      learn_from(kept_.front(), value, table, step_size_);                            // 5
      kept_.erase(kept_.begin());
    }
    return {best_next, step.reward + step.carry * best_next, step_size_.at(step.n)};
  }

  // All that are kept, each from its own part of the way: one pass from the last to the first.
  void end_episode(ValueTable<V>& table) {
    if (kept_.empty()) return;
    const PastStep& last = kept_.back();
    double value = table.best_after(last.carry, last.next);
    for (auto e = kept_.rbegin(); e != kept_.rend(); ++e) {
      value = back(*e, value);
      learn_from(*e, value, table, step_size_);
    }
    kept_.clear();
  }

  void persist(Archive& archive) { persist_steps(archive, kept_, begin_, most_); }

 private:
  // 4
  static double back(const PastStep& e, double value) {
    return double{static_cast<V>(e.reward + e.carry * value)};
  }

  StepSize step_size_;
  const std::vector<std::uint64_t>& begin_;
  std::uint64_t most_;
  std::vector<PastStep> kept_;
};

}  // namespace

const LearnerEntry n_step{
    .method = "n-step",
    .rule = "",
    .summary = "n rewards before the table is asked, fewer where an action was not the best",
    .sound = true,
    .make = method_learner<NStep>,
    .replay = nullptr,
    .check = check_return_steps,
    .formula =
        "Q(s,a) := Q(s,a) + step size * (r + discount * r' + .. + discount^n * max Q(s_n,.) "
        "- Q(s,a)), cut at actions that are not the best"};

}  // namespace quoll
