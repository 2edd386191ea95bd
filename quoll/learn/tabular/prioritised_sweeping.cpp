// Prioritised sweeping. Moore, Atkeson 1993; Peng, Williams 1993; with small backups: van Seijen,
// Sutton 2013 ("Planning by prioritized sweeping with small backups").
//
//   full backups                                     small backups
//   1 see (s, a, r, s'); count it                    1 see (s, a, r, s'); count it;
//                                                      Q(s,a) <- Q(s,a) + (r + gamma U(s') -
//                                                      Q(s,a)) / N
//   2 backup(s,a):                                   2 moved(s)
//       Q(s,a) <- sum_y P(y|s,a) (r + gamma V(y))    3 n times: pop the y that moved most:
//       for each (x,u) that led to s:                    d <- V(y) - U(y); U(y) <- V(y)
//         p <- gamma P(s|x,u) |change of V(s)|           for each (x,u) that led to y:
//         push (x,u) if p > theta                          Q(x,u) <- Q(x,u) + gamma P(y|x,u) d
//   3 n times: pop the (x,u) of largest p; backup        moved(x)
//                                                    moved(s): push s if |V(s) - U(s)| > theta
//
// V(s) = max_b Q(s,b); U -> used_: the V that all pairs have taken in so far; n ->
// planning_backups; theta -> threshold_. Where values must fall, states of a loop hold each other
// up and every sweep only takes 1 - gamma off: after 4 K backups without an empty queue all values
// are planned anew by the solvers. Memory: 32 + 16 bytes for each (s, a, s') seen, and 12 an entry
// of the queue.

#include <cmath>

#include "quoll/learn/tabular/backup_queue.hpp"
#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/model_learning.hpp"
#include "quoll/learn/tabular/predecessors.hpp"
#include "quoll/learn/tabular/rules.hpp"

namespace quoll {
namespace {

class PrioritisedSweeping {
 public:
  using Value = double;
  static constexpr bool looks_ahead = false;

  PrioritisedSweeping(const LearnSetup& setup, const ValueTable<double>& table)
      : planning_(known_pairs_only(setup)),
        small_(setup.of_method.backups == Backups::small),
        backups_(setup.of_method.planning_backups),
        threshold_(setup.of_method.sweep_threshold *
                   (setup.rewards && setup.rewards->span() > 0.0 ? setup.rewards->span() : 1.0)),
        model_(table.pairs()),
        predecessors_(table.states()),
        queue_(small_ ? table.states() : table.pairs()),
        state_of_(small_ ? 0 : table.pairs()),
        used_(small_ ? table.states() : 0) {
    for (State s = 0; s < used_.size(); ++s) used_[s] = table.best(s);
    for (State s = 0; s < table.states() && !small_; ++s) {
      for (Action a = 0; a < table.actions(s); ++a) state_of_[table.pair(s, a)] = s;
    }
  }

  Change learn(const Step& step, ValueTable<double>& table, const ChoiceDraws&) {
    // 1
    const double best_next = table.best_after(step.carry, step.next);
    if (count(model_, step) && !step.terminated) {
      predecessors_.add(step.next, {step.pair, step.state, step.carry < 0.0});
    }
    // 2
    if (small_) {
      const double sample = step.reward + (step.carry == 0.0 ? 0.0 : step.carry * used_[step.next]);
      const double old = table[step.pair];
      table.set(step.state, step.pair, old + (sample - old) / model_.tried(step.pair));
      moved(step.state, table);
    } else {
      full_backup(step.state, step.pair, table);
    }
    const double target = table[step.pair];
    // 3
    sweep(table);
    return {best_next, target, 1.0};
  }
  void end_episode(ValueTable<double>&) {}

  void persist(Archive& archive) {
    model_.persist(archive, predecessors_.states());
    predecessors_.persist(archive, model_.pairs());
    queue_.persist(archive);
    archive("busy", busy_);
    const std::size_t states = used_.size();
    archive("used", used_);
    if (used_.size() == states) return;
    archive.fail("values of another world");
    used_.resize(states);
  }

 private:
  // 2, full backups
  void full_backup(State s, std::uint64_t pair, ValueTable<double>& table) {
    const double before = table.best(s);
    table.set(s, pair,
              model_.backup(pair, planning_.discount, [&](State y) { return table.best(y); }));
    const double change = std::fabs(table.best(s) - before);
    if (change == 0.0) return;
    predecessors_.each(s, [&](const Predecessors::Pair& to) {
      const double priority = planning_.discount * change * share(to.pair, s);
      if (priority > threshold_) queue_.push(static_cast<std::uint32_t>(to.pair), priority);
    });
  }

  // 3, small backups of all that led to y
  void small_backups(State y, ValueTable<double>& table) {
    const double change = table.best(y) - used_[y];
    used_[y] = table.best(y);
    predecessors_.each(y, [&](const Predecessors::Pair& to) {
      const double carry = to.turn_passes ? -planning_.discount : planning_.discount;
      table.set(to.state, to.pair, table[to.pair] + carry * share(to.pair, y) * change);
      moved(to.state, table);
    });
  }

  void moved(State s, const ValueTable<double>& table) {
    const double change = std::fabs(table.best(s) - used_[s]);
    if (change > threshold_) queue_.push(s, change);
  }

  // P(s | pair), as counted.
  double share(std::uint64_t pair, State s) const {
    std::uint32_t count = 0;
    model_.each(pair, [&](const CountedModel::Outcome& seen) {
      if (seen.next == s) count += seen.count;
    });
    return static_cast<double>(count) / model_.tried(pair);
  }

  void sweep(ValueTable<double>& table) {
    for (std::uint64_t i = 0; i < backups_; ++i) {
      std::uint32_t item = 0;
      if (!queue_.pop(item)) {
        busy_ = 0;
        return;
      }
      if (small_)
        small_backups(item, table);
      else
        full_backup(state_of_[item], item, table);
      if (++busy_ > 4 * table.pairs()) return plan_anew(table);
    }
  }

  void plan_anew(ValueTable<double>& table) {
    busy_ = 0;
    queue_.clear();
    store(plan(model_, table.begin(), planning_), table);
    for (State s = 0; s < used_.size(); ++s) used_[s] = table.best(s);
  }

  Planning planning_;
  bool small_;
  std::uint64_t backups_;
  double threshold_;
  CountedModel model_;
  Predecessors predecessors_;
  BackupQueue queue_;
  std::uint64_t busy_ = 0;       // backups since the queue was empty
  std::vector<State> state_of_;  // per pair, for full backups
  std::vector<double> used_;     // U, for small ones
};

std::unique_ptr<Learner> make(const LearnSetup& setup) {
  return std::make_unique<MethodLearner<PrioritisedSweeping>>(setup);
}

}  // namespace

const LearnerEntry prioritised_sweeping{
    .method = "prioritised-sweeping",
    .rule = "",
    .summary = "backs up the counted model where values changed most, and from there backwards",
    .sound = true,
    .make = make,
    .replay = nullptr,
    .traits = {.ignores = "step_size, precision"},
    .formula =
        "Q(s,a) := mean of r + discount * max Q(s',.) over the counts of (s, a), then the same "
        "for the n pairs whose followers changed most"};

}  // namespace quoll
