#pragma once
// Builds an Mdp move by move, for worlds written in code and for readers of small files.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

class MdpBuilder {
 public:
  explicit MdpBuilder(double discount) : discount_(discount) {}

  /// Index of the state called `name`; made on first mention, in order of mention.
  State state(std::string_view name);
  /// Index into the action names; made on first mention.
  std::uint32_t action(std::string_view name);

  /// From `from` by `action` to `to` with this reward and probability. Outcomes of one (state,
  /// action) may come in any order; equal successors with equal reward are joined.
  MdpBuilder& move(std::string_view from, std::string_view action, std::string_view to,
                   double reward = 0.0, double probability = 1.0);
  void move(State from, std::uint32_t action, State to, double reward, double probability);

  /// Declares an end: nothing is earned after it, even if it has moves.
  MdpBuilder& terminal(std::string_view name);
  /// Adds a start state; weights are normalised. Without any: uniform over the states with actions.
  MdpBuilder& start(std::string_view name, double weight = 1.0);
  /// Two players move in turn; see MdpArrays::alternating.
  void alternating(bool alternating) { alternating_ = alternating; }
  void layout(Layout layout) { layout_ = std::move(layout); }

  std::uint64_t states() const { return state_names_.size(); }

  /// The arrays, not validated; actions of a state stand in order of first mention. Fails only for
  /// a move between states or by an action that were never named.
  Result<MdpArrays> arrays() const;
  /// The model. Errors as Mdp::make.
  Result<Mdp> build() const;

 private:
  struct Move {
    State from;
    std::uint32_t action;
    State to;
    double reward;
    double probability;
  };
  std::vector<std::size_t> ordered(std::vector<std::size_t>& mention) const;
  void place_starts(MdpArrays& arrays) const;

  double discount_;
  bool alternating_ = false;
  std::vector<Move> moves_;
  std::vector<std::string> state_names_, action_names_;
  std::unordered_map<std::string, std::uint32_t> state_index_, action_index_;
  std::vector<State> terminal_;
  std::vector<std::pair<State, double>> start_;
  std::optional<Layout> layout_;
};

}  // namespace quoll
