#pragma once
// How networks learn Q, as people say it: one list for command line, TOML and checkpoint. Each key
// that may be "auto" stands for what the method usually takes (deep_setup.cpp).

#include <cstdint>
#include <string>
#include <string_view>

#include "quoll/base/settings.hpp"

namespace quoll {

/// The lecture's three ways to lay a network out: one with n outputs, one for each action, or one
/// that reads the action too and has one output.
enum class NetworkLayout : std::uint8_t { shared, separate, joint };
inline constexpr std::string_view layout_names[] = {"shared", "separate", "joint"};

/// How observed numbers enter: as they are, or their declared ranges as [-1, 1]. How a numbered
/// state enters: as one number of its own, or by the letters of its name (NameLetters).
enum class Scaling : std::uint8_t { automatic, raw, scaled, letters };
inline constexpr std::string_view scaling_names[] = {"auto", "raw", "scaled", "letters"};

/// What an output tells of the return: its mean, or its distribution over fixed values (C51) or at
/// fixed quantiles (QR-DQN).
enum class Returns : std::uint8_t { mean, categorical, quantile };
inline constexpr std::string_view returns_names[] = {"mean", "categorical", "quantile"};

enum class Switch : std::uint8_t { automatic, off, on };
inline constexpr std::string_view switch_names[] = {"auto", "off", "on"};

struct DeepSettings {
  // The network.
  NetworkLayout layout = NetworkLayout::shared;
  std::string hidden = "auto";
  std::string filters = "auto";
  std::string activation = "auto";
  Switch layer_norm = Switch::automatic;
  std::string initial_weights = "auto";
  Scaling inputs = Scaling::automatic;

  // Its steps.
  std::string optimiser = "auto";
  std::string learning_rate = "auto";
  double optimiser_epsilon = 1e-8;
  double gradient_decay = 0.95;
  std::string loss = "auto";
  double clip_gradient = -1.0;
  std::uint64_t batch = 0;
  double reward_scale = 0.0;

  // dqn
  std::uint64_t replay = 0;
  std::uint64_t learning_starts = 1000;
  std::uint64_t train_every = 0;
  std::uint64_t gradient_steps = 0;
  std::uint64_t target_every = 0;
  double target_share = 1.0;
  bool double_q = false;
  bool duelling = false;
  std::uint64_t multi_step = 0;
  bool prioritised = false;
  double priority_exponent = 0.6;
  std::string priority_correction = "0.4";
  bool munchausen = false;
  bool noisy = false;
  Returns returns = Returns::mean;
  std::uint64_t atoms = 0;
  double lowest_return = 0.0, highest_return = 0.0;

  // nfq
  std::uint64_t fits = 0;

  // pqn
  std::uint64_t walkers = 0;
  std::uint64_t rollout = 0;
  std::uint64_t minibatches = 0;
  std::uint64_t epochs = 0;
  double return_decay = -1.0;

  // stream-q
  double overshoot_bound = 2.0;

  void describe(Describer& d);

 private:
  void describe_network(Describer& d);
  void describe_methods(Describer& d);
};

}  // namespace quoll
