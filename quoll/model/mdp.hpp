#pragma once
// The finite Markov decision process: states -> choices -> outcomes, as flat arrays. Immutable,
// validated once when it is made, names kept. Puterman 1994, section 2.1.

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/model/column.hpp"
#include "quoll/model/names.hpp"

namespace quoll {

using State = std::uint32_t;   ///< index of a state
using Action = std::uint32_t;  ///< index of an action among those of its state
inline constexpr Action no_action = std::numeric_limits<Action>::max();
inline constexpr std::uint64_t max_states = (std::uint64_t{1} << 31) - 1;

/// Where the states stand when they are cells of a grid; only for pictures.
struct Layout {
  std::uint32_t rows = 0;
  std::uint32_t columns = 0;
  std::vector<std::uint32_t> cell;  ///< per state: row * columns + column
  /// Per action *name* index: step to the right and down when that move succeeds, e.g. {1, 0}.
  std::vector<std::pair<int, int>> direction;
  /// Where the picture lies in the world of a robot, if a map says so.
  struct Frame {
    double side = 1.0;                   ///< of a cell, in metres
    double x = 0.0, y = 0.0, yaw = 0.0;  ///< pose of the lower left corner, in metres and radians
  };
  std::optional<Frame> frame{};
};

/// A named set of states, as model checkers keep them ("goal", "init", "deadlock").
struct Label {
  std::string name;
  std::vector<State> states;  ///< ascending, each once
};

/// A named law of rewards beside the one in use; forms as MdpArrays::reward and outcome_reward.
struct RewardStructure {
  std::string name;
  std::vector<double> reward;          ///< per choice: expected reward; may be empty as there
  std::vector<double> outcome_reward;  ///< per outcome; empty = the choice's reward for each
};

/// The arrays of an Mdp. Indices: a state's choices are choice_begin[s] .. choice_begin[s+1]; a
/// choice's outcomes are outcome_begin[c] .. outcome_begin[c+1].
struct MdpArrays {
  std::vector<std::uint64_t> choice_begin;   ///< states + 1
  std::vector<std::uint64_t> outcome_begin;  ///< choices + 1; empty = one outcome per choice
  std::vector<State> next;                   ///< per outcome
  Column probability;                        ///< per outcome; empty = all 1 (deterministic)
  /// Per choice: expected reward. make() computes it if outcome_reward is given; it may stay empty
  /// then.
  std::vector<double> reward;
  std::vector<double> outcome_reward;  ///< per outcome; empty = the choice's reward for each
  std::vector<std::uint32_t> action;   ///< per choice: index into action_names
  /// States an episode may begin in, ascending; empty for make() = all states that are not ends.
  std::vector<State> start;
  std::vector<double> start_probability;  ///< per start state; empty = uniform
  std::vector<State> terminal;            ///< declared terminal, ascending; may have choices
  Names state_names;
  Names action_names;
  std::vector<Label> labels;                   ///< by name, each name once
  std::string reward_name;                     ///< of the rewards in use; may be empty
  std::vector<RewardStructure> other_rewards;  ///< each name once, none is reward_name
  double discount = 1.0;
  /// A game of two who move in turn: every move that does not end it passes the turn. Values and
  /// rewards are those of the player to move, so that what follows counts -discount (negamax).
  /// One flag for the model suffices: a player who may do nothing has an action that says so, and
  /// one who moves again takes both moves in one action; games in which the turn sometimes stays
  /// are environments, whose Feedback says it step by step.
  bool alternating = false;
  std::optional<Layout> layout;
  /// Per choice: its line in the file, for messages; may be empty; dropped by make().
  std::vector<std::uint32_t> choice_line;
  /// What a reader noticed, one sentence each ("state A, action go: successor B stands twice");
  /// check() shows them as warnings.
  std::vector<std::string> remarks;
};

class Mdp {
 public:
  /// Validates the arrays: offsets ascending, successors known, probabilities in [0, 1] with each
  /// row's sum within 1e-9 of 1, rewards finite, discount in (0, 1], at least one start. The Error
  /// names the first offending state and action, and its line if known. Then brings the arrays to
  /// their one smallest form: outcomes of probability 0 are dropped, and so is each array whose
  /// emptiness says the same; probabilities are never altered. Cost: a few passes, no copy.
  static Result<Mdp> make(MdpArrays arrays);

  std::uint64_t states() const { return a_.choice_begin.size() - 1; }
  std::uint64_t choices() const { return a_.choice_begin.back(); }
  std::uint64_t outcomes() const { return a_.next.size(); }
  bool deterministic() const { return a_.probability.empty() && a_.outcome_begin.empty(); }
  double discount() const { return a_.discount; }
  /// Two players move in turn; see MdpArrays::alternating.
  bool alternating() const { return a_.alternating; }
  /// What the value of a next state is multiplied by, at this discount: negative when the turn
  /// passes (Shapley 1953 for the sign).
  double carry(double discount) const { return a_.alternating ? -discount : discount; }

  /// Number of actions of a state (0 for most ends).
  Action actions(State s) const {
    return static_cast<Action>(a_.choice_begin[s + 1] - a_.choice_begin[s]);
  }
  /// First choice of a state; the choice of action a is choice_begin(s) + a.
  std::uint64_t choice_begin(State s) const { return a_.choice_begin[s]; }
  std::uint64_t choice_end(State s) const { return a_.choice_begin[s + 1]; }
  std::uint64_t outcome_begin(std::uint64_t choice) const {
    return a_.outcome_begin.empty() ? choice : a_.outcome_begin[choice];
  }
  std::uint64_t outcome_end(std::uint64_t choice) const {
    return a_.outcome_begin.empty() ? choice + 1 : a_.outcome_begin[choice + 1];
  }
  State next(std::uint64_t outcome) const { return a_.next[outcome]; }
  double probability(std::uint64_t outcome) const {
    return a_.probability.empty() ? 1.0 : a_.probability[outcome];
  }
  /// Expected reward of a choice.
  double reward(std::uint64_t choice) const { return a_.reward[choice]; }
  /// Reward of one outcome of a choice.
  double reward(std::uint64_t choice, std::uint64_t outcome) const {
    return a_.outcome_reward.empty() ? a_.reward[choice] : a_.outcome_reward[outcome];
  }
  /// An end: no actions, or declared terminal. Nothing is earned after it.
  bool terminal(State s) const { return ends_[s]; }

  std::span<const State> start() const { return a_.start; }
  double start_probability(std::uint64_t index) const {
    return a_.start_probability.empty() ? 1.0 / static_cast<double>(a_.start.size())
                                        : a_.start_probability[index];
  }

  std::string state_name(State s) const { return a_.state_names[s]; }
  std::string action_name(std::uint64_t choice) const { return a_.action_names[a_.action[choice]]; }
  std::optional<State> find_state(std::string_view name) const;
  /// The label, or structure of rewards beside the one in use, of that name; nullptr = none.
  const Label* find_label(std::string_view name) const;
  const RewardStructure* find_rewards(std::string_view name) const;
  const Layout* layout() const { return a_.layout ? &*a_.layout : nullptr; }
  const MdpArrays& arrays() const { return a_; }

  /// Smallest and largest reward an action of a non-terminal state can give.
  std::pair<double, double> reward_bounds() const { return reward_bounds_; }
  /// Bytes of memory held by the arrays and names.
  std::uint64_t bytes() const;

 private:
  MdpArrays a_;
  std::vector<bool> ends_;
  std::pair<double, double> reward_bounds_{0.0, 0.0};
};

}  // namespace quoll
