// The lecture's pseudo code exactly as printed, for learning about it only. It never reads the
// observed reward, and what it stores as reward already holds the future, which it counts again at
// the next visit: with the k-th visit seeing the successor maximum m_k, QE = rE0 + gamma (m_1 + ...
// + m_k).
//
//   all QE(s,a) = 0, rE(s,a) = given initial values
//   repeat: choose s, a; see s'
//   1   QE(s,a) := rE(s,a) + gamma max_a' QE(s',a')
//   2   rE(s,a) := QE(s,a)
//
// QE -> the table; rE -> reward_; gamma -> discount; max QE(s',.) -> best_next. In double.

#include "quoll/learn/tabular/initial_rewards.hpp"
#include "quoll/learn/tabular/replay.hpp"
#include "quoll/learn/tabular/rules.hpp"
#include "quoll/learn/tabular/tabular.hpp"

namespace quoll {
namespace {

struct AsPrinted {
  using Value = double;
  static constexpr bool own_step = true;

  AsPrinted(const LearnSetup& setup, PairLayout layout, const std::vector<std::uint64_t>& begin)
      : reward_(initial_rewards_per_pair(setup, layout, begin)) {}

  // 1
  Target target(std::uint64_t pair, double, double discount, double best_next, std::uint32_t) {
    return {reward_[pair], reward_[pair] + discount * best_next};
  }
  // 2
  void learned(std::uint64_t pair, double value) { reward_[pair] = value; }

  double reward_estimate(std::uint64_t pair) const { return reward_[pair]; }
  void persist(Archive& archive) { persist_per_pair(archive, "reward_estimate", reward_); }

 private:
  std::vector<double> reward_;
};

}  // namespace

const LearnerEntry q_learning_as_printed{
    "q-learning",
    "as-printed",
    "the lecture's pseudo code exactly as printed; counts the future again at each re-visit",
    false,
    tabular<AsPrinted>,
    replay<AsPrinted>,
    {.ignores = "precision, initial_value"}};

}  // namespace quoll
