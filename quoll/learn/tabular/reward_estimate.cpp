// Q-learning with an estimate of the reward: the sound reading of the lecture's symbol rE.
//
//   rE(s,a) = given value until (s,a) was observed
//   repeat: choose a in A(s), see r and s'
//   1   rE(s,a) := mean of the rewards observed for (s,a)
//   2   QE(s,a) := rE(s,a) + gamma max_a' QE(s',a')
//
// QE -> the table; rE -> reward_; gamma -> discount; max QE(s',.) -> best_next. Right for random
// rewards in worlds whose moves are deterministic.

#include "quoll/learn/tabular/initial_rewards.hpp"
#include "quoll/learn/tabular/replay.hpp"
#include "quoll/learn/tabular/rules.hpp"
#include "quoll/learn/tabular/tabular.hpp"

namespace quoll {
namespace {

template <class V>
struct RewardEstimate {
  using Value = V;
  static constexpr bool own_step = true;

  RewardEstimate(const LearnSetup& setup, PairLayout layout,
                 const std::vector<std::uint64_t>& begin)
      : reward_(initial_rewards_per_pair(setup, layout, begin)) {}

  Target target(std::uint64_t pair, double reward, double discount, double best_next,
                std::uint32_t n) {
    // 1
    double& mean = reward_[pair];
    mean = n == 1 ? reward : mean + (reward - mean) / n;
    // 2
    return {mean, mean + discount * best_next};
  }
  void learned(std::uint64_t, double) {}

  double reward_estimate(std::uint64_t pair) const { return reward_[pair]; }
  void persist(Archive& archive) { persist_per_pair(archive, "reward_estimate", reward_); }

 private:
  std::vector<double> reward_;
};

std::unique_ptr<Learner> make(const LearnSetup& setup) {
  if (setup.precision == Precision::twofold) return tabular<RewardEstimate<double>>(setup);
  return tabular<RewardEstimate<float>>(setup);
}

std::vector<Update> replay_script(const LearnSetup& setup, std::span<const Update> script) {
  if (setup.precision == Precision::twofold) return replay<RewardEstimate<double>>(setup, script);
  return replay<RewardEstimate<float>>(setup, script);
}

}  // namespace

const LearnerEntry q_learning_reward_estimate{
    "q-learning",
    "reward-estimate",
    "rE = mean of the observed rewards; QE := rE + discount * max QE: the sound reading of rE",
    true,
    make,
    replay_script};

}  // namespace quoll
