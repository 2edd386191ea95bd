#pragma once
// The tabular loop, written once: a template over (update rule) x (source of experience) x (layout
// of the rows). Virtual per chunk, static per step. Every step takes two draws for the behaviour
// and one for the world, used or not, so that cuts, logs and watching for stability leave every bit
// as it is.

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "quoll/act/rows.hpp"
#include "quoll/learn/greedy_rows.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/learn/tabular/guard.hpp"
#include "quoll/learn/tabular/rule.hpp"
#include "quoll/learn/tabular/source.hpp"
#include "quoll/learn/tabular/stability.hpp"

namespace quoll {

template <UpdateRule Rule, class Source, template <class> class Rows>
class TabularLearner final : public Learner, public GreedyRows {
 public:
  using Value = typename Rule::Value;

  TabularLearner(const LearnSetup& setup, Rule rule, Source source, std::uint64_t states,
                 PairLayout layout, std::vector<std::uint64_t> begin)
      : begin_(std::move(begin)),
        rule_(std::move(rule)),
        source_(std::move(source)),
        exploration_(setup.exploration),
        starts_(setup.starts),
        step_size_(setup.step_size),
        discount_(setup.world->mdp ? setup.world->mdp->carry(setup.discount) : setup.discount),
        episode_steps_(setup.episode_steps),
        stability_(setup.stable, layout.pairs),
        guard_(setup.value_bound, setup.discount, setup.initial_value),
        mdp_(setup.world->mdp),
        visits_(layout.pairs) {
    if constexpr (std::is_same_v<Rows<Value>, RaggedRows<Value>>) rows_.begin = begin_.data();
    lay_out(static_cast<Value>(setup.initial_value), states, layout);
    if (stability_.watching() && stability_.counts_met()) met_.resize(states);
    walk_.behaviour = stream(setup.seed, "behaviour");
    walk_.dice = stream(setup.seed, "world");
    episodes_.start = stream(setup.seed, "start");
    walk_.state = begin_episode();
  }

  LearnProgress advance(std::uint64_t steps, std::span<Update> log) override {
    progress_.logged = 0;
    if (progress_.halt == LearnProgress::Halt::none) {
      if (!log.empty()) {
        run<Watch::log>(std::min<std::uint64_t>(steps, log.size()), log, exploration_, step_size_);
      } else if (stability_.watching()) {
        run<Watch::stability>(steps, log, exploration_, step_size_);
      } else if (padded_rows && exploration_.is_coin() && !step_size_.small()) {
        run_plain(steps);
      } else {
        run<Watch::nothing>(steps, log, exploration_, step_size_);
      }
    }
    return progress();
  }

  LearnProgress progress() const override {
    LearnProgress now = progress_;
    now.steps = walk_.step;
    now.episodes = episodes_.finished;
    now.return_sum = episodes_.return_sum;
    return now;
  }

