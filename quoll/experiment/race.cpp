#include "quoll/experiment/race.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "quoll/base/parallel.hpp"
#include "quoll/experiment/thread_seconds.hpp"
#include "quoll/learn/greedy_rows.hpp"
#include "quoll/learn/learner.hpp"

namespace quoll {
namespace {

constexpr double measured_again_below = 0.02;

/// One learner on its way, in pieces short enough to be interrupted. Pieces change no bit.
class Runner {
 public:
  Runner(std::unique_ptr<Learner> learner, const HeatCaps& caps,
         const std::function<bool()>& keep_going)
      : learner_(std::move(learner)),
        rows_(dynamic_cast<const GreedyRows*>(learner_.get())),
        caps_(caps),
        keep_going_(keep_going) {}

  /// Why it stopped short of `target`; nothing = it is there.
  std::optional<HeatEnd> advance_to(std::uint64_t target) {
    while (steps_ < target) {
      if (keep_going_ && !keep_going_()) return HeatEnd::interrupted;
      if (caps_.seconds > 0.0 && seconds_ >= caps_.seconds) return HeatEnd::seconds;
      const std::uint64_t before = steps_;
      const double begun = thread_seconds();
      const std::uint64_t piece = std::min(target - steps_, piece_);
      steps_ = learner_->advance(piece, {}).steps;
      const double took = thread_seconds() - begun;
      seconds_ += took;
      if (took < 0.005) piece_ = std::min<std::uint64_t>(2 * piece_, 1 << 20);
      if (took > 0.02) piece_ = std::max<std::uint64_t>(piece_ / 2, 1);
      if (steps_ < before + piece) return HeatEnd::halted;
    }
    return std::nullopt;
  }

  /// Whether the greedy policy is good. Asks the learner for the actions that matter; for all
  /// values only where these are planned together.
  bool good(const Referee& referee, RaceMode mode) {
    reading_.reset();
    if (rows_ != nullptr && rows_->greedy_action(0)) {
      return referee.good([this](State s) { return *rows_->greedy_action(s); }, mode, notes_);
    }
    const double begun = thread_seconds();
    const Estimates estimates = learner_->estimates();
    reading_ = thread_seconds() - begun;
    const std::vector<Action> policy = greedy_policy(estimates);
    return referee.good([&](State s) { return policy[s]; }, mode, notes_);
  }

  /// Seconds so far, and of reading all values once.
  double seconds_with_reading() {
    if (!reading_) {
      const double begun = thread_seconds();
      const Estimates estimates = learner_->estimates();
      reading_ = thread_seconds() - begun;
    }
    return seconds_ + *reading_;
  }

  std::uint64_t steps() const { return steps_; }
  /// It stopped by itself, and not because its values ran away.
  bool content() const { return learner_->progress().halt == LearnProgress::Halt::stable; }
  std::uint64_t bytes() {
    Archive archive;
    archive("learner", *learner_);
    return archive.bytes().size();
  }

