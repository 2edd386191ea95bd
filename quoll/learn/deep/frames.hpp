#pragma once
// What was seen, by number: states, or observations; those of 0 and 1 alone as bits.

#include <cstdint>
#include <span>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/env/environment.hpp"

namespace quoll {

class Frames {
 public:
  /// Of a world whose observations are said to be whole bits are kept, until one is not 0 or 1.
  /// Room is set aside for `most`: growing up to there copies nothing.
  Frames(const Spaces& spaces, std::uint64_t count, std::uint64_t most = 0);

  std::uint64_t size() const { return size_; }
  void resize(std::uint64_t count);
  /// The state where states are numbered, else the observation.
  void write(std::uint64_t frame, State state, std::span<const float> observation);
  /// The state (0 where they are not numbered); an observation is written to `observation`.
  State read(std::uint64_t frame, std::span<float> observation) const;

  void persist(Archive& archive);
  /// Whether what was loaded goes together, and every state is below `states`.
  bool fits(std::uint64_t states) const;

 private:
  void unpack();
  template <typename Number>
  void grow(std::vector<Number>& numbers, std::uint64_t of_a_frame);

  std::uint32_t observation_ = 0;
  bool bits_ = false;
  std::uint64_t size_ = 0, most_ = 0;
  std::vector<State> states_;
  std::vector<float> floats_;
  std::vector<std::uint64_t> words_;
};

}  // namespace quoll
