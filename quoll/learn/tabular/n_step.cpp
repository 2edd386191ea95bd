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
// ties with the best is greedy. Steps 3 to 5 -> LastSteps. Cost: n multiply-adds a step. Memory: 40
// n bytes.

#include "quoll/learn/tabular/last_steps.hpp"
#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/rules.hpp"

namespace quoll {
namespace {

template <class V>
class NStep {
 public:
  using Value = V;
  static constexpr bool looks_ahead = false;

  NStep(const LearnSetup& setup, const ValueTable<V>& table) : kept_(setup, table) {}

  Change learn(const Step& step, ValueTable<V>& table, const ChoiceDraws& draws) {
    // 1
    if (double{table[step.pair]} < table.best(step.state)) end_episode(table);
    const double best_next = table.best_after(step.carry, step.next);
    // 2, 3
    kept_.add(PastStep::of(step, draws), table, worth);
    return {best_next, step.reward + step.carry * best_next, kept_.step_size(step.n)};
  }
  void end_episode(ValueTable<V>& table) { kept_.learn_all(table, worth); }
  void persist(Archive& archive) { kept_.persist(archive); }

 private:
  // 4: what was done was the best there.
  static double worth(const PastStep&, double value) { return value; }

  LastSteps<V> kept_;
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
