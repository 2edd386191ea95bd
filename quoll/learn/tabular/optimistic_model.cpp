// Optimistic model learning with two value tables. R-max: Brafman, Tennenholtz 2002; MBIE-EB:
// Strehl, Littman 2008; the lower table as in Dann et al. 2019 ("Policy certificates").
//
//   upper  U(s,a) = Qmax if N(s,a) < m, else min(Qmax, r + b(s,a) + gamma sum P max_b U(s',b))
//   lower  L(s,a) = Qmin where nothing was tried, else the optimum of the counted model
//   1   act greedily on U, ties at random; of things never tried, what was done last if it led on,
//       else what was done least, in any state
//   2   see (s, a, r, s'); count it
//   3   plan U anew when N(s,a) reached m, and when it is half as much again as then
//   4   the answer: the greedy policy of L
//
// Without noise m = 1 and b = 0, and planning is a search from the present state for the nearest
// thing not known (way_to_unknown.hpp), only when there is nothing new to try where it stands.
// Under noise b is the empirical Bernstein bonus (optimistic_values.hpp). Qmax, Qmin:
// value_range(). To go on as before covers ground that single random choices do not (Dabney,
// Ostrovski, Barreto 2021). The bonus is a heuristic: U is no proof. Memory: 32 bytes for each (s,
// a, s') seen, 16 a pair.

#include <algorithm>
#include <cmath>

#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/model_learning.hpp"
#include "quoll/learn/tabular/optimistic_values.hpp"
#include "quoll/learn/tabular/rules.hpp"
#include "quoll/learn/tabular/way_to_unknown.hpp"

namespace quoll {
namespace {

class OptimisticModel {
 public:
  using Value = double;
  static constexpr bool looks_ahead = false;

  OptimisticModel(const LearnSetup& setup, const ValueTable<double>& table)
      : certain_(setup.world->traits.deterministic),
        first_tie_(setup.exploration.first_tie),
        begin_(table.begin()),
        starts_(setup.starts.states().begin(), setup.starts.states().end()),
        pessimism_(known_pairs_only(setup)),
        hope_(unknown_pairs_best(setup)),
        optimism_(optimism_of(setup)),
        model_(table.pairs()),
        search_(table.states()),
        done_(most_actions(table), 0),
        replan_at_(table.pairs(), optimism_.known_after),
        value_(table.states(), optimism_.most),
        pair_value_(table.pairs(), optimism_.most) {}

  // 1
  Chosen choose(const ValueTable<double>& table, State s, const ChoiceDraws& draws, std::uint64_t) {
    if (!certain_) {
      if (stale_) improve_optimistic_values(model_, begin_, optimism_, value_, pair_value_);
      stale_ = false;
      return {greedy(s, first_tie_ ? 0 : draws.tie()), false};
    }
    const Action untried = any_untried(table, s, first_tie_ ? 0 : draws.tie());
    if (untried != no_action) return {untried, false};
    if (taken_ == way_.size() || way_[taken_] < begin_[s] || way_[taken_] >= begin_[s + 1]) {
      way_ = search_.find(model_, begin_, s, optimism_.most, optimism_.discount);
      taken_ = 0;
    }
    if (way_.empty()) {
      // All that can be reached is known, and no end is among it.
      if (stale_) pair_value_ = plan(model_, begin_, hope_).pair_value;
      stale_ = false;
      return {greedy(s, first_tie_ ? 0 : draws.tie()), false};
    }
    return {static_cast<Action>(way_[taken_++] - begin_[s]), false};
  }

  Change learn(const Step& step, ValueTable<double>& table, const ChoiceDraws&) {
    // 2
    known_ += 1;
    count(model_, step);
    const auto action = static_cast<Action>(step.pair - begin_[step.state]);
    if (step.next != step.state) last_ = action;
    ++done_[action];
    // 3
    const std::uint32_t n = model_.tried(step.pair);
    if (n >= replan_at_[step.pair]) {
      replan_at_[step.pair] = n + std::max(n / 2, 1u);
      stale_ = true;
    }
    // What is told: how far the one step is from what the table holds, which is not in use.
    const double best_next = table.best_after(step.carry, step.next);
    const double target =
        model_.backup(step.pair, optimism_.discount, [&](State y) { return table.best(y); });
    table.set(step.state, step.pair, target);
    return {best_next, target, 1.0};
  }

  void end_episode(ValueTable<double>&) {
    way_.clear();
    taken_ = 0;
  }

  /// The start with the largest U - L; one in ten at random. Both tables are planned when a tenth
  /// more is known. One draw.
  State start(Rng& rng) {
    const std::uint64_t bits = rng.next();
    if (known_ >= next_gaps_) {
      next_gaps_ = known_ + known_ / 10 + 1;
      widest_ = find_widest();
    }
    if ((bits >> 32) >= (std::uint64_t{1} << 32) / 10) return widest_;
    return starts_[scale(static_cast<std::uint32_t>(bits),
                         static_cast<std::uint32_t>(starts_.size()))];
  }

  // 4
  void estimates(const ValueTable<double>& table, Estimates& out) const {
    tell(plan(model_, table.begin(), pessimism_), out);
  }

