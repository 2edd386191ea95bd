#pragma once
// What a network is taught: the target of a transition, by each of the switches of the DQN family.

#include <cstdint>
#include <span>
#include <vector>

#include "quoll/learn/deep/deep_settings.hpp"
#include "quoll/learn/deep/distribution.hpp"
#include "quoll/learn/deep/replay.hpp"

namespace quoll {

/// The rewards of up to n steps from a transition on, and what the value of the state they lead to
/// is multiplied by: 0 after the end, else the discounts, negative for each turn that passed.
struct Stretch {
  float reward = 0.0F, carry = 1.0F;
  std::uint64_t last = 0;  ///< the transition that leads there
};
/// Stops at the end of the episode and at the newest transition.
Stretch stretch(const Replay& replay, std::uint64_t slot, std::uint64_t n, float discount,
                float reward_scale);

/// What the networks say where a transition begins and where it leads, all actions' outputs.
struct Surroundings {
  const float* next = nullptr;                 ///< target weights, s'
  const float* next_online = nullptr;          ///< online weights, s'; double only
  const float* here = nullptr;                 ///< target weights, s; Munchausen only
  std::size_t legal_next = 0, legal_here = 0;  ///< number of actions in s' and s
};

class Targets {
 public:
  Targets(const DeepSettings& how, const Distribution& distribution, std::size_t actions);

  /// Writes the target of taking `action` with this reward and carry: as many numbers as an action
  /// has outputs. Double: van Hasselt, Guez, Silver 2016, equation 4. Munchausen: Vieillard,
  /// Pietquin, Geist 2020, equation 1, temperature 0.03, weight 0.9, the log-policy cut at -1; of
  /// outputs that are more than a mean, the mean of the actions' by the soft policy: of C51's
  /// shares that is the mixture of the distributions, of quantiles the mean that M-IQN takes.
  /// Both: the soft policy in s' is that of the online weights, the target weights say its worth.
  void find(const Surroundings& at, Action action, float reward, float carry, std::span<float> out);

 private:
  std::span<const float> means(const float* outputs, std::size_t legal);
  /// The values by which an action of s' is chosen.
  const float* chooses(const Surroundings& at) const {
    return double_q_ ? at.next_online : at.next;
  }
  std::span<const float> outputs_of(const float* outputs, std::size_t action) const {
    return {outputs + action * distribution_.atoms(), distribution_.atoms()};
  }
  void soft(const Surroundings& at, Action action, float reward, float carry, std::span<float> out);

  bool double_q_, munchausen_;
  Distribution distribution_;
  std::vector<float> means_, part_;
};

}  // namespace quoll
