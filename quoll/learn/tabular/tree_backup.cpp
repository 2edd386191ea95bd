// n-step tree backup for the greedy policy. Precup, Sutton, Singh 2000 ("Eligibility traces for
// off-policy policy evaluation"), section 4; Sutton, Barto 2018, section 7.5.
//
//   for each episode: s_0 <- start()
//     for t = 0, 1, .. until s_t is an end or the episode is cut off:
//   1   choose a_t in A(s_t), see r_t and s_(t+1);  keep e_t = (s_t, a_t, r_t)
//   2   if n are kept: learn from the oldest, e_(t-n+1), and forget it
//     learn from all that are kept, the last first
//
//   learn from e_k with e_k .. e_t kept; pi(s,.) = shared equally by the best actions of s:
//   3   G <- r_t + gamma sum_a pi(s_(t+1),a) Q(s_(t+1),a)
//   4   for i = t-1 .. k:
//         G <- r_i + gamma (sum_(a /= a_(i+1)) pi(s_(i+1),a) Q(s_(i+1),a) + pi(s_(i+1),a_(i+1)) G)
//   5   Q(s_k,a_k) <- Q(s_k,a_k) + alpha(N(s_k,a_k)) (G - Q(s_k,a_k))
//
// n -> return_steps; e -> kept_; alpha -> StepSize; gamma, 0 after the end -> carry. The sum in 4
// is V + pi (G - V), V the best value: pi is 0 where a_(i+1) is not among the best, else 1 / their
// number. Steps 2 to 5 -> LastSteps. Cost: n rows a step. Memory: 40 n bytes.

#include "quoll/learn/tabular/last_steps.hpp"
#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/rules.hpp"

namespace quoll {
namespace {

template <class V>
class TreeBackup {
 public:
  using Value = V;
  static constexpr bool looks_ahead = false;

  TreeBackup(const LearnSetup& setup, const ValueTable<V>& table) : kept_(setup, table) {}

  Change learn(const Step& step, ValueTable<V>& table, const ChoiceDraws& draws) {
    // 1, 2
    const double best_next = table.best_after(step.carry, step.next);
    kept_.add(PastStep::of(step, draws), table, Worth{table});
    return {best_next, step.reward + step.carry * best_next, kept_.step_size(step.n)};
  }
  void end_episode(ValueTable<V>& table) { kept_.learn_all(table, Worth{table}); }
  void persist(Archive& archive) { kept_.persist(archive); }

 private:
  // 4: what the state of `e` is worth when its action is worth `value`.
  struct Worth {
    const ValueTable<V>& table;
    double operator()(const PastStep& e, double value) const {
      const RowView<V> row = table.row(e.state);
      const double best = double{row.best};
      return table[e.pair] == row.best ? best + (value - best) / row.ties : best;
    }
  };

  LastSteps<V> kept_;
};

}  // namespace

const LearnerEntry tree_backup{
    .method = "tree-backup",
    .rule = "",
    .summary = "n steps of the way taken, with the best values of all actions beside it",
    .sound = true,
    .make = method_learner<TreeBackup>,
    .replay = nullptr,
    .check = check_return_steps,
    .formula =
        "Q(s,a) := Q(s,a) + step size * (G - Q(s,a)), G = r + discount * (max Q(s',.), and "
        "in it for a best a' its own G')"};

}  // namespace quoll
