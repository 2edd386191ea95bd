#include "quoll/experiment/run.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "quoll/base/file.hpp"
#include "quoll/base/parallel.hpp"
#include "quoll/base/text.hpp"
#include "quoll/experiment/referee.hpp"
#include "quoll/learn/deep/distil.hpp"
#include "quoll/learn/deep/learners.hpp"
#include "quoll/model/digest.hpp"
#include "quoll/model/graph.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

// At discount 1 a value may not exist: say so before learning, with names.
Result<void> defined_without_discount(const World& world, double discount) {
  if (discount < 1.0 || !world.mdp) return {};
  const UndiscountedFault fault = undiscounted_fault(*world.mdp);
  if (fault.kind == UndiscountedFault::Kind::none) return {};
  std::string names;
  for (std::size_t i = 0; i < fault.states.size() && i < 5; ++i) {
    names += (i > 0 ? ", " : "") + world.mdp->state_name(fault.states[i]);
  }
  if (fault.states.size() > 5) {
    names += " and " + std::to_string(fault.states.size() - 5) + " more";
  }
  using Kind = UndiscountedFault::Kind;
  return Error{
      "--discount", 0, 0,
      (fault.kind == Kind::gaining_cycle ? "at discount 1 the cycle " + names + " earns without end"
       : fault.kind == Kind::returning
           ? "at discount 1 no state of a game of two may come again, but these can: " + names
           : "at discount 1 no end can be reached from " + names) +
          ": values are not defined; give --discount below 1, or --force",
      ""};
}

void count_optimal(const Mdp& mdp, const Solution& exact, const std::vector<State>& from,
                   SeedResult& seed) {
  const std::vector<bool> reached = reachable(mdp, from);
  const TiedActions tied(mdp, exact);
  for (State s = 0; s < mdp.states(); ++s) {
    if (!reached[s] || mdp.terminal(s)) continue;
    ++seed.judged_states;
    const std::vector<Action> best = tied.of(s);
    seed.optimal_states += std::find(best.begin(), best.end(), seed.policy[s]) != best.end();
  }
}

std::optional<double> mean_of_known(const std::vector<std::optional<double>>& values) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const std::optional<double>& value : values) {
    sum += value.value_or(0.0);
    count += value.has_value();
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

std::uint64_t world_digest(const World& world) {
  return world.mdp ? digest(*world.mdp) : 0;
}

}  // namespace

std::uint64_t default_budget(const World& world) {
  std::uint64_t pairs = world.mdp ? world.mdp->choices() : 0;
  if (!world.mdp && world.make) pairs = world.traits.states * world.make({})->spaces().actions;
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max() / 2000;
  return std::max<std::uint64_t>(1'000'000, 2000 * std::min(pairs, most));
}

Result<Run> Run::start(RunSettings settings, WorldSource source, const World& world,
                       std::vector<double> initial_rewards) {
  if (settings.learn.method == quoll::distil.method) return find_offered(settings.learn).error();
  return begin(std::move(settings), std::move(source), world, std::move(initial_rewards));
}

Result<Run> Run::distil(RunSettings settings, WorldSource source, const World& world,
                        const Estimates& table, double share) {
  settings.learn.method = quoll::distil.method;
  Result<Run> run = begin(std::move(settings), std::move(source), world, {});
  if (!run) return run;
  for (Training& training : run->trainings_) teach(training.learner(), table, share);
  return run;
}

