#pragma once
// The name of a numbered state as inputs of a network: what a board or a map is called often spells
// what is on it. One input for each letter that some name has at a place where names differ; ends
// do not count, nobody asks what to do there.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/env/world.hpp"

namespace quoll {

class NameLetters {
 public:
  /// Of all states of the world. Error: it shows numbers, or its states cannot be listed. Cost: the
  /// names, once.
  static Result<std::shared_ptr<const NameLetters>> make(const World& world, const Spaces& spaces);

  /// Number of inputs.
  std::size_t size() const { return size_; }
  /// The inputs that are 1 for a state, ascending; all others are 0.
  std::span<const std::uint32_t> of(std::uint64_t state) const {
    return std::span(spots_).subspan(begin_[state], begin_[state + 1] - begin_[state]);
  }

 private:
  std::size_t size_ = 0;
  std::vector<std::uint32_t> spots_;
  std::vector<std::size_t> begin_;
};

}  // namespace quoll