 private:
  std::unique_ptr<Learner> learner_;
  const GreedyRows* rows_;  // of it, if it has them
  const HeatCaps& caps_;
  const std::function<bool()>& keep_going_;
  RefereeNotes notes_;
  std::uint64_t steps_ = 0, piece_ = 64;
  double seconds_ = 0.0;
  std::optional<double> reading_;  // seconds of it at the present step
};

// The seconds of so many steps and of reading the values once, without stops on the way.
double seconds_in_one_piece(Learner& learner, std::uint64_t steps) {
  const double begun = thread_seconds();
  learner.advance(steps, {});
  const Estimates estimates = learner.estimates();
  return thread_seconds() - begun;
}

}  // namespace

std::uint64_t next_checkpoint(std::uint64_t step) {
  const auto later = static_cast<std::uint64_t>(static_cast<double>(step) * 1.07);
  return std::max(step + 1, later);
}

Result<Heat> run_heat(const LearnSettings& settings, const World& world, const Referee& referee,
                      RaceMode mode, const HeatCaps& caps,
                      const std::function<bool()>& keep_going) {
  Result<std::unique_ptr<Learner>> learner = make_learner(settings, world);
  if (!learner) return learner.error();
  Runner runner(std::move(*learner), caps, keep_going);
  std::optional<Heat> first;  // at the checkpoint before this one, if the policy was good there
  Heat now{settings.seed};
  for (;;) {
    const std::uint64_t next = std::min(next_checkpoint(runner.steps()), caps.steps);
    const std::optional<HeatEnd> stop = runner.advance_to(next);
    if (stop == HeatEnd::interrupted) return Heat{settings.seed};
    const bool over = stop || runner.steps() >= caps.steps;
    if (!over && runner.steps() < referee.fewest_steps(mode)) continue;
    const bool good = runner.good(referee, mode);
    if (good || over) {
      now = {settings.seed, HeatEnd::reached, runner.steps(), runner.seconds_with_reading(), 0};
    }
    if (good && first) break;
    if (good && runner.content()) {  // it is done, and would give the same policy for ever
      first = now;
      break;
    }
    first = good ? std::optional(now) : std::nullopt;
    if (over) {
      now.end = stop.value_or(HeatEnd::steps);
      now.bytes = runner.bytes();
      return now;
    }
  }
  first->bytes = runner.bytes();
  if (first->seconds < measured_again_below) {
    learner = make_learner(settings, world);
    if (learner) first->seconds = seconds_in_one_piece(**learner, first->steps);
  }
  return *first;
}

namespace {

/// A heat to run: which entrant, which seed.
struct Task {
  std::size_t entrant = 0;
  std::uint64_t seed = 0;
};

/// The heats of a race, whoever runs them.
class Field {
 public:
  Field(const RacePlan& plan, std::vector<Entrant> entrants, const RaceHooks& hooks)
      : plan_(plan), entrants_(std::move(entrants)), hooks_(hooks), results_(entrants_.size()) {
    for (std::size_t i = 0; i < entrants_.size(); ++i) {
      results_[i].word = entrants_[i].word;
      results_[i].settings = complete_word(entrants_[i].settings);
      results_[i].note = entrants_[i].note;
      // Making a learner finds out what the world cannot take.
      const Result<LearnSetup> setup = resolve(entrants_[i].settings, *plan_.world);
      if (!setup) results_[i].refused = message(setup.error());
    }
  }

  /// The first seeds of all, then the others of those who did not fail with each of them.
  void run() {
    const std::uint64_t trial = std::min(plan_.seeds, trial_seeds);
    run(0, trial);
    run(trial, plan_.seeds);
  }

  bool stopped() const { return stopped_; }
  std::vector<EntrantResult>& results() { return results_; }

 private:
  // Seeds [begin, end), counted from the first.
  void run(std::uint64_t begin, std::uint64_t end) {
    std::vector<std::size_t> running;
    for (std::size_t i = 0; i < entrants_.size(); ++i) {
      if (results_[i].refused.empty() && !retired(results_[i].heats)) running.push_back(i);
    }
    std::vector<Task> tasks;
    for (std::uint64_t k = begin; k < end; ++k) {
      for (const std::size_t i : running) tasks.push_back({i, plan_.first_seed + k});
    }
    tasks_ = done_ + (plan_.seeds - begin) * running.size();
    parallel_for(tasks.size(), plan_.threads, [&](std::size_t i) { run(tasks[i]); });
  }

  void run(const Task& task) {
    const Entrant& entrant = entrants_[task.entrant];
    if (!going()) return;
    if (const Heat* const known = known_heat(entrant, task.seed)) {
      keep(task, *known);
      return;
    }
    LearnSettings settings = entrant.settings;
    settings.seed = task.seed;
    settings.discount = plan_.referee->discount();
    const Result<Heat> heat = run_heat(settings, *plan_.world, *plan_.referee, plan_.mode,
                                       plan_.caps, [this] { return going(); });
    if (!heat) {
      const std::lock_guard lock(mutex_);
      results_[task.entrant].refused = message(heat.error());
      ++done_;
      return;
    }
    if (heat->end == HeatEnd::interrupted) return;
    keep(task, *heat);
    const std::lock_guard lock(mutex_);
    if (hooks_.finished) hooks_.finished(entrant, *heat);
  }

