#include "quoll/learn/certifier.hpp"

#include <algorithm>
#include <cmath>

#include "quoll/base/text.hpp"
#include "quoll/learn/tabular/any_source.hpp"
#include "quoll/learn/tabular/model_learning.hpp"

namespace quoll {
namespace {

ListedSuccessors listed_by(const Mdp& mdp) {
  ListedSuccessors list;
  list.begin.push_back(0);
  std::vector<State> row;
  for (std::uint64_t c = 0; c < mdp.choices(); ++c) {
    row.clear();
    for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
      row.push_back(mdp.next(o));
    }
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    for (const State next : row) list.next.push_back(mdp.terminal(next) ? the_end : next);
    list.begin.push_back(list.next.size());
  }
  return list;
}

}  // namespace

Result<Certifier> Certifier::make(const LearnSetup& setup, const CertifyGoal& goal) {
  const World& world = *setup.world;
  const Result<void> bounded = finite_value_range(world, setup.rewards, setup.discount,
                                                  "a certificate from experience", "--until");
  if (!bounded) return bounded.error();
  Certifier made;
  made.goal_ = goal;
  made.certain_ = world.traits.deterministic;
  made.discount_ = setup.discount;
  made.rewards_ = *setup.rewards;
  made.values_ = value_range(*setup.rewards, setup.discount);
  if (!made.certain_ && !std::isfinite(made.values_.first)) {
    return Error{"--discount", 0, 0,
                 "a certificate from noisy experience needs a least value, and at discount 1 costs "
                 "on the way have none: a discount below 1 expected",
                 ""};
  }
  if (goal.listed) {
    if (!world.mdp) {
      return Error{"--successors", 0, 0, world.name + " has no list of successors: states expected",
                   "states"};
    }
    made.successors_ = listed_by(*world.mdp);
  }
  made.begin_ = AnySource<double>::rows_of(world);
  made.pessimism_ = known_pairs_only(setup);
  made.hope_ = unknown_pairs_best(setup);
  made.model_ = CountedModel(made.begin_.back());
  made.square_sum_.assign(made.begin_.back(), 0.0);
  made.acted_.assign(made.begin_.size() - 1, 0);
  made.began_ = made.acted_;
  if (setup.starts.kind() != StartStates::Kind::world) {
    made.chosen_.assign(setup.starts.states().begin(), setup.starts.states().end());
  }
  if (world.mdp) {
    const StartStates own = StartStates::world(*world.mdp);
    for (const State s : own.states()) made.began_[s] = 1;
    made.starts_listed_ = true;
  }
  if (!made.certain_) made.due_ = std::max<std::uint64_t>(1000, 100 * made.begin_.back());
  ExperienceCertificate& first = made.certificate_;
  first.upper.assign(made.acted_.size(), made.values_.second);
  for (State s = 0; s < first.upper.size(); ++s) {
    if (made.begin_[s] == made.begin_[s + 1]) first.upper[s] = 0.0;
  }
  return made;
}

void Certifier::observe(std::span<const Update> updates) {
  for (const Update& step : updates) {
    const std::uint64_t pair = begin_[step.state] + step.action;
    if (begins_ && !starts_listed_) began_[step.state] = 1;
    begins_ = step.terminated || step.truncated;
    acted_[step.state] = 1;
    model_.observe(pair, step.terminated ? the_end : step.next, step.reward);
    square_sum_[pair] += step.reward * step.reward;
    ++steps_;
  }
}

// The states the goal is about: where episodes began, or all that can be acted in as far as known.
std::vector<State> Certifier::asked() const {
  if (goal_.everywhere && !chosen_.empty()) return chosen_;
  const std::vector<std::uint8_t>& member = goal_.everywhere ? acted_ : began_;
  std::vector<State> states;
  for (State s = 0; s < member.size(); ++s) {
    if (member[s] != 0) states.push_back(s);
  }
  return states;
}