Result<Run> Run::begin(RunSettings settings, WorldSource source, const World& world,
                       std::vector<double> initial_rewards) {
  Run run;
  run.settings_ = std::move(settings);
  run.source_ = std::move(source);
  run.world_ = std::make_shared<const World>(world);
  run.initial_rewards_ = std::move(initial_rewards);
  run.choice_ = settle_method(world, run.settings_.learn);
  const Result<const LearnerEntry*> entry = find_learner(run.settings_.learn);
  if (!entry) return entry.error();
  run.entry_ = *entry;
  if (!run.settings_.force) {
    const Result<void> defined = defined_without_discount(world, run.discount());
    if (!defined) return defined.error();
  }
  if (run.settings_.seeds == 0) run.settings_.seeds = 1;
  const std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
  if (run.settings_.seeds - 1 > last - run.settings_.learn.seed) {
    return Error{"--seeds", 0, 0,
                 std::to_string(run.settings_.seeds) + " seeds from " +
                     std::to_string(run.settings_.learn.seed) +
                     " on do not exist: the last one is " + std::to_string(last),
                 ""};
  }
  if (run.settings_.by_model && !run.settings_.certified.empty() && !world.mdp) {
    return Error{"--until", 0, 0,
                 "the model of " + world.name + " is not known; certified:EPS goes by experience",
                 "certified:" + run.settings_.certified};
  }
  if (const Result<void> fits = run.allows(run.settings_); !fits) return fits.error();
  for (std::uint64_t index = 0; index < run.settings_.seeds; ++index) {
    Result<Training> training =
        Training::make(run.settings_, index, *run.world_, run.initial_rewards_);
    if (!training) return training.error();
    run.trainings_.push_back(std::move(*training));
  }
  return run;
}

Result<void> Run::allows(const RunSettings& limits) const {
  if (!entry_->traits.approximates) return {};
  const std::string& method = settings_.learn.method;
  if (limits.until == "stable") {
    return Error{"--until", 0, 0,
                 "stable is for tables; " + method + " keeps none: return:R or a limit expected",
                 ""};
  }
  if (!limits.certified.empty() && !limits.by_model) {
    return Error{"--until", 0, 0,
                 "certified:EPS from experience counts in tables; " + method +
                     " keeps none: return:R or, where the model is known, certified:EPS,model "
                     "expected",
                 ""};
  }
  return {};
}

double Run::discount() const {
  return settings_.learn.discount > 0.0 ? settings_.learn.discount : world_->discount;
}

