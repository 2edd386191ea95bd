#pragma once
// The tabular loop, written once: a template over (update rule) x (source of experience) x (layout of
// the rows). Virtual per chunk, static per step. Every step takes two draws for the behaviour and one
// for the world, used or not, so that cuts, logs and watching for stability leave every bit as it is.

#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "quoll/act/rows.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/learn/tabular/guard.hpp"
#include "quoll/learn/tabular/rule.hpp"
#include "quoll/learn/tabular/source.hpp"
#include "quoll/learn/tabular/stability.hpp"

namespace quoll {

template <UpdateRule Rule, class Source, template <class> class Rows>
class TabularLearner final : public Learner {
 public:
  using Value = typename Rule::Value;

  TabularLearner(const TabularSetup& setup, Rule rule, Source source, std::uint64_t states,
                 PairLayout layout, std::vector<std::uint64_t> begin)
      : begin_(std::move(begin)),
        rule_(std::move(rule)),
        source_(std::move(source)),
        exploration_(setup.exploration),
        starts_(setup.starts),
        step_size_(setup.step_size),
        discount_(setup.discount),
        episode_steps_(setup.episode_steps),
        stability_(setup.stable, layout.pairs),
        guard_(setup.value_bound, setup.discount, setup.initial_value),
        mdp_(setup.world->mdp),
        visits_(layout.pairs) {
    if constexpr (std::is_same_v<Rows<Value>, RaggedRows<Value>>) rows_.begin = begin_.data();
    lay_out(static_cast<Value>(setup.initial_value), states, layout);
    if (stability_.watching() && stability_.counts_met()) met_.resize(states);
    cursor_.behaviour = stream(setup.seed, "behaviour");
    cursor_.world = stream(setup.seed, "world");
    cursor_.start = stream(setup.seed, "start");
    begin_episode(cursor_);
  }

  LearnProgress advance(std::uint64_t steps, std::span<Update> log) override {
    progress_.logged = 0;
    if (progress_.halt == LearnProgress::Halt::none) {
      if (!log.empty()) {
        run<Watch::log>(std::min<std::uint64_t>(steps, log.size()), log);
      } else if (stability_.watching()) {
        run<Watch::stability>(steps, log);
      } else {
        run<Watch::nothing>(steps, log);
      }
    }
    return progress();
  }

  LearnProgress progress() const override {
    LearnProgress now = progress_;
    now.steps = cursor_.step;
    now.episodes = cursor_.episodes;
    now.return_sum = cursor_.return_sum;
    return now;
  }

  Estimates estimates() const override {
    Estimates out;
    out.single_precision = sizeof(Value) == 4;
    const std::uint64_t states = begin_.size() - 1;
    for (State s = 0; s < states; ++s) {
      for (Action a = 0; a < begin_[s + 1] - begin_[s]; ++a) {
        const std::uint64_t pair = rows_.pair(s, a);
        out.q.push_back(double{values_[pair]});
        out.visits.push_back(visits_[pair]);
        if constexpr (requires { rule_.reward_estimate(pair); }) {
          out.reward_estimate.push_back(rule_.reward_estimate(pair));
        }
      }
    }
    return out;
  }

  void persist(Archive& archive) override {
    archive("cursor", cursor_);
    archive("halt", progress_.halt);
    Impossible& first = progress_.impossible;
    archive("impossible", first.found);
    archive("impossible_step", first.step);
    archive("impossible_state", first.state);
    archive("impossible_action", first.action);
    archive("impossible_value", first.value);
    archive("impossible_bound", first.bound);
    const std::size_t pairs = values_.size(), states = met_.size();
    archive("values", values_);
    archive("visits", visits_);
    archive("met", met_);
    if (!archive.saving()) {
      if (values_.size() != pairs || visits_.size() != pairs ||
          cursor_.state >= begin_.size() - 1) {
        archive.fail("the saved table does not fit this world");
      }
      values_.resize(pairs);
      visits_.resize(pairs);
      met_.resize(states);
      // A run that no longer watches for stability goes on from where it was found stable.
      if (!stability_.watching() && progress_.halt == LearnProgress::Halt::stable) {
        progress_.halt = LearnProgress::Halt::none;
      }
    }
    archive("starts", starts_);
    archive("rule", rule_);
    archive("source", source_);
    archive("stability", stability_);
    archive("guard", guard_);
  }

