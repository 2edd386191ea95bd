#pragma once
// The generators of the lanes of an environment: where each lane's starts and steps draw from.

#include <cstdint>
#include <type_traits>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/base/random.hpp"
#include "quoll/env/dice.hpp"
#include "quoll/env/environment.hpp"

namespace quoll {

/// One stream for starts and one for steps of each lane.
class OwnDice {
 public:
  explicit OwnDice(const Lanes& lanes) {
    for (std::uint32_t lane = 0; lane < lanes.count; ++lane) {
      steps_.push_back(stream(lanes.seed, "world", lane));
      starts_.push_back(stream(lanes.seed, "start", lane));
    }
  }
  Rng& of_start(std::size_t lane) { return starts_[lane]; }
  Rng& of_step(std::size_t lane) { return steps_[lane]; }
  void persist(Archive& archive, std::size_t lane) {
    archive("dice", steps_[lane]);
    archive("start_dice", starts_[lane]);
  }
  bool good() const { return true; }

 private:
  std::vector<Rng> steps_, starts_;
};

/// One generator of each lane for both; lane i is seeded as Gymnasium seeds the i-th of a vector.
/// Draws given from outside are those of lane 0.
class OneGuest {
 public:
  explicit OneGuest(const Lanes& lanes) {
    for (std::uint32_t lane = 0; lane < lanes.count; ++lane) {
      if (lanes.draws && lane == 0)
        dice_.emplace_back(lanes.draws);
      else
        dice_.emplace_back(lanes.seed + lane);
    }
  }
  GuestDice& of_start(std::size_t lane) { return dice_[lane]; }
  GuestDice& of_step(std::size_t lane) { return dice_[lane]; }
  void persist(Archive& archive, std::size_t lane) { archive("dice", dice_[lane]); }
  bool good() const { return dice_[0].good(); }

 private:
  std::vector<GuestDice> dice_;
};

/// make(type) with the type of dice that these lanes draw from: OneGuest where draws are given or
/// the seeding is Gymnasium's, else OwnDice.
auto with_dice(const Lanes& lanes, Seeding seeding, const auto& make) {
  if (lanes.draws || seeding == Seeding::gymnasium) return make(std::type_identity<OneGuest>());
  return make(std::type_identity<OwnDice>());
}

}  // namespace quoll
