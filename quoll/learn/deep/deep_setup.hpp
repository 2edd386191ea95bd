#pragma once
// The settings of a network learner, resolved against a method and a world.

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "quoll/act/schedule.hpp"
#include "quoll/env/environment.hpp"
#include "quoll/learn/deep/deep_settings.hpp"
#include "quoll/learn/deep/name_letters.hpp"
#include "quoll/learn/settings.hpp"
#include "quoll/nn/losses.hpp"
#include "quoll/nn/optimiser.hpp"

namespace quoll {

/// What networks of a method usually take, where nothing else is said.
struct DeepHabits {
  std::string_view hidden, filters;
  bool layer_norm;
  nn::Initial initial;
  nn::OptimiserKind optimiser;
  std::string_view learning_rate;
  nn::LossKind loss;
  /// Where states are numbered, that is where Q* is to be found: Huber's loss finds no mean of what
  /// differs by more than 1.
  nn::LossKind loss_of_states;
  double clip_gradient;
  std::uint32_t walkers;
  // What 0 stands for.
  std::uint64_t batch = 64, replay = 100'000, train_every = 4, gradient_steps = 1;
  std::uint64_t target_every = 500, rollout = 32, minibatches = 4, epochs = 4, fits = 1;
  /// Where something is observed. Where states are only numbered it is 1: what was explored after
  /// the first of several rewards moves Q away from Q*.
  std::uint64_t multi_step = 1;
  double return_decay = 0.65;  ///< what -1 stands for
  /// Reads which state it is where states are numbered, whatever else is observed there.
  bool by_state = false;
  nn::Activation activation = nn::Activation::relu;
  std::string_view hidden_of_planes = {};  ///< where convolutions come before; empty = hidden
  /// Layers are normalised over all of a sample, with no gain that is learned.
  bool plain_norm = false;
  bool running = false;  ///< observed numbers by their mean and deviation so far
  bool traces = false;   ///< of the gradients

  constexpr std::string_view optimiser_name() const {
    return nn::optimiser_names[static_cast<std::size_t>(optimiser)];
  }
};

/// Everything a network learner needs besides LearnSetup; no "auto" is left.
struct DeepSetup {
  DeepSettings settings;  ///< numbers that need no resolving, defaults filled in
  Spaces spaces;
  std::vector<nn::LayerSpec> hidden;  ///< convolutions and dense layers before the outputs
  nn::Extent input;                   ///< of one sample
  std::uint32_t actions = 0;          ///< that it has outputs for
  bool scaled = false;
  bool running = false;  ///< inputs are scaled by what was seen so far
  bool traces = false;
  std::shared_ptr<const NameLetters> letters;  ///< where states enter by their names; else null
  nn::Initial initial = nn::Initial::uniform;
  nn::OptimiserSettings optimiser;
  Schedule learning_rate, priority_correction;
  nn::LossKind loss = nn::LossKind::huber;
  std::uint32_t atoms = 1;
  std::uint32_t walkers = 1;

  /// Error: names the flag, what it takes and the nearest word.
  static Result<DeepSetup> make(const LearnSetup& setup, const DeepHabits& habits);
};

}  // namespace quoll
