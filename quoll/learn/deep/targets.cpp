#include "quoll/learn/deep/targets.hpp"

#include <algorithm>

#include "quoll/base/math.hpp"
#include "quoll/learn/deep/choose.hpp"

namespace quoll {

Stretch stretch(const Replay& replay, std::uint64_t slot, std::uint64_t n, float discount,
                float reward_scale) {
  Stretch all;
  for (std::uint64_t k = 0; slot != Replay::no_slot && k < n; ++k) {
    all.last = slot;
    all.reward += all.carry * replay.reward(slot) * reward_scale;
    all.carry *= replay.terminated(slot) ? 0.0F : replay.turn_passes(slot) ? -discount : discount;
    slot = replay.after(slot);
  }
  return all;
}

namespace {

// softmax(Q / temperature), as Munchausen DQN acts in its targets.
class SoftPolicy {
 public:
  static constexpr double temperature = 0.03, weight = 0.9, least = -1.0;

  explicit SoftPolicy(std::span<const float> q)
      : q_(q), best_(double{*std::max_element(q.begin(), q.end())}) {
    for (const float value : q) sum_ += math::exp((double{value} - best_) / temperature);
  }
  double share(std::size_t a) const {
    return math::exp((double{q_[a]} - best_) / temperature) / sum_;
  }
  /// temperature * log(share).
  double scaled_log(std::size_t a) const {
    return double{q_[a]} - best_ - temperature * math::log(sum_);
  }

 private:
  std::span<const float> q_;
  double best_, sum_ = 0.0;
};

}  // namespace

Targets::Targets(const DeepSettings& how, const Distribution& distribution, std::size_t actions)
    : double_q_(how.double_q),
      munchausen_(how.munchausen),
      distribution_(distribution),
      means_(actions),
      part_(distribution.atoms()) {}

std::span<const float> Targets::means(const float* outputs, std::size_t legal) {
  for (std::size_t a = 0; a < legal; ++a) means_[a] = distribution_.mean(outputs_of(outputs, a));
  return std::span(means_).first(legal);
}

void Targets::find(const Surroundings& at, Action action, float reward, float carry,
                   std::span<float> out) {
  if (munchausen_) return soft(at, action, reward, carry, out);
  const Action best = greedy(means(chooses(at), at.legal_next));
  distribution_.target(outputs_of(at.next, best), reward, carry, out);
}

void Targets::soft(const Surroundings& at, Action action, float reward, float carry,
                   std::span<float> out) {
  using Soft = SoftPolicy;
  const double log_policy = Soft(means(at.here, at.legal_here)).scaled_log(action);
  reward += static_cast<float>(Soft::weight * std::max(log_policy, Soft::least));
  const Soft policy(means(chooses(at), at.legal_next));
  std::fill(out.begin(), out.end(), 0.0F);
  for (std::size_t b = 0; b < at.legal_next; ++b) {
    const auto share = static_cast<float>(policy.share(b));
    const auto bonus = static_cast<float>(-policy.scaled_log(b));
    distribution_.target(outputs_of(at.next, b), reward + carry * bonus, carry, part_);
    for (std::size_t k = 0; k < out.size(); ++k) out[k] += share * part_[k];
  }
}

}  // namespace quoll
