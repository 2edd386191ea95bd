#pragma once
// A model from files that number their states and choices and list them in that order, as those of
// model checkers do: straight into the arrays.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quoll/model/mdp.hpp"
#include "quoll/model/name_index.hpp"

namespace quoll {

class NumberedModel {
 public:
  /// Reserves address space, not memory, for this many outcomes; more may come.
  explicit NumberedModel(std::uint64_t expected_outcomes);

  /// The next state. At most max_states; the caller counts.
  void open_state() { a_.choice_begin.push_back(a_.action.size()); }
  /// The next choice of the last state. Model checkers allow choices of equal name or of none: a
  /// name another choice of the state has gets the choice's number behind it ("go.1"), and one
  /// without a name is called by its number. `line` is where it stands.
  void open_choice(std::string_view name, std::uint64_t line);
  /// The next outcome of the last choice.
  void add(State next, double probability) {
    a_.next.push_back(next);
    a_.probability.push_back(probability);
  }

  std::uint64_t states() const { return a_.choice_begin.size(); }
  std::uint64_t choices() const { return a_.action.size(); }
  /// Choices of the last state.
  std::uint64_t choices_of_state() const { return a_.action.size() - a_.choice_begin.back(); }
  std::uint64_t outcomes() const { return a_.next.size(); }
  /// A name that had to be altered, as a sentence; empty = none.
  const std::string& renamed() const { return renamed_; }

  /// The arrays of all but rewards, names of states, start, labels and discount, which is 1.
  MdpArrays finish();

 private:
  std::uint32_t action_of(std::string_view name);
  bool taken(std::uint32_t action) const;

  MdpArrays a_;
  NameIndex actions_;
  std::vector<std::uint64_t> last_state_;  // per action: the last state that has it, from 1
  std::string renamed_;
};

/// A name for a state from the values of its variables: "(x=1,y=2)".
class StateNames {
 public:
  /// The names of the variables; a single one called `name` means that its value is the name.
  explicit StateNames(std::vector<std::string> variables) : variables_(std::move(variables)) {}

  /// The name of a state with these values, in the order of the variables. Expects as many.
  std::string name_of(const std::vector<std::string_view>& values) const;
  const std::vector<std::string>& variables() const { return variables_; }
  bool plain() const { return variables_.size() == 1 && variables_[0] == "name"; }

  /// The variables that the names of all states of a model give values to, or the one called
  /// `name`.
  static StateNames of(const Mdp& mdp);
  /// The values of a state's name, "1,2" of "(x=1,y=2)"; of plain names the name itself.
  std::string values_of(const std::string& name) const;

 private:
  std::vector<std::string> variables_;
};

/// The names and values of "(x=1,y=2)", views into the name; empty if it has another form.
std::vector<std::pair<std::string_view, std::string_view>> valuation(std::string_view name);

/// Whether the model's names of states are nothing but their numbers: then files need none.
bool states_are_numbered(const Mdp& mdp);

/// How much of a model its files have: what its ends could do counts for nothing and is left out,
/// because to model checkers a state with choices is no end.
struct WrittenSizes {
  std::uint64_t choices = 0, outcomes = 0;
};
WrittenSizes written_sizes(const Mdp& mdp);

/// The name a file has to give a choice, "" if it is its number.
std::string given_name(const Mdp& mdp, State state, std::uint64_t choice);

}  // namespace quoll
