#pragma once
// What a network has learned as plain data, for whoever writes it down for other programs: how
// inputs are made of what is observed, the layers, and how their outputs become Q.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "quoll/learn/deep/deep_settings.hpp"
#include "quoll/learn/deep/name_letters.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/nn/plain.hpp"

namespace quoll {

struct LearnedNetwork {
  nn::Extent observed;    ///< what is shown: numbers, planes, or 1 x 1 x states if `numbered`
  bool numbered = false;  ///< a state's number is read as one 1 among zeros
  /// What is observed are the letters of a state's name, and outputs are those of actions' names.
  std::shared_ptr<const NameLetters> letters;
  std::vector<float> middle, scale;  ///< reads (x - middle) * scale; empty: x as it is
  /// Of layout joint it reads that, and then one 1 among zeros for the action.
  nn::PlainNetwork network;
  NetworkLayout layout = NetworkLayout::shared;
  /// Heads: a value and advantages; Q = value + advantage - mean advantage, of each atom.
  bool duelling = false;
  std::uint32_t actions = 0;
  Returns returns = Returns::mean;
  std::uint32_t atoms = 1;     ///< outputs per action, together
  std::vector<float> support;  ///< of Returns::categorical: what each atom stands for
  double value_scale = 1.0;    ///< Q is divided by it
  /// Q by the learner's own arithmetic: of a state if `numbered`, else of an observation; writes
  /// `actions` numbers. Not from several threads.
  std::function<void(State, std::span<const float>, std::span<float>)> values;
};

}  // namespace quoll
