#include "quoll/learn/deep/linear_features.hpp"

namespace quoll {

Result<LinearFeatures> LinearFeatures::make(const LearnSetup& setup) {
  const World& world = *setup.world;
  const Spaces spaces = world.make({})->spaces();
  LinearFeatures features;
  features.actions_ = spaces.actions;
  if (spaces.states > 0) {
    const LinearSettings usual;
    if (setup.linear.tilings != usual.tilings || setup.linear.tiles != usual.tiles) {
      return Error{setup.linear.tiles != usual.tiles ? "--tiles" : "--tilings", 0, 0,
                   "tiles cover observed numbers, but " + world.name +
                       " numbers its states: each is a feature of its own",
                   ""};
    }
    features.features_ = spaces.states;
  } else {
    if (world.measured.empty() || world.measured.size() != spaces.observation) {
      return Error{"--method", 0, 0,
                   "linear-q needs numbered states, or observed numbers whose ranges are known, "
                   "which " +
                       world.name + " has not",
                   ""};
    }
    Result<TileCoder> coder =
        TileCoder::make(world.measured, setup.linear.tilings, setup.linear.tiles);
    if (!coder) return coder.error();
    features.coder_ = *std::move(coder);
    features.features_ = features.coder_->features();
    features.numbers_ = spaces.observation;
  }
  if (features.weights() > 2 * TileCoder::most_features) {
    return Error{"--tiles", 0, 0,
                 std::to_string(features.weights()) + " weights are too many; give fewer tiles",
                 ""};
  }
  return features;
}

}  // namespace quoll