  Estimates estimates() const override {
    Estimates out;
    out.single_precision = sizeof(Value) == 4;
    out.row_begin = begin_;
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

  std::optional<Action> greedy_action(State s) const override {
    return best_visited(
        static_cast<Action>(begin_[s + 1] - begin_[s]),
        [&](Action a) { return values_[rows_.pair(s, a)]; },
        [&](Action a) { return visits_[rows_.pair(s, a)]; });
  }

  void persist(Archive& archive) override {
    archive("walk", walk_);
    archive("episodes", episodes_);
    archive("halt", progress_.halt);
    Impossible& first = progress_.impossible;
    archive("impossible", first.found);
    archive("impossible_step", first.step);
    archive("impossible_state", first.state);
    archive("impossible_action", first.action);
    archive("impossible_value", first.value);
    archive("impossible_bound", first.bound);
    if (progress_.halt > LearnProgress::Halt::diverged) {
      progress_.halt = LearnProgress::Halt::none;
      archive.fail("an unknown halt");
    }
    const std::size_t pairs = values_.size(), states = met_.size();
    const std::vector<Value> fresh = archive.saving() ? std::vector<Value>() : values_;
    archive("values", values_);
    archive("visits", visits_);
    archive("met", met_);
    if (!archive.saving()) {
      if (values_.size() != pairs || visits_.size() != pairs || !possible(walk_.state) ||
          first.state >= begin_.size() - 1 || walk_.episode_step >= episode_steps_ ||
          !same_padding(fresh)) {
        archive.fail("the saved table does not fit this world");
        walk_.state = 0;
        first.state = 0;
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
  static constexpr bool padded_rows = std::is_same_v<Rows<Value>, FourRows<Value>>;
  enum class Watch : std::uint8_t { nothing, stability, log };

  // What every step changes besides the table: small, so that run() holds it in registers.
  struct Walk {
    Rng behaviour, dice;
    State state = 0;
    std::uint64_t step = 0, episode_step = 0;
    double episode_return = 0.0;

    void persist(Archive& archive) {
      archive("behaviour", behaviour);
      archive("dice", dice);
      archive("state", state);
      archive("step", step);
      archive("episode_step", episode_step);
      archive("episode_return", episode_return);
    }
  };

  // What the ends of episodes change.
  struct Episodes {
    Rng start;
    std::uint64_t finished = 0;
    double return_sum = 0.0;

    void persist(Archive& archive) {
      archive("start", start);
      archive("finished", finished);
      archive("return_sum", return_sum);
    }
  };

  // Rows of ends hold 0 and padding holds -infinity: the target's maximum needs no mask.
  void lay_out(Value initial, std::uint64_t states, PairLayout layout) {
    values_.assign(layout.pairs, initial);
    bool full = true;
    for (State s = 0; s < states; ++s) {
      const std::uint64_t legal = begin_[s + 1] - begin_[s];
      const bool end = legal == 0 || (mdp_ && mdp_->terminal(s));
      full = full && (end || legal == layout.width);
      const std::uint64_t width = layout.width == 0 ? legal : layout.width;
      for (std::uint64_t a = 0; a < width; ++a) {
        Value& value = values_[rows_.pair(s, static_cast<Action>(a))];
        if (end)
          value = 0;
        else if (a >= legal)
          value = -std::numeric_limits<Value>::infinity();
      }
    }
    if constexpr (padded_rows) rows_.full = full;
  }

  // A state that an episode can stand in.
  bool possible(State s) const {
    return s < begin_.size() - 1 && begin_[s] < begin_[s + 1] && !(mdp_ && mdp_->terminal(s));
  }

  // -infinity where, and only where, a fresh table has it.
  bool same_padding(const std::vector<Value>& fresh) const {
    constexpr Value padding = -std::numeric_limits<Value>::infinity();
    for (std::size_t i = 0; i < fresh.size() && i < values_.size(); ++i) {
      if ((fresh[i] == padding) != (values_[i] == padding)) return false;
    }
    return true;
  }

  /// Draws the state of the next episode.
  State begin_episode() {
    return source_.start(starts_, episodes_.start, [this](State s) {
      std::uint64_t sum = 0;
      const auto actions = static_cast<Action>(begin_[s + 1] - begin_[s]);
      for (Action a = 0; a < actions; ++a) sum += visits_[rows_.pair(s, a)];
      return sum;
    });
  }

  [[gnu::noinline]] State end_episode(double episode_return) {
    ++episodes_.finished;
    episodes_.return_sum += episode_return;
    return begin_episode();
  }

  // The fast lane: nothing to watch, a coin for the choice, one step size.
  void run_plain(std::uint64_t count) {
    if constexpr (padded_rows) {
      const bool always = exploration_.coin_threshold() > ~std::uint32_t{0};
      if (exploration_.first_tie) {
        always ? run_coin<true, true>(count) : run_coin<true, false>(count);
      } else {
        always ? run_coin<false, true>(count) : run_coin<false, false>(count);
      }
    }
  }

  template <bool first_tie, bool always>
  void run_coin(std::uint64_t count) {
    run<Watch::nothing>(count, {},
                        CoinExploration<first_tie, always>{exploration_.coin_threshold()},
                        ConstantStep{step_size_.value});
  }

  // Not inlined: each instance keeps the registers to itself.
  template <Watch watch, class Choice, class Step>
  [[gnu::noinline]] void run(std::uint64_t count, std::span<Update> log, const Choice exploration,
                             const Step step_size) {
    Walk walk = walk_;
    Value* const q = values_.data();
    std::uint32_t* const visits = visits_.data();
    const Rows<Value> rows = rows_;
    const double discount = discount_;
    const std::uint64_t episode_steps = episode_steps_;
    auto step_world = source_.stepper();
    std::uint64_t end = walk.step + std::min(count, ~std::uint64_t{0} - walk.step);
    RowView<Value> here = rows.view(q, walk.state);
    while (walk.step < end) {
      // 1. Choose an action a in s, see the reward r and the next state s'.
      const State state = walk.state;
      const ChoiceDraws draws = ChoiceDraws::of(walk.behaviour);
      const Chosen chosen = exploration.choose(rows, q, visits, state, here, draws, walk.step);
      const std::uint64_t pair = rows.pair(state, chosen.action);
      const auto landing = step_world(pair, state, chosen.action, walk.dice.next());
      ++walk.step;
      // 2. Count the visit, form the target from max_a' Q(s', a'), store the new value.
      const std::uint32_t n = visits[pair] + (visits[pair] != ~std::uint32_t{0});
      visits[pair] = n;
      const RowView<Value> there = rows.view(q, landing.next);
      const double best_next = landing.terminated ? 0.0 : double{there.best};
      const Value old = q[pair];
      const Revision<Value> revision =
          revise(rule_, step_size, pair, old, double{landing.reward}, carry(landing, discount),
                 best_next, n, draws.rounding());
      q[pair] = revision.value;
      rule_.learned(pair, double{revision.value});
      if (!guard_.fine(double{revision.value})) [[unlikely]] {
        look_closer(walk.step, state, chosen.action, double{revision.value});
        if (progress_.halt != LearnProgress::Halt::none) end = walk.step;
      }
      // 3. Go on from s', or begin the next episode.
      walk.episode_return += double{landing.reward};
      const bool truncated = ++walk.episode_step == episode_steps || cut(landing);
      if constexpr (watch != Watch::nothing) {
        watch_stability(pair, state, landing.terminated ? state : landing.next, here, old,
                        revision);
        if (progress_.halt != LearnProgress::Halt::none) end = walk.step;
      }
      if constexpr (watch == Watch::log) {
        log[progress_.logged++] =
            told(walk.step, state, chosen, landing, truncated, old, best_next, revision);
      }
      if (landing.terminated || truncated) [[unlikely]] {
        walk.state = end_episode(walk.episode_return);
        walk.episode_step = 0;
        walk.episode_return = 0.0;
        here = rows.view(q, walk.state);
      } else {
        here = landing.next == state ? rows.view(q, state) : there;
        walk.state = landing.next;
      }
    }
    walk_ = walk;
  }

  template <class Landing>
  static Update told(std::uint64_t step, State state, Chosen chosen, const Landing& landing,
                     bool truncated, Value old, double best_next, const Revision<Value>& revision) {
    return {step,
            0,
            state,
            chosen.action,
            revision.reward,
            landing.next,
            landing.terminated,
            truncated,
            chosen.explored,
            double{old},
            best_next,
            revision.target,
            revision.step_size,
            double{revision.value}};
  }

  // Tables of two players hold a negative discount; environments say whose turn comes.
  template <class Landing>
  static double carry(const Landing& landing, double discount) {
    if constexpr (requires { landing.turn_passes; }) {
      return landing.turn_passes ? -discount : discount;
    }
    return discount;
  }

  template <class Landing>
  static bool cut(const Landing& landing) {
    if constexpr (requires { landing.truncated; }) return landing.truncated;
    return false;
  }

  [[gnu::noinline, gnu::cold]] void look_closer(std::uint64_t step, State state, Action action,
                                                double value) {
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
        stability_.met(begin_[s + 1] - begin_[s]);
      }
    }
    const Value value = revision.value;
    bool changed = false;
    if (value != old) {
      const RowView<Value> after = rows_.view(values_.data(), state);
      const bool was_best = old == before.best, is_best = value == after.best;
      changed = was_best != is_best || (is_best && rows_.ties(before) != rows_.ties(after));
    }
    const double error =
        revision.step_size == 1.0 ? double{value} - double{old} : revision.target - double{old};
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
  double discount_;  // of what follows, negative in models where the turn passes
  std::uint64_t episode_steps_;
  Stability stability_;
  Guard guard_;
  std::shared_ptr<const Mdp> mdp_;
  std::vector<Value> values_;
  std::vector<std::uint32_t> visits_;
  std::vector<std::uint8_t> met_;
  Walk walk_;
  Episodes episodes_;
  LearnProgress progress_;
};

}  // namespace quoll
