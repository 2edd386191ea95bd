#include "quoll/learn/deep/distribution.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "quoll/nn/losses.hpp"

namespace quoll {

namespace {
constexpr std::size_t most_atoms = 1024;
}

float Distribution::mean(std::span<const float> outputs) const {
  if (kind_ == Returns::mean) return outputs[0];
  float sum = 0.0F;
  if (kind_ == Returns::quantile) {
    for (const float x : outputs) sum += x;
    return sum / static_cast<float>(atoms_);
  }
  std::array<float, most_atoms> p;
  nn::softmax(outputs, std::span(p).first(atoms_));
  for (std::size_t i = 0; i < atoms_; ++i) sum += p[i] * atom(i);
  return sum;
}

void Distribution::target(std::span<const float> outputs, float reward, float carry,
                          std::span<float> out) const {
  if (kind_ != Returns::categorical) {
    for (std::size_t i = 0; i < atoms_; ++i) out[i] = reward + carry * outputs[i];
    return;
  }
  std::array<float, most_atoms> p;
  nn::softmax(outputs, std::span(p).first(atoms_));
  std::fill(out.begin(), out.end(), 0.0F);
  const double width = (high_ - low_) / static_cast<double>(atoms_ - 1);
  for (std::size_t i = 0; i < atoms_; ++i) {
    const double value = std::clamp(double{reward} + double{carry} * double{atom(i)}, low_, high_);
    const double place = (value - low_) / width;
    const auto below = std::min(static_cast<std::size_t>(place), atoms_ - 2);
    const auto share = static_cast<float>(place - static_cast<double>(below));
    out[below] += p[i] * (1.0F - share);
    out[below + 1] += p[i] * share;
  }
}

}  // namespace quoll
