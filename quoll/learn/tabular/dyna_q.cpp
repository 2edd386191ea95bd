// Dyna-Q and Dyna-Q+. Sutton 1990 ("Integrated architectures for learning, planning, and reacting
// based on approximating dynamic programming"); Sutton, Barto 2018, section 8.2 and 8.3.
//
//   1   see (s, a, r, s'); Q(s,a) <- Q(s,a) + alpha (r + gamma max_b Q(s',b) - Q(s,a))
//   2   count (s, a, r, s') into the model; last(s,a) <- now
//   3   n times: draw (x,u) uniformly among the pairs tried
//         Q(x,u) <- sum_y P(y|x,u) (r(x,u,y) + gamma max_b Q(y,b))
//                   + kappa sqrt(now - last(x,u))                        only Dyna-Q+
//
// P, r -> CountedModel; n -> planning_backups. Backups are of means, not of samples, and need no
// alpha. The bonus is in the table of Dyna-Q+, and in what it shows. Memory: 32 bytes for each
// (s, a, s') seen, 24 a pair.

#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/model_learning.hpp"
#include "quoll/learn/tabular/rules.hpp"
#include "quoll/learn/tabular/towards.hpp"

namespace quoll {
namespace {

template <bool plus>
class DynaQ {
 public:
  using Value = double;
  static constexpr bool looks_ahead = false;

  DynaQ(const LearnSetup& setup, const ValueTable<double>& table)
      : step_size_(setup.step_size),
        discount_(setup.discount),
        kappa_(setup.of_method.kappa),
        backups_(setup.of_method.planning_backups),
        states_(table.states()),
        planning_(stream(setup.seed, "planning")),
        model_(table.pairs()),
        last_(plus ? table.pairs() : 0) {}

  Change learn(const Step& step, ValueTable<double>& table, const ChoiceDraws& draws) {
    // 1
    const double best_next = table.best_after(step.carry, step.next);
    const Change change = learn_from(step, best_next, table, step_size_, draws);
    // 2
    count(model_, step);
    if (model_.tried(step.pair) == 1) tried_.push_back({step.pair, step.state});
    if constexpr (plus) last_[step.pair] = step.number;
    // 3
    for (std::uint64_t i = 0; i < backups_; ++i) {
      const Tried drawn = tried_[planning_.below(static_cast<std::uint32_t>(tried_.size()))];
      double value = model_.backup(drawn.pair, discount_, [&](State y) { return table.best(y); });
      if constexpr (plus) {
        value += kappa_ * std::sqrt(static_cast<double>(step.number - last_[drawn.pair]));
      }
      table.set(drawn.state, drawn.pair, value);
    }
    return change;
  }
  void end_episode(ValueTable<double>&) {}

  void persist(Archive& archive) {
    archive("planning", planning_);
    archive("tried", tried_);
    model_.persist(archive, states_);
    const std::size_t pairs = last_.size();
    archive("last", last_);
    bool fits = last_.size() == pairs;
    for (const Tried& t : tried_) fits = fits && t.pair < model_.pairs() && t.state < states_;
    if (fits) return;
    archive.fail("a model of another world");
    tried_.clear();
    last_.resize(pairs);
  }

 private:
  struct Tried {
    std::uint64_t pair = 0;
    State state = 0;
    void persist(Archive& archive) {
      archive("pair", pair);
      archive("state", state);
    }
  };

  StepSize step_size_;
  double discount_, kappa_;
  std::uint64_t backups_, states_;
  Rng planning_;
  CountedModel model_;
  std::vector<Tried> tried_;         // in the order of first visits
  std::vector<std::uint64_t> last_;  // step of the last visit
};

template <bool plus>
std::unique_ptr<Learner> make(const LearnSetup& setup) {
  return std::make_unique<MethodLearner<DynaQ<plus>>>(setup);
}

}  // namespace

const LearnerEntry dyna_q{
    .method = "dyna-q",
    .rule = "",
    .summary = "Q-learning, and some backups of the counted model after each step",
    .sound = true,
    .make = make<false>,
    .replay = nullptr,
    .traits = {.ignores = "precision"},
    .formula =
        "Q(s,a) := Q(s,a) + step size * (r + discount * max Q(s',.) - Q(s,a)), then for n pairs "
        "tried before Q(x,u) := mean of r + discount * max Q(y,.) over their counts"};
const LearnerEntry dyna_q_plus{
    .method = "dyna-q-plus",
    .rule = "",
    .summary = "Dyna-Q with a bonus for what was not tried for long: for worlds that change",
    .sound = true,
    .make = make<true>,
    .replay = nullptr,
    .traits = {.off_policy = false, .ignores = "precision"},
    .formula =
        "Q(s,a) := Q(s,a) + step size * (r + discount * max Q(s',.) - Q(s,a)), then for n pairs "
        "tried before Q(x,u) := mean of r + discount * max Q(y,.) over their counts + kappa * "
        "sqrt(steps since x, u)"};

}  // namespace quoll
