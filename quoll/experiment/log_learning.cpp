#include "quoll/experiment/log_learning.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/env/listed.hpp"
#include "quoll/experiment/logged_steps.hpp"
#include "quoll/learn/tabular/model_learning.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

Result<LearnSetup> setup_for(LogLearning& learned, std::span<const std::string> files,
                             const std::optional<World>& world, const RunSettings& settings) {
  learned.named_by_logs = !world;
  if (world) {
    learned.world = *world;
    Result<std::shared_ptr<const Mdp>> names = listed(*world);
    if (!names) return names.error();
    learned.names = *names;
    return resolve(settings.learn, learned.world);
  }
  if (settings.learn.discount == 0.0) {
    return Error{"--discount", 0, 0,
                 "a number in (0, 1] expected: without a world nothing else says it", ""};
  }
  const auto range = reward_range(learned.world, settings.learn.reward_range);
  if (!range) return range.error();
  Result<Mdp> names = names_in_logs(files, settings.learn.discount);
  if (!names) return names.error();
  learned.names = std::make_shared<const Mdp>(std::move(*names));
  learned.world.name = files.front();
  learned.world.mdp = learned.names;
  learned.world.discount = settings.learn.discount;
  learned.world.traits.states = learned.names->states();
  LearnSetup setup;
  setup.world = &learned.world;
  setup.discount = settings.learn.discount;
  setup.starts = StartStates::world(*learned.names);
  setup.rewards = *range;
  return setup;
}

void widen(std::pair<double, double>& range, double reward) {
  range.first = std::min(range.first, reward);
  range.second = std::max(range.second, reward);
}

bool within(const std::pair<double, double>& inner, const std::pair<double, double>& outer) {
  return inner.first > inner.second || (inner.first >= outer.first && inner.second <= outer.second);
}

// Steps that contradict what the world says: another successor than the model has, or two different
// ones where everything is certain.
std::uint64_t count_misfits(const LogLearning& learned) {
  const Mdp* const mdp = learned.named_by_logs ? nullptr : learned.world.mdp.get();
  std::uint64_t misfits = 0;
  for (std::uint64_t pair = 0; pair < learned.model.pairs(); ++pair) {
    std::uint64_t kinds = 0;
    learned.model.each(pair, [&](const CountedModel::Outcome& seen) {
      bool possible = !learned.world.traits.deterministic || ++kinds == 1;
      if (mdp != nullptr) {
        possible = false;
        for (std::uint64_t o = mdp->outcome_begin(pair); o < mdp->outcome_end(pair); ++o) {
          const State next = mdp->terminal(mdp->next(o)) ? the_end : mdp->next(o);
          possible = possible || next == seen.next;
        }
      }
      if (!possible) misfits += seen.count;
    });
  }
  return misfits;
}

// Why the bounds would mean nothing; empty = they do.
std::string contradiction(const LogLearning& learned) {
  if (learned.misfits > 0) return "the log does not fit the world";
  const RewardRange& seen = learned.seen;
  if (within(seen.running, learned.rewards->running) && within(seen.last, learned.rewards->last)) {
    return "";
  }
  return "the log has rewards from " + shortest(seen.low()) + " to " + shortest(seen.high()) +
         ", outside the range that was declared";
}

Result<std::optional<Certifier>> certifier_for(const LogLearning& learned, const LearnSetup& setup,
                                               const RunSettings& settings) {
  if (!setup.rewards) return std::optional<Certifier>();
  if (learned.named_by_logs && settings.successors == Successors::listed) {
    return Error{"--successors", 0, 0, "a log has no list of successors: states expected",
                 "states"};
  }
  CertifyGoal goal = certify_goal(settings);
  goal.once = true;
  Result<Certifier> made = Certifier::make(setup, goal);
  if (!made) return made.error();
  return std::optional(std::move(*made));
}

Result<void> read(LogLearning& learned, std::span<const std::string> files) {
  const std::vector<std::uint64_t>& begin = learned.names->arrays().choice_begin;
  const bool passes = learned.names->alternating();
  learned.model = CountedModel(begin.back());
  learned.seen = {{HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, -HUGE_VAL}};
  const auto take = [&](std::span<const Update> steps) {
    for (const Update& step : steps) {
      learned.model.observe(begin[step.state] + step.action, step.terminated ? the_end : step.next,
                            step.reward, passes);
      widen(step.terminated ? learned.seen.last : learned.seen.running, step.reward);
      ++learned.steps;
      learned.ended += step.terminated ? 1 : 0;
      learned.cut += !step.terminated && step.truncated ? 1 : 0;
    }
    if (learned.certifier) learned.certifier->observe(steps);
  };
  return read_steps(files, *learned.names, take);
}

void bound(LogLearning& learned) {
  if (!learned.rewards) {
    learned.no_bounds = "the smallest and largest reward are not known: --reward-range LOW,HIGH";
    return;
  }
  if (!learned.certifier) return;
  learned.no_bounds = contradiction(learned);
  if (learned.no_bounds.empty()) {
    learned.certifier->check();
    if (!learned.certifier->certificate().lower.empty()) return;
    learned.no_bounds = "values are not defined at this discount";
  }
  learned.certifier.reset();
}

void judge_by_model(LogLearning& learned, const LearnSetup& setup) {
  if (learned.named_by_logs || !learned.world.mdp) {
    learned.no_exact = "the model of " + learned.world.name + " is not known";
    return;
  }
  const Mdp& mdp = *learned.world.mdp;
  SolveSettings settings;
  settings.discount = learned.discount;
  settings.width = 1e-9;
  Result<Solution> exact = solve(mdp, settings);
  if (!exact) {
    learned.no_exact = message(exact.error());
    return;
  }
  learned.exact = std::move(*exact);
  learned.optimality =
      judge(mdp, *learned.exact, learned.plan.policy, setup.starts.states(), learned.discount);
}

}  // namespace

std::uint64_t LogLearning::visits(State s) const {
  std::uint64_t count = 0;
  for (std::uint64_t c = names->choice_begin(s); c < names->choice_end(s); ++c) {
    count += model.tried(c);
  }
  return count;
}

double LogLearning::mean_reward(std::uint64_t pair) const {
  return model.backup(pair, 0.0, [](State) { return 0.0; });
}

Result<LogLearning> learn_from_logs(std::span<const std::string> files,
                                    const std::optional<World>& world,
                                    const RunSettings& settings) {
  LogLearning learned;
  Result<LearnSetup> setup = setup_for(learned, files, world, settings);
  if (!setup) return setup.error();
  learned.discount = setup->discount;
  learned.rewards = setup->rewards;
  if (learned.world.traits.players == 1) {
    Result<std::optional<Certifier>> made = certifier_for(learned, *setup, settings);
    if (made)
      learned.certifier = std::move(*made);
    else if (made.error().file != "--discount")
      return made.error();
    else
      learned.no_bounds = made.error().expected;
  } else {
    learned.no_bounds = "two players move in turn";
  }
  const Result<void> done = read(learned, files);
  if (!done) return done.error();
  learned.misfits = count_misfits(learned);
  if (!setup->rewards) setup->rewards = learned.seen;
  const Planning planning = known_pairs_only(*setup);
  learned.stuck = planning.stuck;
  learned.plan = plan(learned.model, learned.names->arrays().choice_begin, planning);
  if (!learned.plan.solved) {
    return Error{"--discount", 0, 0,
                 "the values of this log are not defined at discount " +
                     shortest(learned.discount) + ": one below 1 expected",
                 ""};
  }
  bound(learned);
  judge_by_model(learned, *setup);
  return learned;
}

}  // namespace quoll
