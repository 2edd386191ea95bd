// Q-learning. Watkins 1989; Watkins, Dayan 1992; Sutton, Barto 2018, equation 6.8. The lecture's
// formula is the case step size 1 in a deterministic world.
//
//   for each episode: s <- start()
//     until s is an end or the episode is cut off:
//   1   choose a in A(s), see r and s'
//   2   Q(s,a) <- Q(s,a) + alpha (r + gamma max_a' Q(s',a') - Q(s,a))
//   3   s <- s'
//
// s, a -> pair; r -> reward; gamma -> discount; max Q(s',.) -> best_next; alpha -> StepSize.

#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/one_step.hpp"
#include "quoll/learn/tabular/replay.hpp"
#include "quoll/learn/tabular/rules.hpp"
#include "quoll/learn/tabular/tabular.hpp"

namespace quoll {
namespace {

template <class V>
struct QLearning {
  using Value = V;
  static constexpr bool own_step = false;

  QLearning(const LearnSetup&, PairLayout, const std::vector<std::uint64_t>&) {}

  // 2
  Target target(std::uint64_t, double reward, double discount, double best_next, std::uint32_t) {
    return {reward, reward + discount * best_next};
  }
  void learned(std::uint64_t, double) {}
  void persist(Archive&) {}
};

template <class V>
using QLearningStep = OneStep<QLearning<V>>;

std::unique_ptr<Learner> make(const LearnSetup& setup) {
  if (setup.starts.kind() >= StartStates::Kind::each_pair) {
    return method_learner<QLearningStep>(setup);
  }
  if (setup.precision == Precision::twofold) return tabular<QLearning<double>>(setup);
  return tabular<QLearning<float>>(setup);
}

std::vector<Update> replay_script(const LearnSetup& setup, std::span<const Update> script) {
  if (setup.precision == Precision::twofold) return replay<QLearning<double>>(setup, script);
  return replay<QLearning<float>>(setup, script);
}

}  // namespace

const LearnerEntry q_learning_standard{
    "q-learning",
    "standard",
    "Q(s,a) += step_size * (r + discount * max Q(s',.) - Q(s,a)): Watkins' Q-learning",
    true,
    make,
    replay_script};

}  // namespace quoll
