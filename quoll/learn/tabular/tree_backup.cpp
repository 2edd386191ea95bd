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
// number. G is rounded as the table is, so that the values of n = 1 are the fixed point of every n.
// Cost: n rows a step. Memory: 40 n bytes.

#include <vector>

#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/past_step.hpp"
#include "quoll/learn/tabular/rules.hpp"

namespace quoll {
namespace {

template <class V>
class TreeBackup {
 public:
  using Value = V;
  static constexpr bool looks_ahead = false;

  TreeBackup(const TabularSetup& setup, const ValueTable<V>& table)
      : step_size_(setup.step_size), begin_(table.begin()), most_(setup.of_method.return_steps) {}

  Change learn(const Step& step, ValueTable<V>& table, const ChoiceDraws& draws) {
    // 1
    const double best_next = table.best_after(step.carry, step.next);
    kept_.push_back(PastStep::of(step, draws));
    // 2
    if (kept_.size() >= most_) {
      double value = back(kept_.back(), best_next);
      for (auto e = kept_.rbegin() + 1; e != kept_.rend(); ++e) {
        value = back(*e, leaves(*(e - 1), value, table));
      }
      learn_from(kept_.front(), value, table, step_size_);  // 5
      kept_.erase(kept_.begin());
    }
    return {best_next, step.reward + step.carry * best_next, step_size_.at(step.n)};
  }

  void end_episode(ValueTable<V>& table) {
    if (kept_.empty()) return;
    const PastStep& last = kept_.back();
    double following = table.best_after(last.carry, last.next);
    for (auto e = kept_.rbegin(); e != kept_.rend(); ++e) {
      const double value = back(*e, following);
      following = leaves(*e, value, table);
      learn_from(*e, value, table, step_size_);
    }
    kept_.clear();
  }

  void persist(Archive& archive) { persist_steps(archive, kept_, begin_, most_); }

 private:
  // 3
  static double back(const PastStep& e, double following) {
    return double{static_cast<V>(e.reward + e.carry * following)};
  }
  // 4: what the state of `e` is worth when its action is worth `value`.
  static double leaves(const PastStep& e, double value, const ValueTable<V>& table) {
    const RowView<V> row = table.row(e.state);
    const double best = double{row.best};
    return table[e.pair] == row.best ? best + (value - best) / row.ties : best;
  }

  StepSize step_size_;
  const std::vector<std::uint64_t>& begin_;
  std::uint64_t most_;
  std::vector<PastStep> kept_;
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
