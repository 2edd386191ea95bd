#pragma once
// The loop around a method with memory: one template over the method, any source of experience.
// Every step takes two draws for the behaviour and one for the world, as in engine.hpp.

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "quoll/act/reverse_starts.hpp"
#include "quoll/learn/greedy_rows.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/learn/tabular/any_source.hpp"
#include "quoll/learn/tabular/guard.hpp"
#include "quoll/learn/tabular/method.hpp"
#include "quoll/learn/tabular/stability.hpp"

namespace quoll {

template <Method M>
class MethodLearner final : public Learner, public GreedyRows {
 public:
  using Value = typename M::Value;
  using Table = ValueTable<Value>;

  explicit MethodLearner(const LearnSetup& setup)
      : table_(AnySource<Value>::rows_of(*setup.world), static_cast<Value>(setup.initial_value)),
        method_(setup, table_),
        source_(setup),
        exploration_(setup.exploration),
        starts_(setup.starts),
        episode_steps_(setup.episode_steps),
        stability_(setup.stable, table_.pairs()),
        mdp_(setup.world->mdp) {
    clear_ends();
    if (stability_.watching()) {
      using Watch = typename Table::Watch;
      table_.watch(setup.stable.tolerance == 0.0 ? Watch::values : Watch::greedy_sets);
      if (stability_.counts_met()) met_.resize(table_.states());
    }
    if (starts_.kind() == StartStates::Kind::reverse) {
      reverse_ = ReverseStarts(table_.states(), starts_.states());
    }
    walk_.behaviour = stream(setup.seed, "behaviour");
    walk_.dice = stream(setup.seed, "world");
    walk_.start = stream(setup.seed, "start");
    begin_episode();
  }

  LearnProgress advance(std::uint64_t steps, std::span<Update> log) override {
    progress_.logged = 0;
    if (!log.empty()) steps = std::min<std::uint64_t>(steps, log.size());
    for (; steps > 0 && progress_.halt == LearnProgress::Halt::none; --steps) {
      step(log.empty() ? nullptr : &log[progress_.logged++]);
    }
    return progress();
  }

  void log_experience_only() override { tells_changes_ = false; }

  LearnProgress progress() const override {
    LearnProgress now = progress_;
    now.steps = walk_.step;
    return now;
  }

  Estimates estimates() const override {
    Estimates out;
    out.single_precision = sizeof(Value) == 4;
    out.row_begin = table_.begin();
    out.visits.assign(table_.visits(), table_.visits() + table_.pairs());
    out.q.assign(table_.values(), table_.values() + table_.pairs());
    if constexpr (requires { method_.estimates(table_, out); }) method_.estimates(table_, out);
    return out;
  }

  std::optional<Action> greedy_action(State s) const override {
    if constexpr (requires(Estimates out) { method_.estimates(table_, out); }) {
      return std::nullopt;
    } else {
      return best_visited(
          table_.actions(s), [&](Action a) { return table_[table_.pair(s, a)]; },
          [&](Action a) { return table_.visits(table_.pair(s, a)); });
    }
  }

  void persist(Archive& archive) override {
    archive("walk", walk_);
    archive("halt", progress_.halt);
    archive("episodes", progress_.episodes);
    archive("return_sum", progress_.return_sum);
    archive("table", table_);
    const std::size_t states = met_.size();
    archive("met", met_);
    archive("starts", starts_);
    archive("reverse", reverse_);
    archive("source", source_);
    archive("method", method_);
    archive("stability", stability_);
    if (archive.saving()) return;
    if (progress_.halt > LearnProgress::Halt::diverged || !possible(walk_.state) ||
        (walk_.planned != no_action && walk_.planned >= table_.actions(walk_.state)) ||
        walk_.episode_step >= episode_steps_) {
      archive.fail("the saved run does not fit this world");
      progress_.halt = LearnProgress::Halt::diverged;
    }
    met_.resize(states);
    // A run that no longer watches for stability goes on from where it was found stable.
    if (!stability_.watching() && progress_.halt == LearnProgress::Halt::stable) {
      progress_.halt = LearnProgress::Halt::none;
    }
  }

 private:
  // Where the walk through the world stands.
  struct Walk {
    Rng behaviour, dice, start;
    State state = 0;
    Action planned = no_action;  // the action already chosen for `state`
    bool planned_explores = false;
    std::uint64_t step = 0, episode_step = 0;
    double episode_return = 0.0;

    void persist(Archive& archive) {
      archive("behaviour", behaviour);
      archive("dice", dice);
      archive("start", start);
      archive("state", state);
      archive("planned", planned);
      archive("planned_explores", planned_explores);
      archive("step", step);
      archive("episode_step", episode_step);
      archive("episode_return", episode_return);
    }
  };

  bool end_state(State s) const { return table_.actions(s) == 0 || (mdp_ && mdp_->terminal(s)); }
  bool possible(State s) const { return s < table_.states() && !end_state(s); }

  // Ends are worth nothing, so that no target needs a mask.
  void clear_ends() {
    for (State s = 0; s < table_.states(); ++s) {
      if (!end_state(s)) continue;
      for (Action a = 0; a < table_.actions(s); ++a) table_.set(s, table_.pair(s, a), 0);
    }
  }

