#pragma once
// A learned network for other programs, and what they compare themselves with: inputs, and the Q
// that Quoll found for them.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/env/world.hpp"
#include "quoll/learn/deep/learned_network.hpp"

namespace quoll {

/// Rows of inputs and their Q.
struct NetworkVectors {
  std::vector<State> states;        ///< of numbered states; else empty
  std::vector<float> observations;  ///< a row for each, of worlds that are observed
  std::vector<float> q;             ///< a row for each, of all actions
  std::size_t count = 0;
};

struct NetworkExport {
  std::shared_ptr<const LearnedNetwork> network;
  std::string world;
  std::string name;    ///< of the world unless said; a C identifier is made of it
  std::string method;  ///< that it was learned with; empty = not told
  double discount = 1.0;
  std::vector<std::string> origin;    ///< sentences for the head of the file, one line each
  std::vector<std::string> numbers;   ///< what the observed numbers are called; empty = not told.
                                      ///< Letters of names: the letter and its place, from 0 on
  std::vector<std::string> actions;   ///< their names; empty where they differ from state to state
  std::shared_ptr<const Mdp> states;  ///< of numbered states: names of states and their actions
  /// Of numbered states: how many actions each has; empty if they all have as many.
  std::vector<Action> action_counts;
  NetworkVectors vectors;
};

/// Everything but method, discount and origin, with the vectors: of up to 32 numbered states spread
/// over all, as their numbers or letters, or of 32 moments of uniform play. Error: a number of the
/// network is not finite, or its states cannot be listed.
Result<NetworkExport> network_export(const World& world,
                                     std::shared_ptr<const LearnedNetwork> network);

/// What a file says about itself, key and text: world, method, discount, origin, actions, inputs,
/// states, and the words of what is exported. Lists are JSON; actions that differ by state are a
/// list for each state, which stands there for up to 100,000 states, like their names.
std::vector<std::pair<std::string, std::string>> network_facts(const NetworkExport& what);

/// Calls use(name, layer, first) for each layer: "body.0", "body.1", ..., "head.0.0", ...; `first`
/// = it reads the input.
template <class Use>
void each_layer(const nn::PlainNetwork& network, const Use& use) {
  const auto chain = [&](const std::string& name, const std::vector<nn::PlainLayer>& layers,
                         bool first) {
    for (std::size_t i = 0; i < layers.size(); ++i) {
      use(name + std::to_string(i), layers[i], first && i == 0);
    }
  };
  chain("body.", network.body, true);
  for (std::size_t h = 0; h < network.heads.size(); ++h) {
    chain("head." + std::to_string(h) + ".", network.heads[h], network.body.empty());
  }
}

/// An ONNX model (operator set 13, so that every runtime of today reads it): input "observation"
/// [batch, numbers] or [batch, height, width, channels] as the world shows it, or "state" [batch];
/// outputs "q" [batch, actions] and "action" [batch], the best one that the state has; of letters
/// of names only "q", since they do not tell which actions those are. The facts are its metadata,
/// the vectors among them as "self_test".
std::string network_onnx(const NetworkExport& what);

/// A header for C99 and C++: NAME_q(observation, q) and NAME_act(observation). Compiled with
/// QUOLL_SELF_TEST it is a program that checks itself on the vectors and returns 0. Networks that
/// read observations only: a numbered state's action is a table's matter (policy_c).
std::string network_c(const NetworkExport& what);

/// The weights by name in the safetensors format, oriented as PyTorch's layers are, with the
/// vectors as "self_test.inputs" and "self_test.q". Layers are named as each_layer() does, with
/// ".weight", ".bias", ".norm.weight", ".norm.bias".
std::string network_safetensors(const NetworkExport& what);

}  // namespace quoll
