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
    if (judged) referee.judged_.push_back(s);
  }
  referee.best_start_ = referee.start_sum([&](State s) { return referee.best_[s]; });
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
    const bool judged = asked[s] && !mdp.terminal(s) && least > -HUGE_VAL;
    referee.least_.push_back(judged ? least : -HUGE_VAL);
    if (judged) referee.judged_.push_back(s);
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

// From V* the sweeps of a policy only fall, towards its value: one that is too low stays so
// (Puterman 1994, theorem 6.2.2). The other way round, a sweep that lowers no value by more than d
// leaves at most discount d / (1 - discount) for all that follow (proposition 6.6.1), whatever it
// began from.
Referee::Verdict Referee::by_sweeps(RaceMode mode, RefereeNotes& notes) const {
  constexpr int sweeps = 100;
  const PolicyPart& part = notes.part;
  const std::span<const State> states = part.states();
  const double rest = 1.0 - discount_;
  const double least = rest > 0.0 ? std::min(0.0, mdp_->reward_bounds().first) / rest : 0.0;
  std::vector<double>& value = notes.value;
  value.resize(states.size() + 1);
  for (std::size_t i = 0; i < states.size(); ++i) {
    value[i] = part.actions()[i] == no_action ? least : best_[states[i]];
  }
  value.back() = 0.0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double spare = HUGE_VAL;
    const double fell = part.sweep(discount_, value, [&](std::size_t i) {
      if (mode == RaceMode::start) return true;
      const double over = value[i] - least_[states[i]];
      if (over < 0.0) notes.witness = states[i];
      spare = std::min(spare, over);
      return !(over < 0.0);
    });
    if (mode == RaceMode::start) {
      spare = start_sum([&](State s) { return value[part.number(s)]; }) - least_start_;
    }
    if (spare < 0.0) return Verdict::bad;
    if (fell == 0.0 && rest == 0.0) break;
    // Sums are rounded: half of what is forgiven is kept for that.
    if (rest < 1e-4) continue;
    const double still = discount_ * fell / rest + slack_ / 2;
    if (spare >= still) return Verdict::good;
    if (fell < slack_ * rest / 16) break;  // too near to the limit for sweeps
  }
  return Verdict::open;
}

// By an evaluation of the part.
bool Referee::by_value(RaceMode mode, RefereeNotes& notes) const {
  const PolicyPart& part = notes.part;
  const Result<Mdp> chain = part.model(*mdp_);
  if (!chain) return false;
  std::vector<Action> policy(chain->states(), 0);
  for (std::size_t i = 0; i < part.states().size(); ++i) {
    // Without discounting such a state may be worth anything.
    if (discount_ == 1.0) policy[i] = part.actions()[i] == no_action ? no_action : 0;
  }
  const Result<Evaluation> value = evaluate(*chain, policy, discount_, width_);
  if (!value) return false;
  if (mode == RaceMode::start) {
    return start_sum([&](State s) { return value->lower[part.number(s)]; }) >= least_start_;
  }
  for (std::size_t i = 0; i < part.states().size(); ++i) {
    if (value->lower[i] < least_[part.states()[i]]) {
      notes.witness = part.states()[i];
      return false;
    }
  }
  return true;
}

bool Referee::judge(RaceMode mode, RefereeNotes& notes) const {
  // Along the graph of a deterministic model an evaluation costs no more than a few sweeps.
  const bool sweeps = !mdp_->deterministic() && (discount_ < 1.0 || notes.part.all_known());
  const Verdict verdict = sweeps ? by_sweeps(mode, notes) : Verdict::open;
  return verdict == Verdict::open ? by_value(mode, notes) : verdict == Verdict::good;
}

// A state that was too bad mostly still is, and a small part of the model shows it.
bool Referee::bad_at_witness(const PolicyView& policy, RefereeNotes& notes) const {
  if (!notes.witness) return false;
  const State witness = *notes.witness;
  if (policy(witness) == no_action) return true;
  const std::uint64_t few = mdp_->states() / 8;
  return notes.part.find(*mdp_, policy, {&witness, 1}, few) && !judge(RaceMode::all, notes);
}

// Whoever moves: it takes all states.
bool Referee::good_game(const PolicyView& policy) const {
  std::vector<Action> actions(mdp_->states(), no_action);
  for (State s = 0; s < mdp_->states(); ++s) {
    if (!mdp_->terminal(s)) actions[s] = policy(s);
  }
  const Result<Evaluation> value = evaluate(*mdp_, actions, discount_, width_);
  return value && std::all_of(judged_.begin(), judged_.end(),
                              [&](State s) { return value->lower[s] >= least_[s]; });
}

bool Referee::good(const PolicyView& policy, RaceMode mode, RefereeNotes& notes) const {
  if (mode == RaceMode::all) {
    if (!mdp_->alternating() && bad_at_witness(policy, notes)) return false;
    const auto unknown = std::find_if(judged_.begin(), judged_.end(),
                                      [&](State s) { return policy(s) == no_action; });
    if (unknown != judged_.end()) {
      notes.witness = *unknown;
      return false;
    }
  }
  if (mdp_->alternating()) return good_game(policy);
  notes.part.find(*mdp_, policy, mode == RaceMode::all ? judged_ : mdp_->start());
  const std::span<const Action> actions = notes.part.actions();
  if (notes.mode == mode &&
      std::equal(actions.begin(), actions.end(), notes.actions.begin(), notes.actions.end())) {
    return notes.good;
  }
  notes.actions.assign(actions.begin(), actions.end());
  notes.mode = mode;
  notes.good = judge(mode, notes);
  if (notes.good) notes.witness.reset();
  return notes.good;
}

bool Referee::good(std::span<const Action> policy, RaceMode mode) const {
  RefereeNotes notes;
  return good([&](State s) { return policy[s]; }, mode, notes);
}

}  // namespace quoll
