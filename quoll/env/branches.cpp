#include "quoll/env/branches.hpp"

#include <algorithm>

namespace quoll {

void Branches::begin() {
  path_.clear();
  fault_ = {};
  fallback_ = stream(1, "branches");
  rewind();
}

void Branches::rewind() {
  reals_.clear();
  depth_ = 0;
  probability_ = 1.0;
}

bool Branches::next() {
  if (!fault_.empty()) return false;
  if (depth_ < path_.size()) {
    fault_ = "does not draw the same numbers when it is repeated";
    return false;
  }
  while (!path_.empty() && path_.back().taken + 1 == path_.back().of) path_.pop_back();
  if (path_.empty()) return false;
  ++path_.back().taken;
  rewind();
  return true;
}

std::uint32_t Branches::decide(std::uint32_t possibilities) {
  if (fault_.empty() && depth_ == most_draws) fault_ = "draws more than 1,000 numbers";
  if (fault_.empty() && depth_ == path_.size()) path_.push_back({0, possibilities});
  if (fault_.empty() && path_[depth_].of != possibilities) {
    fault_ = "does not draw the same numbers when it is repeated";
  }
  if (!fault_.empty()) return fallback_.below(possibilities);
  return path_[depth_++].taken;
}

std::uint32_t Branches::below(std::uint32_t n) {
  if (n < 2) return 0;
  probability_ /= n;
  return decide(n);
}

Branches::Real Branches::uniform() {
  reals_.push_back({0.0, 1.0});
  return {*this, reals_.size() - 1};
}

bool Branches::is_below(std::size_t place, double bound) {
  auto& [low, high] = reals_[place];
  if (!(bound > low)) return false;
  if (bound >= high) return true;
  const double share = (bound - low) / (high - low);
  const bool below = decide(2) == 0;
  probability_ *= below ? share : 1.0 - share;
  (below ? high : low) = bound;
  return below;
}

std::size_t pick(Branches& dice, std::span<const double> running_sums) {
  const Branches::Real draw = dice.uniform();
  std::size_t index = 0;
  while (index + 1 < running_sums.size() && !(running_sums[index] > draw)) ++index;
  return index;
}

double Branches::as_number(std::size_t place) {
  const auto [low, high] = reals_[place];
  if (fault_.empty()) fault_ = "draws a real number, of which there are too many to list";
  return std::min(low + (high - low) * fallback_.uniform(), high);
}

}  // namespace quoll
