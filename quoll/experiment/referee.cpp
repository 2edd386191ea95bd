#include "quoll/experiment/referee.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "quoll/model/graph.hpp"
#include "quoll/solve/evaluate.hpp"
#include "quoll/solve/optimality.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {

Result<Referee> Referee::make(const World& world, double discount, double share) {
  if (!world.mdp) {
    return Error{
        "", 0, 0,
        "the model of " + world.name + " is not known: who is within 1 % of optimal cannot be told",
        ""};
  }
  if (world.mdp->alternating()) {
    return Error{"", 0, 0, "two players move in turn in " + world.name + ": a race is run by one",
                 ""};
  }
  Referee referee(world.mdp, discount);
  const Mdp& mdp = *world.mdp;
  const Result<Solution> solution = referee.find_best();
  if (!solution) return solution.error();
  referee.width_ = std::max(referee.slack_ / 4, 1e-300);
  const auto enough = [&](double value) {
    return value - share * std::fabs(value) - referee.slack_;
  };
  for (State s = 0; s < mdp.states(); ++s) {
    const double value = referee.best_[s];
    const bool judged = !mdp.terminal(s) && std::isfinite(value);
    referee.least_.push_back(judged ? enough(value) : -HUGE_VAL);
    referee.fewest_for_all_ += judged;
  }
  referee.best_start_ = referee.start_value(referee.best_);
  referee.least_start_ = enough(referee.best_start_);
  const Result<std::uint64_t> fewest = referee.fewest_for_start();
  if (!fewest) return fewest.error();
  referee.fewest_for_start_ = *fewest;
  return referee;
}

Result<Referee> Referee::of_goal(const World& world, double discount, const CertifyGoal& goal,
                                 std::span<const State> from) {
  Referee referee(world.mdp, discount);
  const Mdp& mdp = *world.mdp;
  const Result<Solution> solution = referee.find_best();
  if (!solution) return solution.error();
  double scale = HUGE_VAL;
  for (const State s : mdp.start()) scale = std::min(scale, std::fabs(solution->lower[s]));
  std::vector<bool> asked(mdp.states(), false);
  for (const State s : mdp.start()) asked[s] = true;
  if (goal.everywhere) asked = reachable(mdp, from);
  for (State s = 0; s < mdp.states(); ++s) {
    const double least = solution->upper[s] - goal.gap * (goal.relative ? scale : 1.0);
    referee.least_.push_back(asked[s] && !mdp.terminal(s) ? least : -HUGE_VAL);
  }
  return referee;
}

Result<Solution> Referee::find_best() {
  SolveSettings settings;
  settings.discount = discount_;
  settings.width = 1e-9;
  Result<Solution> solution = solve(*mdp_, settings);
  if (!solution) return solution;
  double scale = 0.0;
  for (State s = 0; s < mdp_->states(); ++s) {
    const double value = solution->lower[s] / 2 + solution->upper[s] / 2;
    best_.push_back(value);
    if (std::isfinite(value)) scale = std::max(scale, std::fabs(value));
  }
  slack_ = (mdp_->deterministic() ? 1e-14 : 1e-9) * scale;
  return solution;
}

// With an action known in n states the start is worth at most V* there and the least elsewhere: the
// n states where that matters most are not enough while too much is lost in the others.
Result<std::uint64_t> Referee::fewest_for_start() const {
  const std::vector<Action> nothing(mdp_->states(), no_action);
  const Result<Evaluation> least = evaluate(*mdp_, nothing, discount_);
  if (!least) return least.error();
  std::vector<double> losses;
  double lost = 0.0;
  for (std::size_t i = 0; i < mdp_->start().size(); ++i) {
    const State s = mdp_->start()[i];
    if (mdp_->terminal(s) || !std::isfinite(best_[s])) continue;
    losses.push_back(mdp_->start_probability(i) * (best_[s] - std::max(least->lower[s], -1e300)));
    lost += losses.back();
  }
  std::sort(losses.begin(), losses.end(), std::greater<>());
  // Rounding in the sums is forgiven by one part in a million.
  const double allowed = (best_start_ - least_start_) * (1 + 1e-6) + 1e-6 * slack_;
  std::uint64_t count = 0;
  while (count < losses.size() && lost > allowed) lost -= losses[count++];
  return count;
}

double Referee::start_value(std::span<const double> values) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < mdp_->start().size(); ++i) {
    const State s = mdp_->start()[i];
    if (!mdp_->terminal(s)) sum += mdp_->start_probability(i) * values[s];
  }
  return sum;
}

// From V* the sweeps of a policy only fall, towards its value: one that is too low stays so
// (Puterman 1994, theorem 6.2.2).
bool Referee::certainly_bad(std::span<const Action> policy, RaceMode mode) const {
  constexpr int sweeps = 50;
  const Mdp& mdp = *mdp_;
  std::vector<double> value = best_;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (State s = 0; s < mdp.states(); ++s) {
      if (mdp.terminal(s) || policy[s] == no_action || !std::isfinite(value[s])) continue;
      value[s] = std::min(value[s], q_star(mdp, value, mdp.choice_begin(s) + policy[s], discount_));
      if (mode == RaceMode::all && value[s] < least_[s]) return true;
    }
    if (mode == RaceMode::start && start_value(value) < least_start_) return true;
  }
  return false;
}

bool Referee::good(std::span<const Action> policy, RaceMode mode) const {
  const Mdp& mdp = *mdp_;
  if (mode == RaceMode::all) {
    for (State s = 0; s < mdp.states(); ++s) {
      if (policy[s] == no_action && least_[s] > -HUGE_VAL) return false;
    }
  }
  // Along the graph of a deterministic model an evaluation costs no more than a sweep.
  if (!mdp.deterministic() && !mdp.alternating() && certainly_bad(policy, mode)) return false;
  const Result<Evaluation> value = evaluate(mdp, policy, discount_, width_);
  if (!value) return false;
  if (mode == RaceMode::start) return start_value(value->lower) >= least_start_;
  for (State s = 0; s < mdp.states(); ++s) {
    if (value->lower[s] < least_[s]) return false;
  }
  return true;
}

}  // namespace quoll
