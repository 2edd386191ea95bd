#pragma once
// The part of a model that a policy can come to: all that its value depends on.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

/// The action of a state, asked for when it is needed; no_action = none is known.
using PolicyView = std::function<Action(State)>;

/// Found again and again in the same room. Its states are numbered in the order they are found; the
/// number after the last is the end of all ways.
class PolicyPart {
 public:
  /// All states that can follow from `from` under the policy, these included, ends not. False: they
  /// are more than `most`, and nothing is found. Cost: the states found and their outcomes; 8 bytes
  /// for each state of the model the first time.
  bool find(const Mdp& mdp, const PolicyView& policy, std::span<const State> from,
            std::uint64_t most = max_states);

  std::span<const State> states() const { return states_; }
  std::span<const Action> actions() const { return actions_; }  ///< of these
  bool all_known() const { return all_known_; }
  /// Whether the policy can come to `s`, and its number.
  bool holds(State s) const { return !round_.empty() && round_[s] == now_; }
  std::uint32_t number(State s) const { return number_[s]; }

  /// The part as a model with one choice per state. A state without an action is left in it with a
  /// choice that stays and earns the least that the rewards of the whole model allow, or 0.
  Result<Mdp> model(const Mdp& mdp) const;

  /// One sweep of the policy's backups, last state first, that lowers values only; the end's is the
  /// last of them. Calls look(number) after each state; false stops. Returns by how much the value
  /// fell that fell most.
  template <class Look>
  double sweep(double discount, std::vector<double>& value, const Look& look) const {
    double most = 0.0;
    for (std::size_t i = states_.size(); i-- > 0;) {
      double sum = 0.0;
      for (std::uint64_t o = begin_[i]; o < begin_[i + 1]; ++o) {
        sum += probability_[o] * value[next_[o]];
      }
      const double backup = reward_[i] + discount * sum;
      if (backup < value[i]) {
        most = most < value[i] - backup ? value[i] - backup : most;
        value[i] = backup;
      }
      if (!look(i)) break;
    }
    return most;
  }

 private:
  void begin(const Mdp& mdp);
  void meet(const Mdp& mdp, State s);

  std::vector<std::uint32_t> round_;   // per state of the model: the call that found it last
  std::vector<std::uint32_t> number_;  // and as which
  std::uint32_t now_ = 0;
  std::vector<State> states_;
  std::vector<Action> actions_;
  bool all_known_ = true;
  // Per number its reward and its outcomes begin_[i] .. begin_[i + 1].
  std::vector<double> reward_;
  std::vector<std::uint64_t> begin_;
  std::vector<std::uint32_t> next_;
  std::vector<double> probability_;
};

}  // namespace quoll
