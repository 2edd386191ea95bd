// SARSA. Rummery, Niranjan 1994 ("On-line Q-learning using connectionist systems"); Sutton, Barto
// 2018, section 6.4.
//
//   for each episode: s <- start(); choose a in A(s)
//     until s is an end or the episode is cut off:
//   1   take a, see r and s'; N(s,a) <- N(s,a) + 1
//   2   choose a' in A(s')
//   3   Q(s,a) <- Q(s,a) + alpha(N(s,a)) (r + gamma Q(s',a') - Q(s,a));  s <- s', a <- a'
//
// alpha -> StepSize; gamma, 0 after the end -> carry; a' -> next_action. Steps 1 and 2 are the
// loop's. It learns the value of the way it acts, exploring included; with exploring that fades out
// (GLIE) that becomes the optimal one (Singh et al. 2000).

#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/rules.hpp"
#include "quoll/learn/tabular/towards.hpp"

namespace quoll {
namespace {

template <class V>
class Sarsa {
 public:
  using Value = V;
  static constexpr bool looks_ahead = true;

  Sarsa(const LearnSetup& setup, const ValueTable<V>&) : step_size_(setup.step_size) {}

  // 3
  Change learn(const Step& step, ValueTable<V>& table, const ChoiceDraws& draws) {
    const double after =
        step.terminated ? 0.0 : double{table[table.pair(step.next, step.next_action)]};
    return learn_from(step, after, table, step_size_, draws);
  }
  void end_episode(ValueTable<V>&) {}
  void persist(Archive&) {}

 private:
  StepSize step_size_;
};

}  // namespace

const LearnerEntry sarsa{
    .method = "sarsa",
    .rule = "",
    .summary = "the next action's value instead of the best one's: the value of how it acts",
    .sound = true,
    .make = method_learner<Sarsa>,
    .replay = nullptr,
    .traits = {.off_policy = false},
    .formula =
        "Q(s,a) := Q(s,a) + step size * (r + discount * Q(s',a') - Q(s,a)), a' = the action "
        "taken in s'"};

}  // namespace quoll
