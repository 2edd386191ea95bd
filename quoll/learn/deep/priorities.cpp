#include "quoll/learn/deep/priorities.hpp"

#include <algorithm>

#include "quoll/base/math.hpp"

namespace quoll {

void Priorities::set(std::uint64_t slot, double error) {
  const double priority = math::pow(error + 1e-6, alpha_);
  tree_.set(slot, priority);
  largest_ = std::max(largest_, priority);
}

void Priorities::draw(Rng& rng, std::uint64_t remembered, double beta,
                      std::span<std::uint64_t> slots, std::span<float> weights) const {
  const double part = tree_.total() / static_cast<double>(slots.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const double mass = (static_cast<double>(i) + rng.uniform()) * part;
    slots[i] = tree_.find(mass);
    const double share = tree_[slots[i]] / tree_.total();
    const double weight = math::pow(static_cast<double>(remembered) * share, -beta);
    weights[i] = static_cast<float>(weight);
    largest = std::max(largest, weight);
  }
  for (float& weight : weights) weight = static_cast<float>(double{weight} / largest);
}

void Priorities::persist(Archive& archive) {
  archive("largest", largest_);
  archive("tree", tree_);
}

}  // namespace quoll
