#pragma once
// The name of a numbered state as inputs of a network: what a board or a map is called often spells
// what is on it. One input for each letter that some name has at a place where names differ; ends
// do not count, nobody asks what to do there. To tell of states that were never seen, an action
// must mean the same in all of them: one output for each name of an action, wherever a state lists
// it.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/env/world.hpp"

namespace quoll {

class NameLetters {
 public:
  /// Of all states of the world. Error: it shows numbers, or its states cannot be listed. Cost: the
  /// names, once.
  static Result<std::shared_ptr<const NameLetters>> make(const World& world, const Spaces& spaces);

  /// What an input is 1 for: this letter at this place of a name, counted from 0.
  struct Letter {
    char32_t letter;
    std::size_t place;
  };

  /// Number of inputs.
  std::size_t size() const { return letters_.size(); }
  /// Of each input.
  std::span<const Letter> letters() const { return letters_; }
  /// The inputs that are 1 for a state, ascending; all others are 0.
  std::span<const std::uint32_t> of(std::uint64_t state) const {
    return std::span(spots_).subspan(begin_[state], begin_[state + 1] - begin_[state]);
  }
  /// Number of outputs, and that of an action as the state numbers it.
  std::size_t outputs() const { return output_names_.size(); }
  /// Of each output the actions' name; empty for those that no action has.
  std::span<const std::string> output_names() const { return output_names_; }
  /// In an end, which lists none, any action may be told of; it is its own.
  Action output(State state, Action action) const {
    const std::uint64_t pair = row_begin_[state] + action;
    return pair < row_begin_[state + 1] ? output_[pair] : action;
  }

 private:
  void name_outputs(const Mdp& mdp);

  std::vector<Letter> letters_;
  std::vector<std::string> output_names_;
  std::vector<Action> output_;            // per pair
  std::vector<std::uint64_t> row_begin_;  // of them, per state
  std::vector<std::uint32_t> spots_;
  std::vector<std::size_t> begin_;
};

}  // namespace quoll
