#pragma once
// Policy iteration for total reward without discounting, on a whole model or on one part after
// another: see ending_iteration.cpp.

#include <cstdint>
#include <span>
#include <vector>

#include "quoll/model/mdp.hpp"
#include "quoll/solve/ending.hpp"
#include "quoll/solve/policy_rows.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {

class EndingIteration {
 public:
  /// For a stochastic model of one player. Values of live states begin at 0, with the policy of
  /// `ending`. Memory: the rows of a policy, 30 bytes a state.
  EndingIteration(const Mdp& mdp, const SolveSettings& settings, Ending ending);

  /// Solves for all states. `patient`: never switches before an accurate evaluation, which is
  /// Howard's method and slow.
  void run(bool patient);
  /// Solves for these live states alone; what can follow them is among them or was solved before.
  /// A state that returns to no other costs one backup.
  void run_part(std::span<const State> part);

  bool stopped() const { return !go_on_; }
  /// The policy with certified bounds; call that last.
  Solution finish();

 private:
  void iterate(bool patient);
  void restart();
  void follow_wave();
  double evaluate(std::uint64_t most_sweeps);
  double improve();
  double rounding() const;
  bool ends();
  void choose_alone(State s);
  void take(State s, Action a);
  void count(std::uint64_t updates, double change);

  const Mdp& mdp_;
  const SolveSettings& settings_;
  Ending ending_;
  std::vector<State> all_;       // the live states
  std::span<const State> part_;  // those being solved
  std::vector<double> value_;
  PolicyRows rows_;
  double reward_size_ = 0.0;
  unsigned endless_ = 0;
  bool failed_ = false;  // some part was given up
  bool go_on_ = true;
  std::uint64_t updates_ = 0;         // not yet a whole sweep
  std::vector<std::uint32_t> place_;  // in part_; for ends()
  Solution solution_;
};

}  // namespace quoll
