#pragma once
// The referee of a race, or of a run that asks for a certificate by the model: it alone knows the
// model and its exact answer, and says of a policy whether it loses too much. Those who learn see
// experience only.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "quoll/env/world.hpp"
#include "quoll/experiment/heat.hpp"
#include "quoll/experiment/policy_part.hpp"
#include "quoll/learn/certifier.hpp"
#include "quoll/model/solution.hpp"

namespace quoll {

/// What one judgement leaves to the next about policies that follow one from another: room, where
/// the last one was too bad, and what was said of it. For one referee and one thread.
struct RefereeNotes {
  PolicyPart part;
  std::vector<double> value;
  std::optional<State> witness;  ///< mode all: a state that was too bad
  /// The last policy judged as a whole: its actions where it can come to, and what was said.
  std::vector<Action> actions;
  RaceMode mode = RaceMode::start;
  bool good = false;
};

class Referee {
 public:
  /// Solves the world exactly. Error: a world without a model, a game of two who move in turn,
  /// discount 1 where values are not defined. `share`: what a policy may lose of |V*|.
  static Result<Referee> make(const World& world, double discount, double share = 0.01);

  /// For a goal: a policy may lose its gap where episodes begin, or in every state that can be
  /// reached from `from`, by the solver's bounds, so that rounding is not forgiven. Ask for mode
  /// all. Error: the world has no exact answer at this discount.
  static Result<Referee> of_goal(const World& world, double discount, const CertifyGoal& goal,
                                 std::span<const State> from);

  /// Whether V*(s) - V^policy(s) <= share |V*(s)| in every non-terminal state (mode all), or for
  /// the value of the start distribution (mode start). What a state without an action is worth is
  /// not known: it counts as the least the rewards allow. Rounding is forgiven: 1e-14 of the
  /// largest |V*| in deterministic worlds, 1e-9 in others. Only states that the policy can come to
  /// are asked about. Cost: of those a few sweeps, or an evaluation where these do not decide; a
  /// state that was too bad before is looked at first. Safe to call from several threads.
  bool good(const PolicyView& policy, RaceMode mode, RefereeNotes& notes) const;
  /// The same of a policy in an array, one action per state.
  bool good(std::span<const Action> policy, RaceMode mode) const;

  /// No learner can be good after fewer steps: each shows it the actions of one state, and of the
  /// others it knows nothing.
  std::uint64_t fewest_steps(RaceMode mode) const {
    return mode == RaceMode::all ? judged_.size() : fewest_for_start_;
  }

  double discount() const { return discount_; }
  const std::vector<double>& values() const { return best_; }  ///< V* per state

 private:
  Referee(std::shared_ptr<const Mdp> mdp, double discount)
      : mdp_(std::move(mdp)), discount_(discount) {}
  Result<Solution> find_best();
  Result<std::uint64_t> fewest_for_start() const;
  /// The value of the start distribution from that of its states.
  template <class Value>
  double start_sum(const Value& value) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < mdp_->start().size(); ++i) {
      const State s = mdp_->start()[i];
      if (!mdp_->terminal(s)) sum += mdp_->start_probability(i) * value(s);
    }
    return sum;
  }
  enum class Verdict : std::uint8_t { bad, good, open };
  bool bad_at_witness(const PolicyView& policy, RefereeNotes& notes) const;
  bool judge(RaceMode mode, RefereeNotes& notes) const;
  Verdict by_sweeps(RaceMode mode, RefereeNotes& notes) const;
  bool by_value(RaceMode mode, RefereeNotes& notes) const;
  bool good_game(const PolicyView& policy) const;

  std::shared_ptr<const Mdp> mdp_;
  double discount_;
  std::vector<double> best_;   // V*
  std::vector<double> least_;  // per state: what is still good enough; -infinity = anything
  std::vector<State> judged_;  // those where not anything is
  double best_start_ = 0.0, least_start_ = 0.0;
  double slack_ = 0.0;
  double width_ = 1e-9;  // to which policies are evaluated
  std::uint64_t fewest_for_start_ = 0;
};

}  // namespace quoll