 private:
  enum class Watch : std::uint8_t { nothing, stability, log };

  // What a step changes besides the table: held in registers inside run().
  struct Cursor {
    Rng behaviour, world, start;
    State state = 0;
    std::uint64_t step = 0, episodes = 0, episode_step = 0;
    double episode_return = 0.0, return_sum = 0.0;

    void persist(Archive& archive) {
      archive("behaviour", behaviour);
      archive("world", world);
      archive("start", start);
      archive("state", state);
      archive("step", step);
      archive("episodes", episodes);
      archive("episode_step", episode_step);
      archive("episode_return", episode_return);
      archive("return_sum", return_sum);
    }
  };

  // Rows of ends hold 0 and padding holds -infinity: the target's maximum needs no mask.
  void lay_out(Value initial, std::uint64_t states, PairLayout layout) {
    values_.assign(layout.pairs, initial);
    for (State s = 0; s < states; ++s) {
      const std::uint64_t legal = begin_[s + 1] - begin_[s];
      const bool end = legal == 0 || (mdp_ && mdp_->terminal(s));
      const std::uint64_t width = layout.width == 0 ? legal : layout.width;
      for (std::uint64_t a = 0; a < width; ++a) {
        Value& value = values_[rows_.pair(s, static_cast<Action>(a))];
        if (end) value = 0;
        else if (a >= legal) value = -std::numeric_limits<Value>::infinity();
      }
    }
  }

  void begin_episode(Cursor& cursor) {
    cursor.episode_step = 0;
    cursor.episode_return = 0.0;
    cursor.state = source_.start(starts_, cursor.start, [this](State s) {
      std::uint64_t sum = 0;
      const auto actions = static_cast<Action>(begin_[s + 1] - begin_[s]);
      for (Action a = 0; a < actions; ++a) sum += visits_[rows_.pair(s, a)];
      return sum;
    });
  }

  template <Watch watch>
  void run(std::uint64_t count, std::span<Update> log) {
    Cursor cursor = cursor_;
    Value* const q = values_.data();
    std::uint32_t* const visits = visits_.data();
    const Rows<Value> rows = rows_;
    const std::uint64_t end = cursor.step + count;
    RowView<Value> here = rows.view(q, cursor.state);
    while (cursor.step < end) {
      // 1. Choose an action a in s, see the reward r and the next state s'.
      const ChoiceDraws draws = ChoiceDraws::of(cursor.behaviour);
      const State state = cursor.state;
      const Chosen chosen =
          exploration_.choose(rows, q, visits, state, here, draws, cursor.step);
      const std::uint64_t pair = rows.pair(state, chosen.action);
      const auto landing = source_.step(pair, state, chosen.action, cursor.world.next());
      ++cursor.step;
      // 2. Count the visit, form the target from max_a' Q(s', a'), store the new value.
      const std::uint32_t n = visits[pair] + (visits[pair] != ~std::uint32_t{0});
      visits[pair] = n;
      const RowView<Value> there = rows.view(q, landing.next);
      const double best_next = landing.terminated ? 0.0 : double{there.best};
      const Value old = q[pair];
      const Revision<Value> revision =
          revise(rule_, step_size_, pair, old, double{landing.reward}, discount_, best_next, n,
                 draws.rounding());
      q[pair] = revision.value;
      rule_.learned(pair, double{revision.value});
      if (!guard_.fine(double{revision.value})) [[unlikely]] {
        look_closer(cursor.step, state, chosen.action, double{revision.value});
      }
      // 3. Go on from s', or begin the next episode.
      cursor.episode_return += double{landing.reward};
      const bool truncated = ++cursor.episode_step == episode_steps_ || cut(landing);
      if constexpr (watch != Watch::nothing) {
        watch_stability(pair, state, landing.next, here, old, revision);
      }
      if constexpr (watch == Watch::log) {
        log[progress_.logged++] = {cursor.step, 0, state, chosen.action,
                                   revision.reward, landing.next, landing.terminated, truncated,
                                   chosen.explored, double{old}, best_next, revision.target,
                                   revision.step_size, double{revision.value}};
      }
      if (landing.terminated || truncated) {
        ++cursor.episodes;
        cursor.return_sum += cursor.episode_return;
        begin_episode(cursor);
        here = rows.view(q, cursor.state);
      } else {
        cursor.state = landing.next;
        here = landing.next == state ? rows.view(q, state) : there;
      }
      if (progress_.halt != LearnProgress::Halt::none) [[unlikely]] break;
    }
    cursor_ = cursor;
  }