// What was asked for; without any limit, what a method of this kind may take.
Limits Run::limits_of(const RunSettings& asked) const {
  Limits limits;
  limits.steps = asked.steps;
  limits.episodes = asked.episodes;
  if (!asked.time.empty()) {
    const Result<double> seconds = parse_duration(asked.time, "--time");
    limits.seconds = seconds ? *seconds : 0.0;
  }
  const bool bounded = limits.steps > 0 || limits.episodes > 0 || limits.seconds > 0.0;
  limits.mean_return = asked.mean_return();
  if (!bounded) {
    if (!entry_->traits.approximates)
      limits.budget = default_budget(*world_);
    else
      (limits.mean_return ? limits.budget : limits.steps) = default_steps;
  }
  // Under noise a certificate takes far more steps than being right.
  if (!bounded && !settings_.certified.empty() && !world_->traits.deterministic) {
    limits.budget = std::max<std::uint64_t>(limits.budget, 1'000'000'000);
  }
  if (settings_.by_model && !settings_.certified.empty()) limits.referee = referee();
  return limits;
}

bool Run::advance(const RunSettings& asked, double pause,
                  const std::function<bool(const RunProgress&)>& keep_going, const Sink& sink) {
  using Clock = std::chrono::steady_clock;
  const Limits limits = limits_of(asked);
  const Clock::time_point begun = Clock::now();
  const auto since = [&] { return std::chrono::duration<double>(Clock::now() - begun).count(); };
  std::mutex mutex;
  std::vector<LearnProgress> where, before;
  std::vector<std::optional<double>> returns(trainings_.size());
  std::uint64_t finished = 0;
  for (const Training& training : trainings_) before.push_back(training.learner().progress());
  where = before;
  std::atomic<bool> stopped{false}, paused{false};
  const auto between = [&](const Training& training) {
    if (stopped || paused) return false;
    const std::lock_guard lock(mutex);
    where[training.index()] = training.learner().progress();
    RunProgress progress;
    for (const LearnProgress& one : where) {
      progress.steps += one.steps;
      progress.episodes += one.episodes;
    }
    progress.finished = finished;
    progress.seconds = since();
    if (const auto& bins = training.curve().bins(); !bins.empty() && bins.back().episodes > 0) {
      returns[training.index()] = bins.back().mean();
    }
    progress.mean_return = mean_of_known(returns);
    if (keep_going && !keep_going(progress)) stopped = true;
    // However short the pause, each call of advance() learns something.
    const bool moved = where[training.index()].steps > before[training.index()].steps;
    if (pause > 0.0 && progress.seconds >= pause && moved) paused = true;
    return !stopped && !paused;
  };
  const Sink locked = [&](const Record& record) {
    const std::lock_guard lock(mutex);
    sink(record);
  };
  parallel_for(trainings_.size(), settings_.threads, [&](std::size_t i) {
    trainings_[i].advance(limits, between, sink ? locked : Sink());
    const std::lock_guard lock(mutex);
    ++finished;
  });
  return !paused || std::none_of(trainings_.begin(), trainings_.end(), [](const Training& one) {
    return one.stop() == Stop::interrupted;
  });
}

// Whether the greedy policy of a learner loses at most the gap asked for, by the model.
std::function<bool(const Learner&)> Run::referee() const {
  const auto judge = std::make_shared<const Result<Referee>>(
      Referee::of_goal(*world_, discount(), certify_goal(settings_), starts()));
  return [judge](const Learner& learner) {
    return *judge && (*judge)->good(greedy_policy(learner.estimates()), RaceMode::all);
  };
}

std::vector<State> Run::starts() const {
  const Result<LearnSetup> setup = resolve(settings_.learn, *world_);
  if (!setup) return {};
  return {setup->starts.states().begin(), setup->starts.states().end()};
}

// Over the seeds that count.
void Run::sum_up(RunResult& result) const {
  const auto stopped = [&](const SeedResult& seed) {
    return seed.stop == Stop::interrupted || seed.played.episodes < settings_.evaluation_episodes;
  };
  const bool all = std::all_of(result.seeds.begin(), result.seeds.end(), stopped);
  std::vector<double> means;
  for (const SeedResult& seed : result.seeds) {
    const bool begun = !stopped(seed) || seed.played.episodes > 0;
    if (begun && (all || !stopped(seed))) means.push_back(seed.played.mean);
    result.cut_short += seed.steps > 0 && seed.played.episodes < settings_.evaluation_episodes;
    result.seconds += seed.seconds;
  }
  result.counted = means.size();
  if (!means.empty()) result.statistics = statistics(means);
  if (const auto& mark = world_->traits.solved; mark && settings_.evaluation_episodes > 0) {
    result.solved = std::count_if(means.begin(), means.end(), [&](double m) { return m >= *mark; });
  }
}

RunResult Run::result(bool solve_too, const std::function<bool()>& keep_going) const {
  RunResult result;
  const Mdp* mdp = world_->mdp.get();
  if (mdp && solve_too) {
    SolveSettings settings;
    settings.discount = discount();
    settings.width = 1e-9;
    if (keep_going) settings.keep_going = [&](const SolveProgress&) { return keep_going(); };
    Result<Solution> exact = solve(*mdp, settings);
    if (exact)
      result.exact = std::move(*exact);
    else
      result.no_exact = message(exact.error());
  } else if (!mdp) {
    result.no_exact = "the model of " + world_->name + " is not known";
  }
  const std::vector<State> from = mdp ? starts() : std::vector<State>();
  result.seeds.resize(trainings_.size());
  parallel_for(trainings_.size(), settings_.threads, [&](std::size_t i) {
    const Training& training = trainings_[i];
    const LearnProgress progress = training.learner().progress();
    SeedResult& seed = result.seeds[i];
    seed.seed = training.seed();
    seed.steps = progress.steps;
    seed.episodes = progress.episodes;
    seed.seconds = training.seconds();
    seed.stop = training.stop();
    seed.impossible = progress.impossible;
    seed.processor_seconds = training.processor_seconds();
    seed.training_return = training.training_return();
    seed.reached = training.reached();
    std::unique_ptr<Policy> policy = training.learner().policy();
    seed.policy = greedy_policy(training.learner().estimates());
    if (training.certifier() != nullptr) {
      seed.certificate = training.certifier()->certificate();
      if (seed.certificate->reached) {
        seed.policy = seed.certificate->policy;
        policy = std::make_unique<TablePolicy>(seed.policy);
      }
    }
    if (mdp && result.exact && entry_->sound) {
      seed.optimality = judge(*mdp, *result.exact, seed.policy, from, discount());
      count_optimal(*mdp, *result.exact, from, seed);
    }
    // Of a seed that never began there is nothing to tell.
    if (seed.stop == Stop::interrupted && seed.steps == 0) return;
    seed.played = play(*world_, *policy, settings_.evaluation_episodes, seed.seed, discount(),
                       usual_cut(*world_), keep_going);
  });
  sum_up(result);
  return result;
}

void Run::persist(Archive& archive) {
  archive("world", source_.name);
  std::vector<std::string> parameters;
  for (const auto& [key, value] : source_.parameters) {
    parameters.push_back(key);
    parameters.push_back(value);
  }
  archive("parameters", parameters);
  source_.parameters.clear();
  for (std::size_t i = 0; i + 1 < parameters.size(); i += 2) {
    source_.parameters.emplace_back(parameters[i], parameters[i + 1]);
  }
  archive("settings", settings_);
  archive("initial_rewards", initial_rewards_);
}

Result<void> Run::save(const std::string& path) {
  Archive archive;
  persist(archive);
  std::uint64_t fingerprint = world_digest(*world_);
  archive("digest", fingerprint);
  for (Training& training : trainings_) archive("training", training);
  return save_archive(path, "run", archive.bytes());
}

Result<Run> Run::load(const std::string& path, bool watch, const World* offered) {
  const Result<std::vector<std::byte>> content = load_archive(path, "run");
  if (!content) return content.error();
  Archive archive{std::span<const std::byte>(*content)};
  Run saved;
  saved.persist(archive);
  std::uint64_t fingerprint = 0;
  archive("digest", fingerprint);
  const auto refuse = [&](const std::string& why) { return Error{path, 0, 0, why, ""}; };
  if (!archive.good())
    return refuse("not a run this program can read: " + archive.error().expected);
  const bool fits = offered != nullptr && offered->mdp && world_digest(*offered) == fingerprint;
  Result<World> world = fits ? *offered : find_world(saved.source_.name, saved.source_.parameters);
  if (!world) {
    const std::size_t slash = path.find_last_of('/');
    const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
    const std::size_t file = saved.source_.name.find_last_of('/');
    const std::string name =
        file == std::string::npos ? saved.source_.name : saved.source_.name.substr(file + 1);
    Result<World> beside = find_world(folder + name, saved.source_.parameters);
    if (!beside) return refuse("its world is not found: " + message(world.error()));
    world = std::move(beside);
  }
  if (world_digest(*world) != fingerprint) {
    return refuse("the world " + saved.source_.name + " has changed since this run was saved");
  }
  // Each seed takes bytes of the content: no number of them can cost more memory than the file.
  if (saved.settings_.seeds == 0 || saved.settings_.seeds > content->size()) {
    return refuse("not a run this program can read: it claims " +
                  std::to_string(saved.settings_.seeds) + " seeds");
  }
  const bool force = std::exchange(saved.settings_.force, true);  // checked when the run began
  saved.settings_.learn.until_stable = watch;
  Result<Run> run = begin(saved.settings_, saved.source_, *world, saved.initial_rewards_);
  if (!run) return refuse(message(run.error()));
  run->settings_.force = force;
  for (Training& training : run->trainings_) archive("training", training);
  if (!archive.good()) {
    return refuse("not a run this program can read: " + archive.error().expected);
  }
  if (!archive.at_end()) return refuse("not a run this program can read: more follows its end");
  return run;
}

}  // namespace quoll
