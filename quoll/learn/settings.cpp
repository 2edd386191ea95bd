#include "quoll/learn/settings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quoll/base/text.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/learn/readers.hpp"
#include "quoll/model/graph.hpp"

namespace quoll {

void MethodSettings::describe(Describer& d) {
  Describer::Part prioritised_sweeping = d.of("prioritised-sweeping");
  Describer::Part optimistic = d.of("optimistic-model");
  d.of("q-lambda, linear-q, stream-q")("trace_decay", trace_decay, 0, 1,
                                       "lambda, how far an error travels back");
  d.of("n-step, tree-backup")("return_steps", return_steps, "rewards in a return before the table");
  d.of("dyna-q, dyna-q-plus, prioritised-sweeping")("planning_backups", planning_backups,
                                                    "backups of the model per step");
  prioritised_sweeping("sweep_threshold", sweep_threshold, 0, 1e300,
                       "smallest change that travels on, times the range of rewards");
  prioritised_sweeping.choice("backups", backups, backups_names,
                              "whole pairs, or one successor at a time");
  d.of("dyna-q-plus")("kappa", kappa, 0, 1e300, "bonus per root of the steps since the last visit");
  d.of("ucb-q")("ucb_bonus", ucb_bonus, 0, 1e300, "bonus times range * sqrt(H / n)");
  optimistic("known_after", known_after, "visits after which a pair counts as known");
  optimistic("bonus_variance", bonus_variance, 0, 1e300,
             "B of the bonus sqrt(B * variance / n) + C * range * sqrt(H) / n");
  optimistic("bonus_range", bonus_range, 0, 1e300, "C of that bonus");
}

void LinearSettings::describe(Describer& d) {
  Describer::Part linear = d.of("linear-q");
  linear("tilings", tilings, 1, 1024, "grids over the observed numbers, each shifted a little");
  linear("tiles", tiles,
         "tiles of a grid in the range of each observed number, such as 8, or 8,8,4,4");
  linear("tile_step_size", tile_step_size, 0, 2, "step size, of all tilings together");
  linear("keep_traces", keep_traces, "keep traces where an action was not greedy, unlike Watkins");
}

void LearnSettings::describe(Describer& d) {
  Describer::Part tables = d.of("tables");
  d("method", method,
    "how to learn; see 'quoll list methods'; auto, or no setting of learning at all: by the world");
  d("rule", rule, "update rule: standard, as-printed (the lecture's text) or reward-estimate");
  d("discount", discount, 0, 1, "discount factor of the future; 0 = the world's own");
  d("seed", seed, "which random numbers; the same seed gives the same bits");
  d("explore", explore,
    "how actions are chosen; see 'quoll list explorations'; auto = uniform for tables, "
    "epsilon-greedy for methods that know no table, greedy with --noisy");
  d.of("epsilon-greedy")(
      "epsilon", epsilon,
      "share of random actions, or FROM:TO:STEPS; auto = 0.1, or as the method's "
      "networks need");
  d.of("softmax")("temperature", temperature,
                  "in units of value, in % of the span of rewards, or FROM:TO:STEPS of either");
  d.of("ucb")("ucb_constant", ucb_constant, 0, 1e6,
              "weight of the bonus, times the span of rewards");
  d.of("count-bonus")("count_bonus", count_bonus, 0, 1e6,
                      "weight of the bonus, times the span of rewards");
  d.of("mellowmax")("omega", omega, 1e-6, 1e6,
                    "how far towards the largest Q, per span of rewards");
  d("start", start, "how start states are chosen; see 'quoll list starts'");
  tables("step_size", step_size, "auto, a number in (0, 1], 1/N^w or rescaled-linear");
  tables("initial_value", initial_value, "value of pairs not visited yet: a number, or optimistic");
  d.of("as-printed, reward-estimate")("initial_rewards", initial_rewards,
                                      "rE before the first visit: world, zero or FILE.csv");
  d.choice("ties", ties, ties_names, "which of equally good actions is taken while learning");
  tables("tolerance", tolerance, -1, 1e300,
         "how far a stable Q still moves, relative to max(1, |Q|); -1 = 0 where that proves, else "
         "0.001");
  d("episode_steps", episode_steps,
    "steps after which an episode is cut off; 0 = the world's limit, or as 'list starts' says");
  tables.choice("precision", precision, precision_names, "numbers of the table");
  tables("reward_range", reward_range,
         "smallest and largest reward of a step, LOW,HIGH; empty = as the world declares");
  of_method.describe(d);
  linear.describe(d);
  deep.describe(d);
}

void LearnSettings::persist(Archive& archive) {
  Describer list;
  describe(list);
  for (const Setting& setting : list.settings()) {
    std::visit(
        [&](auto field) {
          if constexpr (std::is_same_v<decltype(field), Choice>) {
            archive(setting.name, *field.value);
            if (*field.value >= field.names.size()) {
              *field.value = 0;
              archive.fail("an unknown choice for " + std::string(setting.name));
            }
          } else {
            archive(setting.name, *field);
          }
        },
        setting.field);
  }
  archive("until_stable", until_stable);
}

namespace {

Result<Exploration> exploration(const LearnSettings& settings, const World& world,
                                const LearnerTraits& traits) {
  std::string_view kind = settings.explore;
  if (kind == "auto") {
    const bool noisy = settings.deep.noisy && traits.networks;
    kind = noisy ? "greedy" : traits.approximates ? "epsilon-greedy" : "uniform";
  }
  const auto* const found =
      std::find(std::begin(exploration_names), std::end(exploration_names), kind);
  if (found == std::end(exploration_names)) {
    return Error{"--explore", 0, 0,
                 "no exploration '" + settings.explore + "'; see 'quoll list explorations'",
                 nearest(settings.explore, std::span<const std::string_view>(exploration_names))};
  }
  Exploration chosen;
  chosen.kind = static_cast<Exploration::Kind>(found - std::begin(exploration_names));
  chosen.first_tie = settings.ties == Ties::first;
  const auto epsilon = parse_schedule(
      settings.epsilon == "auto" ? traits.epsilon : settings.epsilon, 0.0, 1.0, "--epsilon");
  if (!epsilon) return epsilon.error();
  chosen.epsilon = *epsilon;
  // The span of rewards, 0 (doing nothing) included: the scale on which UCB1 assumes [0, 1].
  double span = 0.0;
  if (world.traits.reward_bounds) {
    const auto [low, high] = *world.traits.reward_bounds;
    span = std::max(high, 0.0) - std::min(low, 0.0);
  }
  if (!(span > 0.0)) span = 1.0;
  const auto temperature = parse_schedule(settings.temperature, 1e-9, 1e300, "--temperature", span);
  if (!temperature) return temperature.error();
  chosen.temperature = *temperature;
  chosen.ucb_scale = settings.ucb_constant * span;
  chosen.count_scale = settings.count_bonus * span;
  chosen.omega = settings.omega / span;
  return chosen;
}

// Those of a world without a model that are no ends.
std::vector<State> states_with_actions(const World& world) {
  const std::unique_ptr<Environment> environment = world.make({});
  std::vector<State> states;
  for (State s = 0; s < environment->spaces().states; ++s) {
    if (environment->actions(s) > 0) states.push_back(s);
  }
  return states;
}

Result<StartStates> starts(const LearnSettings& settings, const World& world) {
  const std::string_view text = settings.start;
  const std::string_view kind = text.substr(0, text.find(':'));
  const auto* const found = std::find(std::begin(start_names), std::end(start_names), kind);
  if (found == std::end(start_names) || (kind != text && kind != "fixed")) {
    return Error{"--start", 0, 0, "no start '" + settings.start + "'; see 'quoll list starts'",
                 nearest(kind, std::span<const std::string_view>(start_names))};
  }
  if (kind != "world" && !world.traits.settable) {
    return Error{
        "--start", 0, 0,
        "the world " + world.name + " cannot be put into a chosen state; use --start world", ""};
  }
  const auto which = static_cast<StartStates::Kind>(found - std::begin(start_names));
  if (!world.mdp) {
    if (kind == "world") return StartStates();
    if (kind != "fixed") return StartStates::among(which, states_with_actions(world));
    return Error{"--start", 0, 0, "a fixed start needs a world whose model is known", ""};
  }
  const Mdp& mdp = *world.mdp;
  StartStates result = kind == "world"     ? StartStates::world(mdp)
                       : kind == "uniform" ? StartStates::uniform(mdp)
                                           : StartStates::least_visited(mdp);
  if (which >= StartStates::Kind::each_pair) {
    result = StartStates::among(which, {result.states().begin(), result.states().end()});
  }
  if (kind == "fixed") {
    const std::string_view name = kind == text ? "" : text.substr(kind.size() + 1);
    const auto state = mdp.find_state(name);
    if (!state) {
      return Error{
          "--start", 0, 0,
          "no state '" + std::string(name) + "' in " + world.name + "; fixed:STATE expected",
          mdp.arrays().state_names.nearest(name)};
    }
    if (mdp.terminal(*state)) {
      return Error{"--start", 0, 0, "the state " + std::string(name) + " is an end: nothing to do",
                   ""};
    }
    result = StartStates::fixed(*state);
  }
  if (result.states().empty()) {
    return Error{"", 0, 0, "nothing to learn in " + world.name + ": every start state is an end",
                 ""};
  }
  return result;
}

// "optimistic": the most any policy can earn.
Result<double> initial_value(const LearnSettings& settings, const LearnSetup& setup,
                             bool optimistic) {
  if (settings.initial_value != "optimistic" && !(optimistic && settings.initial_value == "0")) {
    const auto number = parse_number(settings.initial_value);
    if (number && std::isfinite(*number)) return *number;
    return Error{"--initial-value", 0, 0,
                 "a number or optimistic expected, not '" + settings.initial_value + "'",
                 nearest(settings.initial_value, std::vector<std::string>{"optimistic"})};
  }
  if (!setup.rewards) {
    return Error{"--initial-value", 0, 0,
                 "optimistic needs a world that declares its rewards, or --reward-range; or give a "
                 "number",
                 ""};
  }
  const double most = value_range(*setup.rewards, setup.discount).second;
  if (std::isfinite(most)) return most;
  return Error{"--initial-value", 0, 0,
               "optimistic is unbounded here (discount 1 and rewards on the way); give a number",
               ""};
}

std::uint64_t episode_limit(const LearnSettings& settings, const World& world, double discount) {
  if (settings.episode_steps > 0) return settings.episode_steps;
  if (settings.start == "each-pair") return 1;
  if (world.episode_steps > 0) return world.episode_steps;
  if (settings.start == "world") return 2000;
  // Chosen starts are wasted in long episodes: one horizon, at most 32 steps.
  const double horizon = discount < 1.0 ? std::ceil(1.0 / (1.0 - discount)) : 32.0;
  return static_cast<std::uint64_t>(std::min(horizon, 32.0));
}

StableSetup stable(const LearnSettings& settings, const LearnSetup& setup,
                   const LearnerEntry& entry) {
  const World& world = *setup.world;
  StableSetup stable;
  stable.watch = settings.until_stable;
  const bool proves = world.traits.deterministic && entry.traits.off_policy &&
                      (setup.step_size.one() || setup.rule != "standard");
  stable.visits = proves ? 1 : 100;
  // What solvers plan is as exact as their intervals are narrow.
  const double exactly = entry.traits.plans ? 1e-9 : 0.0;
  stable.tolerance = settings.tolerance >= 0.0 ? settings.tolerance : proves ? exactly : 1e-3;
  if (stable.watch && world.mdp) {
    const std::vector<bool> reached = reachable(*world.mdp, setup.starts.states());
    for (State s = 0; s < world.mdp->states(); ++s) {
      if (reached[s] && !world.mdp->terminal(s)) stable.pairs += world.mdp->actions(s);
    }
  }
  return stable;
}

Result<StepSize> step_size(const LearnSettings& settings, const World& world, double discount) {
  const bool standard = settings.rule == "standard";
  if (!standard && settings.step_size != "auto" && settings.step_size != "1") {
    return Error{"--step-size", 0, 0,
                 "the rule " + settings.rule + " takes whole steps: 1 or auto expected, not '" +
                     settings.step_size + "'",
                 ""};
  }
  return parse_step_size(standard ? settings.step_size : "1", world.traits.deterministic, discount);
}

// What a table of this precision begins with; "all QE = 0" is part of the printed rule.
Result<double> first_value(const LearnSettings& settings, const LearnSetup& setup,
                           bool optimistic) {
  const auto initial = initial_value(settings, setup, optimistic);
  if (!initial) return initial;
  if (settings.rule == "as-printed") return 0.0;
  if (settings.precision == Precision::single &&
      std::fabs(*initial) > std::numeric_limits<float>::max()) {
    return Error{
        "--initial-value", 0, 0,
        shortest(*initial) + " is more than a table of floats can hold; use --precision double",
        ""};
  }
  return initial;
}

// The bound B of the divergence guard, or 0 where none is known.
double value_bound(const LearnSetup& setup, const World& world) {
  if (!world.traits.reward_bounds || setup.discount >= 1.0) return 0.0;
  double largest = std::max(std::fabs(world.traits.reward_bounds->first),
                            std::fabs(world.traits.reward_bounds->second));
  if (setup.rule != "standard") {
    for (const double reward : setup.initial_rewards) {
      largest = std::max(largest, std::fabs(reward));
    }
  }
  return std::max(std::fabs(setup.initial_value), largest / (1.0 - setup.discount));
}

// What the method and the words ask of each other.
Result<void> check(const LearnSettings& settings, const LearnerEntry& entry,
                   const LearnSetup& setup) {
  if (setup.starts.kind() == StartStates::Kind::widest_gap && !entry.traits.has_bounds) {
    return Error{"--start", 0, 0,
                 "widest-gap needs a method with an upper and a lower value of each state; " +
                     settings.method + " has none",
                 "optimistic-model"};
  }
  const Result<void> read = check_readers(settings, entry, setup.exploration);
  if (!read) return read;
  if (entry.traits.approximates && settings.start != "world") {
    return Error{"--start", 0, 0,
                 settings.method + " begins its episodes where the world does; only --start world",
                 ""};
  }
  if (settings.tolerance < 0.0 && settings.tolerance != -1.0) {
    return Error{
        "--tolerance", 0, 0,
        "-1 or a number of at least 0 expected, not '" + shortest(settings.tolerance) + "'", ""};
  }
  return entry.check == nullptr ? Result<void>() : entry.check(setup);
}

}  // namespace

Result<LearnSetup> resolve(const LearnSettings& settings, const World& world,
                           const std::vector<double>& initial_rewards) {
  const Result<const LearnerEntry*> entry = find_learner(settings);
  if (!entry) return entry.error();
  LearnSetup setup;
  setup.world = &world;
  setup.method = settings.method;
  setup.rule = settings.rule;
  setup.seed = settings.seed;
  setup.precision = settings.precision;
  setup.discount = settings.discount > 0.0 ? settings.discount : world.discount;
  const bool approximates = (*entry)->traits.approximates;
  if (world.traits.states == 0 && !approximates) {
    return Error{"", 0, 0,
                 "the states of " + world.name +
                     " cannot be listed: a table cannot learn it (worlds of observed numbers take "
                     "--with bins=...)",
                 ""};
  }
  const auto exploring = exploration(settings, world, (*entry)->traits);
  if (!exploring) return exploring.error();
  setup.exploration = *exploring;
  const auto starting = starts(settings, world);
  if (!starting) return starting.error();
  setup.starts = *starting;
  setup.episode_steps = episode_limit(settings, world, setup.discount);
  if (!approximates) {
    const auto step = step_size(settings, world, setup.discount);
    if (!step) return step.error();
    setup.step_size = *step;
  }
  const auto rewards = reward_range(world, settings.reward_range);
  if (!rewards) return rewards.error();
  setup.rewards = *rewards;
  setup.of_method = settings.of_method;
  setup.linear = settings.linear;
  setup.deep = settings.deep;
  const Result<void> fits = check(settings, **entry, setup);
  if (!fits) return fits.error();
  setup.stable.watch = settings.until_stable && (*entry)->traits.taught;
  if (approximates) return setup;
  const auto initial = first_value(settings, setup, (*entry)->traits.optimistic);
  if (!initial) return initial.error();
  setup.initial_value = *initial;
  const std::uint64_t choices = world.mdp ? world.mdp->choices() : 0;
  if (!initial_rewards.empty() && initial_rewards.size() != choices) {
    return Error{"--initial-rewards", 0, 0,
                 "one value for each of the " + std::to_string(choices) + " moves of " +
                     world.name + " expected, not " + std::to_string(initial_rewards.size()),
                 ""};
  }
  setup.initial_rewards = initial_rewards;
  if (initial_rewards.empty() && settings.initial_rewards == "world" && world.mdp) {
    setup.initial_rewards = world.mdp->arrays().reward;
  }
  setup.stable = stable(settings, setup, **entry);
  setup.value_bound = value_bound(setup, world);
  return setup;
}

}  // namespace quoll