bool Certifier::check() {
  ++certificate_.checks;
  certificate_.steps = steps_;
  if (certain_)
    check_certain();
  else
    check_noisy();
  if (certificate_.lower.empty()) return false;
  double start_gap = -1.0;
  for (State s = 0; s < began_.size(); ++s) {
    const double gap = certificate_.upper[s] - certificate_.lower[s];
    if (began_[s] == 0 || gap <= start_gap) continue;
    start_gap = gap;
    certificate_.start_lower = certificate_.lower[s];
    certificate_.start_upper = certificate_.upper[s];
  }
  certificate_.gap = 0.0;
  for (const State s : asked()) {
    const double gap = certificate_.upper[s] - certificate_.lower[s];
    if (!(gap > certificate_.gap)) continue;
    certificate_.gap = gap;
    certificate_.widest = s;
  }
  // Bounds of what is known exactly are as far apart as rounding leaves them.
  const double size = std::max(std::fabs(values_.second), std::fabs(certificate_.start_upper));
  certificate_.reached = certificate_.gap <= std::max(allowed(), 1e-12 * size);
  return certificate_.reached;
}

double Certifier::allowed() const {
  if (!goal_.relative) return goal_.gap;
  const double low = certificate_.start_lower, high = certificate_.start_upper;
  if ((low < 0.0) != (high < 0.0)) return 0.0;
  return goal_.gap * std::min(std::fabs(low), std::fabs(high));
}

// Without noise a pair is known after one step. Checks come with every fortieth part more steps.
void Certifier::check_certain() {
  due_ = steps_ + 1 + steps_ / 40;
  if (model_.outcomes() == outcomes_ && !certificate_.lower.empty()) return;
  outcomes_ = model_.outcomes();
  const Plan upper = plan(model_, begin_, hope_);
  const Plan lower = plan(model_, begin_, pessimism_);
  if (!upper.solved || !lower.solved) return;
  for (State s = 0; s < upper.upper.size(); ++s) {
    certificate_.upper[s] = std::min(certificate_.upper[s], upper.upper[s]);
  }
  certificate_.lower = lower.lower;
  certificate_.policy = lower.policy;
  if (std::isfinite(values_.first)) return;
  // At discount 1 the way out was an invention; nothing is known of what takes it.
  for (State s = 0; s < lower.lower.size(); ++s) {
    if (begin_[s] < begin_[s + 1] && lower.lower[s] <= pessimism_.stuck) {
      certificate_.lower[s] = -HUGE_VAL;
      certificate_.policy[s] = no_action;
    }
  }
}

// Checkpoint k may fail with probability delta 6 / (pi^2 k^2): all together with delta.
void Certifier::check_noisy() {
  due_ = steps_ + 1 + 3 * (steps_ / 10);
  const double k = static_cast<double>(certificate_.checks);
  constexpr double pi_square = 9.869604401089358;
  const double share = goal_.once ? 1.0 : 6.0 / (pi_square * k * k);
  const double failure = (1.0 - goal_.confidence) * share;
  for (std::uint64_t pair = 0; pair < begin_.back() && !noisy_rewards_; ++pair) {
    const double n = model_.tried(pair);
    double explained = 0.0;
    model_.each(pair, [&](const CountedModel::Outcome& seen) {
      explained += seen.reward_sum * seen.mean_reward();
    });
    noisy_rewards_ =
        square_sum_[pair] - explained > 1e-9 * std::max(1.0, square_sum_[pair]) && n > 0;
  }
  const IntervalModel intervals(model_, begin_, successors_, rewards_, discount_, failure,
                                noisy_rewards_, square_sum_);
  const double least = 1e-7 * (values_.second - values_.first) * (1.0 - discount_);
  intervals.lower_upper_bound(certificate_.upper, least);
  intervals.raise_lower_bound(certificate_.lower, certificate_.policy, values_.first, least);
}