  const Heat* known_heat(const Entrant& entrant, std::uint64_t seed) {
    const std::lock_guard lock(mutex_);
    return hooks_.known ? hooks_.known(entrant, seed) : nullptr;
  }

  void keep(const Task& task, const Heat& heat) {
    const std::lock_guard lock(mutex_);
    results_[task.entrant].heats.push_back(heat);
    ++done_;
  }

  bool going() {
    if (stopped_) return false;
    const std::lock_guard lock(mutex_);
    if (hooks_.keep_going && !hooks_.keep_going(done_, tasks_)) stopped_ = true;
    return !stopped_;
  }

  const RacePlan& plan_;
  std::vector<Entrant> entrants_;
  const RaceHooks& hooks_;
  std::vector<EntrantResult> results_;
  std::mutex mutex_;
  std::uint64_t done_ = 0, tasks_ = 0;
  std::atomic<bool> stopped_{false};
};

// Of the lecture's settings the one with the better median stays; a median below the cap is better
// than one that is the cap, whatever the seconds.
void keep_better(std::vector<EntrantResult>& results, std::size_t settings) {
  const auto worse = [](const EntrantResult& one, const EntrantResult& other) {
    if (one.steps.median != other.steps.median) return one.steps.median > other.steps.median;
    return one.seconds.median > other.seconds.median;
  };
  for (std::size_t i = 1; i < settings; ++i) {
    if (worse(results[0], results[1])) std::swap(results[0], results[1]);
    results.erase(results.begin() + 1);
  }
}

}  // namespace

RaceResult run_race(const RacePlan& plan, const std::vector<Entrant>& entrants,
                    const RaceHooks& hooks) {
  const Mdp& mdp = *plan.world->mdp;
  const double discount = plan.referee->discount();
  std::vector<Entrant> all = lecture_entrants(*plan.world, plan.mode, discount);
  const std::size_t lectures = all.size();
  all.insert(all.end(), entrants.begin(), entrants.end());
  Field field(plan, std::move(all), hooks);
  field.run();
  RaceResult race;
  race.world = plan.world->name;
  race.mode = plan.mode;
  race.discount = discount;
  race.states = mdp.states();
  race.choices = mdp.choices();
  race.deterministic = mdp.deterministic();
  race.seeds = plan.seeds;
  race.first_seed = plan.first_seed;
  race.cap_steps = plan.caps.steps;
  race.cap_seconds = plan.caps.seconds;
  race.interrupted = field.stopped();
  race.entrants = std::move(field.results());
  summarise(race);
  keep_better(race.entrants, lectures);
  summarise(race);
  return race;
}

Result<World> world_from(const World& world, const std::string& state) {
  if (!world.mdp) {
    return Error{"--from", 0, 0, "the model of " + world.name + " is not known", ""};
  }
  const std::optional<State> found = world.mdp->find_state(state);
  if (!found || world.mdp->terminal(*found)) {
    return Error{"--from", 0, 0,
                 found ? "the state " + state + " is an end: nothing to do"
                       : "no state '" + state + "' in " + world.name,
                 found ? "" : world.mdp->arrays().state_names.nearest(state)};
  }
  MdpArrays arrays = world.mdp->arrays();
  arrays.start = {*found};
  arrays.start_probability.clear();
  Result<Mdp> mdp = Mdp::make(std::move(arrays));
  if (!mdp) return mdp.error();
  World moved = to_world(world.name, std::move(*mdp), {}, world.episode_steps);
  moved.parameters = world.parameters;
  moved.discount = world.discount;
  moved.traits.settable = world.traits.settable;
  return moved;
}

}  // namespace quoll