  // One step, and in `told`, unless nobody looks, all about it.
  void step(Update* told) {
    // 1. Choose an action a in s, see the reward r and the next state s'.
    const ChoiceDraws draws = ChoiceDraws::of(walk_.behaviour);
    Chosen chosen{walk_.planned, walk_.planned_explores};
    if (chosen.action == no_action) chosen = choose(walk_.state, draws);
    walk_.planned = no_action;
    Step step;
    step.state = walk_.state;
    step.action = chosen.action;
    step.pair = table_.pair(step.state, step.action);
    const Landed landed = source_.step(step.pair, step.state, step.action, walk_.dice.next());
    step.reward = landed.reward;
    step.next = landed.next;
    step.carry = landed.carry;
    step.terminated = landed.terminated;
    step.truncated = ++walk_.episode_step == episode_steps_ || landed.truncated;
    step.number = ++walk_.step;
    step.watched = (told != nullptr && tells_changes_) || stability_.watching();
    // 2. Count the visit and learn from it.
    step.n = table_.visit(step.pair);
    if constexpr (M::looks_ahead) {
      if (!step.terminated) {
        const Chosen next = choose(step.next, draws);
        step.next_action = walk_.planned = next.action;
        walk_.planned_explores = next.explored;
      }
    }
    const double old = double{table_[step.pair]};
    const Change learned = method_.learn(step, table_, draws);
    if (reverse_.active()) reverse_.observe(step.state, step.next, step.reward, step.terminated);
    // 3. Go on from s', or begin the next episode.
    walk_.episode_return += step.reward;
    if (step.terminated || step.truncated) {
      method_.end_episode(table_);
      watch(step, old, learned);
      ++progress_.episodes;
      progress_.return_sum += walk_.episode_return;
      begin_episode();
    } else {
      watch(step, old, learned);
      walk_.state = step.next;
    }
    if (told != nullptr) {
      *told = {step.number,       0,
               step.state,        step.action,
               step.reward,       step.next,
               step.terminated,   step.truncated,
               chosen.explored,   old,
               learned.best_next, learned.target,
               learned.step_size, double{table_[step.pair]}};
    }
  }

  Chosen choose(State state, const ChoiceDraws& draws) {
    if constexpr (requires { method_.choose(table_, state, draws, walk_.step); }) {
      return method_.choose(table_, state, draws, walk_.step);
    } else if (exploration_.kind == Exploration::Kind::uniform) {  // asks for no values
      return {table_.rows().any({0, 0, table_.actions(state)}, draws.action()), true};
    } else {
      return exploration_.choose(table_.rows(), table_.values(), table_.visits(), state,
                                 table_.row(state), draws, walk_.step);
    }
  }

  void begin_episode() {
    walk_.episode_step = 0;
    walk_.episode_return = 0.0;
    walk_.planned = no_action;
    const bool pairs = starts_.kind() == StartStates::Kind::each_pair;
    const auto visits = [this, pairs](State s) {
      const std::uint32_t* const n = table_.visits() + table_.begin(s);
      return pairs ? std::uint64_t{*std::min_element(n, n + table_.actions(s))}
                   : std::accumulate(n, n + table_.actions(s), std::uint64_t{0});
    };
    if (reverse_.active()) starts_.choose_next(reverse_.draw(walk_.start, visits));
    if constexpr (requires { method_.start(walk_.start); }) {
      if (starts_.kind() == StartStates::Kind::widest_gap) {
        starts_.choose_next(method_.start(walk_.start));
      }
    }
    walk_.state = source_.start(starts_, walk_.start, visits);
    if (pairs) plan_least_tried();
    if constexpr (M::looks_ahead) {
      if (walk_.planned == no_action) {
        const Chosen first = choose(walk_.state, ChoiceDraws::of(walk_.start));
        walk_.planned = first.action;
        walk_.planned_explores = first.explored;
      }
    }
  }

  void plan_least_tried() {
    walk_.planned = 0;
    walk_.planned_explores = true;
    const std::uint32_t* const tried = table_.visits() + table_.begin(walk_.state);
    for (Action a = 1; a < table_.actions(walk_.state); ++a) {
      if (tried[a] < tried[walk_.planned]) walk_.planned = a;
    }
  }

  void watch(const Step& step, double old, const Change& learned) {
    const double value = double{table_[step.pair]};
    if (!(std::fabs(value) <= Guard::hopeless)) {
      progress_.halt = LearnProgress::Halt::diverged;
      progress_.impossible = {true, step.number, step.state, step.action, value, 0.0};
    }
    if (stability_.watching()) watch_stability(step, value, old, learned);
  }

  void watch_stability(const Step& step, double value, double old, const Change& learned) {
    if (stability_.counts_met()) {
      for (const State s : {step.state, step.terminated ? step.state : step.next}) {
        if (std::exchange(met_[s], std::uint8_t{1})) continue;
        stability_.met(table_.actions(s));
      }
    }
    // Of a whole step: by how much it moved the value, or how far from its target it left it.
    const double short_of = double{static_cast<Value>(learned.target)} - value;
    const double error = learned.step_size != 1.0 ? learned.target - old
                         : value == old           ? short_of
                                                  : value - old;
    const double scale = std::max(1.0, std::fabs(value));
    if (stability_.visited(step.pair, error, scale, table_.take_moved()) &&
        progress_.halt == LearnProgress::Halt::none) {
      progress_.halt = LearnProgress::Halt::stable;
    }
  }

  Table table_;
  M method_;
  AnySource<Value> source_;
  Exploration exploration_;
  StartStates starts_;
  ReverseStarts reverse_;
  std::uint64_t episode_steps_;
  bool tells_changes_ = true;
  Stability stability_;
  std::shared_ptr<const Mdp> mdp_;
  std::vector<std::uint8_t> met_;
  Walk walk_;
  LearnProgress progress_;
};

/// The learner of a method that exists for both precisions.
template <template <class> class M>
std::unique_ptr<Learner> method_learner(const LearnSetup& setup) {
  if (setup.precision == Precision::twofold) {
    return std::make_unique<MethodLearner<M<double>>>(setup);
  }
  return std::make_unique<MethodLearner<M<float>>>(setup);
}

}  // namespace quoll