std::vector<Blocking> Certifier::blocking(std::size_t count) const {
  std::vector<Blocking> pairs;
  const std::vector<double>&lower = certificate_.lower, &upper = certificate_.upper;
  if (lower.empty()) return pairs;
  const double allowed_gap = std::max(allowed(), 1e-300);
  for (State s = 0; s < acted_.size(); ++s) {
    if (acted_[s] == 0 || !(upper[s] - lower[s] > 0.0)) continue;
    // The action that could earn the most: one never tried, or the best backup of the upper bound.
    Blocking worst{s, 0, 0, upper[s] - lower[s], 0};
    double most = -HUGE_VAL;
    for (std::uint64_t pair = begin_[s]; pair < begin_[s + 1]; ++pair) {
      const double value = model_.tried(pair) == 0
                               ? values_.second
                               : model_.backup(pair, discount_, [&](State y) { return upper[y]; });
      if (value <= most) continue;
      most = value;
      worst.action = static_cast<Action>(pair - begin_[s]);
      worst.tried = model_.tried(pair);
    }
    const double ratio = certificate_.gap / allowed_gap;
    worst.needed = worst.tried == 0 || certain_
                       ? 1
                       : static_cast<std::uint64_t>(
                             std::min(1e18, worst.tried * std::max(0.0, ratio * ratio - 1.0)));
    if (certain_ && worst.tried > 0) continue;
    pairs.push_back(worst);
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Blocking& a, const Blocking& b) {
    return a.width > b.width || (a.width == b.width && a.tried < b.tried);
  });
  if (pairs.size() > count) pairs.resize(count);
  return pairs;
}

std::vector<std::string> Certifier::assumptions() const {
  const auto range = [](const std::pair<double, double>& r) {
    return "[" + shortest(r.first) + ", " + shortest(r.second) + "]";
  };
  std::vector<std::string> list;
  std::string rewards = "rewards lie in " + range({rewards_.low(), rewards_.high()});
  if (rewards_.running.first <= rewards_.running.second && rewards_.running != rewards_.last) {
    rewards += ", on the way in " + range(rewards_.running);
  }
  list.push_back(rewards);
  list.push_back(certain_ ? "the world is deterministic: a step repeated gives the same"
                          : "steps are independent draws that depend on state and action only");
  list.push_back("the states and the actions of each are known");
  if (!starts_listed_) list.push_back("episodes begin where they have begun so far");
  if (certain_) return list;
  list.push_back(goal_.listed ? "the successors of each action are known, not their probabilities"
                              : "any state may follow any action");
  list.push_back(noisy_rewards_ ? "rewards of the same step may differ"
                                : "a reward depends on state, action and successor only");
  return list;
}

void ExperienceCertificate::persist(Archive& archive) {
  archive("upper", upper);
  archive("lower", lower);
  archive("policy", policy);
  archive("gap", gap);
  archive("widest", widest);
  archive("start_lower", start_lower);
  archive("start_upper", start_upper);
  archive("steps", steps);
  archive("checks", checks);
  archive("reached", reached);
}

void Certifier::persist(Archive& archive) {
  model_.persist(archive, acted_.size());
  const std::size_t pairs = square_sum_.size(), states = acted_.size();
  archive("square_sum", square_sum_);
  archive("noisy_rewards", noisy_rewards_);
  archive("acted", acted_);
  archive("began", began_);
  archive("begins", begins_);
  archive("steps", steps_);
  archive("outcomes", outcomes_);
  archive("due", due_);
  archive("certificate", certificate_);
  const bool fits = square_sum_.size() == pairs && acted_.size() == states &&
                    began_.size() == states && certificate_.upper.size() == states &&
                    (certificate_.lower.empty() || certificate_.lower.size() == states) &&
                    certificate_.policy.size() == certificate_.lower.size() &&
                    certificate_.widest < states;
  if (fits) return;
  archive.fail("a certificate of another world");
  square_sum_.resize(pairs);
  acted_.resize(states);
  began_.resize(states);
  certificate_.upper.resize(states, values_.second);
  certificate_.lower.clear();
  certificate_.policy.clear();
  certificate_.widest = 0;
}

}  // namespace quoll