  template <class Landing>
  static bool cut(const Landing& landing) {
    if constexpr (requires { landing.truncated; }) return landing.truncated;
    return false;
  }

  void look_closer(std::uint64_t step, State state, Action action, double value) {
    const Impossible here{false, step, state, action, value, 0.0};
    if (guard_.halts(value, source_.largest_reward(), here, progress_.impossible)) {
      progress_.halt = LearnProgress::Halt::diverged;
    }
  }

  void watch_stability(std::uint64_t pair, State state, State next, const RowView<Value>& before,
                       Value old, const Revision<Value>& revision) {
    if (!stability_.watching()) return;
    if (stability_.counts_met()) {
      for (const State s : {state, next}) {
        if (std::exchange(met_[s], std::uint8_t{1})) continue;
        stability_.met(mdp_ && mdp_->terminal(s) ? 0 : begin_[s + 1] - begin_[s]);
      }
    }
    const Value value = revision.value;
    bool changed = false;
    if (value != old) {
      const RowView<Value> after = rows_.view(values_.data(), state);
      const bool was_best = old == before.best, is_best = value == after.best;
      changed = was_best != is_best || (is_best && rows_.count(before) != rows_.count(after));
    }
    const double error = revision.step_size == 1.0 ? double{value} - double{old}
                                                   : revision.target - double{old};
    const double scale = std::max(1.0, std::fabs(double{value}));
    if (stability_.visited(pair, error, scale, changed) &&
        progress_.halt == LearnProgress::Halt::none) {
      progress_.halt = LearnProgress::Halt::stable;
    }
  }

  std::vector<std::uint64_t> begin_;  // first choice of each state, and the end
  Rows<Value> rows_{};
  Rule rule_;
  Source source_;
  Exploration exploration_;
  StartStates starts_;
  StepSize step_size_;
  double discount_;
  std::uint64_t episode_steps_;
  Stability stability_;
  Guard guard_;
  std::shared_ptr<const Mdp> mdp_;
  std::vector<Value> values_;
  std::vector<std::uint32_t> visits_;
  std::vector<std::uint8_t> met_;
  Cursor cursor_;
  LearnProgress progress_;
};

/// The learner of a rule for the source and the layout that the world has.
template <class Rule>
std::unique_ptr<Learner> tabular(const TabularSetup& setup) {
  using Value = typename Rule::Value;
  using Chance = TableSource<StochasticTable<Value>>;
  using Fixed = TableSource<DeterministicTable<Value>>;
  const World& world = *setup.world;
  if (!world.mdp) {
    std::unique_ptr<Environment> environment = world.make(1, setup.seed);
    const Spaces spaces = environment->spaces();
    const PairLayout layout{0, std::uint64_t{spaces.states} * spaces.actions};
    std::vector<std::uint64_t> begin(std::size_t{spaces.states} + 1);
    for (std::size_t s = 0; s < begin.size(); ++s) begin[s] = s * spaces.actions;
    Rule rule(setup, layout, begin);
    return std::make_unique<TabularLearner<Rule, EnvironmentSource, RaggedRows>>(
        setup, std::move(rule), EnvironmentSource(std::move(environment)), spaces.states, layout,
        std::move(begin));
  }
  const Mdp& mdp = *world.mdp;
  const PairLayout layout = pair_layout(mdp);
  std::vector<std::uint64_t> begin = mdp.arrays().choice_begin;
  Rule rule(setup, layout, begin);
  const auto make = [&]<class Source, template <class> class Rows>(Source source) {
    return std::make_unique<TabularLearner<Rule, Source, Rows>>(
        setup, std::move(rule), std::move(source), mdp.states(), layout, std::move(begin));
  };
  if (mdp.deterministic()) {
    Fixed source{deterministic_table<Value>(mdp, layout)};
    if (layout.width == 4) return make.template operator()<Fixed, FourRows>(std::move(source));
    return make.template operator()<Fixed, RaggedRows>(std::move(source));
  }
  Chance source{stochastic_table<Value>(mdp, layout)};
  if (layout.width == 4) return make.template operator()<Chance, FourRows>(std::move(source));
  return make.template operator()<Chance, RaggedRows>(std::move(source));
}

}  // namespace quoll