  void persist(Archive& archive) {
    model_.persist(archive, begin_.size() - 1);
    const std::size_t states = value_.size(), pairs = pair_value_.size(), actions = done_.size();
    archive("stale", stale_);
    archive("replan_at", replan_at_);
    archive("value", value_);
    archive("pair_value", pair_value_);
    archive("way", way_);
    archive("taken", taken_);
    archive("last", last_);
    archive("done", done_);
    archive("known", known_);
    archive("next_gaps", next_gaps_);
    archive("widest", widest_);
    bool fits = widest_ < states && value_.size() == states && pair_value_.size() == pairs &&
                replan_at_.size() == pairs && taken_ <= way_.size() && done_.size() == actions;
    if (fits) return;
    archive.fail("values of another world");
    value_.resize(states);
    pair_value_.resize(pairs);
    replan_at_.resize(pairs);
    done_.resize(actions);
    way_.clear();
    taken_ = 0;
    widest_ = starts_.front();
  }

 private:
  static std::size_t most_actions(const ValueTable<double>& table) {
    Action most = 0;
    for (State s = 0; s < table.states(); ++s) most = std::max(most, table.actions(s));
    return most;
  }

  static Optimism optimism_of(const LearnSetup& setup) {
    Optimism optimism;
    const MethodSettings& given = setup.of_method;
    const double horizon = setup.discount < 1.0 ? 1.0 / (1.0 - setup.discount) : 1000.0;
    const double range = setup.rewards->high() - std::min(setup.rewards->low(), 0.0);
    optimism.discount = setup.discount;
    optimism.most = value_range(*setup.rewards, setup.discount).second;
    optimism.variance = given.bonus_variance;
    optimism.range_roots = given.bonus_range * range * std::sqrt(horizon);
    optimism.known_after =
        static_cast<std::uint32_t>(std::max<std::uint64_t>(given.known_after, 1));
    optimism.precision = 1e-3 * range;
    return optimism;
  }

  State find_widest() {
    if (certain_) {
      value_ = plan(model_, begin_, hope_).state_value;
    } else {
      improve_optimistic_values(model_, begin_, optimism_, value_, pair_value_);
    }
    const std::vector<double> lower = plan(model_, begin_, pessimism_).state_value;
    const auto gap = [&](State s) { return value_[s] - lower[s]; };
    State widest = starts_.front();
    for (const State s : starts_) {
      if (gap(s) > gap(widest)) widest = s;
    }
    return widest;
  }

  Action greedy(State s, std::uint32_t tie) const {
    const RaggedRows<double> rows{begin_.data()};
    const RowView<double> row = rows.view(pair_value_.data(), s);
    return rows.pick(pair_value_.data(), s, row, tie);
  }

  // What was done last, if it led on, else one of those done least so far, anywhere.
  Action any_untried(const ValueTable<double>& table, State s, std::uint32_t tie) const {
    const auto untried = [&](Action a) { return model_.tried(begin_[s] + a) == 0; };
    const auto times = [&](Action a) { return first_tie_ ? 0 : done_[a]; };
    const Action actions = table.actions(s);
    if (!first_tie_ && last_ < actions && untried(last_)) return last_;
    std::uint64_t least = ~std::uint64_t{0};
    std::uint32_t ties = 0;
    for (Action a = 0; a < actions; ++a) {
      if (!untried(a) || times(a) > least) continue;
      ties = times(a) < least ? 1 : ties + 1;
      least = times(a);
    }
    if (ties == 0) return no_action;
    std::uint32_t left = scale(tie, ties);
    for (Action a = 0; a < actions; ++a) {
      if (untried(a) && times(a) == least && left-- == 0) return a;
    }
    return no_action;
  }

  bool certain_, first_tie_;
  const std::vector<std::uint64_t>& begin_;
  std::vector<State> starts_;
  Planning pessimism_, hope_;  // L, and U without noise
  Optimism optimism_;
  CountedModel model_;
  WayToUnknown search_;
  std::vector<std::uint64_t> done_;         // per action: how often, in any state
  std::vector<std::uint32_t> replan_at_;    // visits of each pair
  std::vector<double> value_, pair_value_;  // U
  std::vector<std::uint64_t> way_;          // pairs still to take, without noise
  std::uint64_t taken_ = 0;
  Action last_ = no_action;  // that led on
  bool stale_ = false;       // U is not up to date
  std::uint64_t known_ = 0, next_gaps_ = 0;
  State widest_ = 0;
};

std::unique_ptr<Learner> make(const LearnSetup& setup) {
  return std::make_unique<MethodLearner<OptimisticModel>>(setup);
}

}  // namespace

const LearnerEntry optimistic_model{
    .method = "optimistic-model",
    .rule = "",
    .summary =
        "goes where the counted model leaves most to hope for: R-max without noise, bonuses "
        "under noise",
    .sound = true,
    .make = make,
    .replay = nullptr,
    .traits = {.plans = true,
               .has_bounds = true,
               .directed = true,
               .ignores = "step_size, precision, explore"},
    .check = needs_value_range,
    .formula =
        "U(s,a) := the most that is possible if N(s,a) < m, else mean of r + discount * max "
        "U(s',.) over the counts + bonus; Q := the same without hope and bonus"};

}  // namespace quoll
