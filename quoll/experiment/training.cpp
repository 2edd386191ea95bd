#include "quoll/experiment/training.hpp"

#include <algorithm>
#include <chrono>

#include "quoll/experiment/thread_seconds.hpp"

namespace quoll {

std::string_view stop_name(Stop stop) {
  constexpr std::string_view names[] = {"none",      "steps",  "episodes", "time",   "stable",
                                        "certified", "return", "diverged", "budget", "interrupted"};
  return names[static_cast<std::size_t>(stop)];
}

Result<Training> Training::make(const RunSettings& settings, std::uint64_t index,
                                const World& world, const std::vector<double>& initial_rewards) {
  LearnSettings learn = settings.learn;
  learn.seed += index;
  Result<std::unique_ptr<Learner>> learner = make_learner(learn, world, initial_rewards);
  if (!learner) return learner.error();
  Training training;
  training.seed_ = learn.seed;
  training.index_ = static_cast<std::uint32_t>(index);
  training.learner_ = std::move(*learner);
  training.approximates_ = (*find_learner(learn))->traits.approximates;
  if (!settings.certified.empty() && !settings.by_model) {
    const Result<LearnSetup> setup = resolve(learn, world, initial_rewards);
    if (!setup) return setup.error();
    Result<Certifier> certifier = Certifier::make(*setup, certify_goal(settings));
    if (!certifier) return certifier.error();
    training.certifier_ = std::move(*certifier);
    training.learner_->log_experience_only();
  }
  return training;
}

namespace {
constexpr std::uint64_t largest_log = 4096;  // updates
// Learners that approximate may need a millisecond a step: progress, limits of time and the moment
// of a return want short chunks.
constexpr std::uint64_t largest_approximated = 1024;
}  // namespace

// An episode takes at least one step, so as many steps as episodes are left cannot overshoot.
std::uint64_t Training::chunk(const Limits& limits, const LearnProgress& now) const {
  if (now.unfinished) return 0;
  std::uint64_t steps = std::min<std::uint64_t>(curve_.boundary() - now.steps, 1 << 16);
  if (approximates_) steps = std::min(steps, largest_approximated);
  if (certifier_) steps = std::min({steps, certifier_->due() - now.steps, largest_log});
  if (limits.mean_return) steps = std::min(steps, largest_log);
  if (limits.referee) steps = std::min(steps, std::max(refereed_, now.steps + 1) - now.steps);
  if (limits.steps > 0) steps = std::min(steps, limits.steps - now.steps);
  if (limits.budget > 0) steps = std::min(steps, limits.budget - now.steps);
  if (limits.episodes > 0) steps = std::min(steps, limits.episodes - now.episodes);
  return steps;
}

LearnProgress Training::advance_by(std::uint64_t steps, const Limits& limits) {
  const bool logged = certifier_ || (limits.mean_return && !approximates_);
  if (logged) log_.resize(largest_log);
  const double before = thread_seconds();
  const LearnProgress now = learner_->advance(steps, std::span(log_).first(logged ? steps : 0));
  processor_seconds_ += thread_seconds() - before;
  const std::span<const Update> updates = std::span(log_).first(now.logged);
  if (certifier_) certifier_->observe(updates);
  returns_.add(updates, processor_seconds_);
  for (const FinishedEpisode& episode : learner_->finished()) {
    returns_.add(episode, processor_seconds_);
  }
  return now;
}

Stop Training::advance(const Limits& limits, const Between& between, const Sink& sink) {
  using Clock = std::chrono::steady_clock;
  LearnProgress now = learner_->progress();
  const Clock::time_point begun = Clock::now();
  const double before = seconds_;
  bool certified = certifier_ && certifier_->certificate().reached;
  if (limits.mean_return) returns_.look_for(*limits.mean_return, now.steps, processor_seconds_);
  const auto seconds = [&] {
    return before + std::chrono::duration<double>(Clock::now() - begun).count();
  };
  learner_->ask([&] {
    return (limits.seconds <= 0.0 || seconds() < limits.seconds) && (!between || between(*this));
  });
  for (;;) {
    seconds_ = seconds();
    using Halt = LearnProgress::Halt;
    if (certifier_ && now.steps >= certifier_->due()) certified = certifier_->check();
    if (limits.referee && now.steps >= refereed_) {
      refereed_ = now.steps + 1 + now.steps / 20;
      certified = limits.referee(*learner_);
    }
    // A goal is reached, and a number of steps taken, when what belongs to them is done.
    const bool done = !now.unfinished;
    stop_ = certified                                                        ? Stop::certified
            : done && limits.mean_return && returns_.reached()               ? Stop::reached
            : now.halt == Halt::stable                                       ? Stop::stable
            : now.halt == Halt::diverged                                     ? Stop::diverged
            : done && limits.steps > 0 && now.steps >= limits.steps          ? Stop::steps
            : done && limits.episodes > 0 && now.episodes >= limits.episodes ? Stop::episodes
            : done && limits.budget > 0 && now.steps >= limits.budget        ? Stop::budget
            : limits.seconds > 0.0 && seconds_ >= limits.seconds             ? Stop::time
            : between && !between(*this)                                     ? Stop::interrupted
                                                                             : Stop::none;
    if (stop_ != Stop::none) break;
    now = advance_by(chunk(limits, now), limits);
    if (curve_.advance(now.steps, now.episodes, now.return_sum)) record(now, sink);
  }
  learner_->ask({});
  return stop_;
}

// What was measured is counted with and without a sink: a run is the same either way.
void Training::record(const LearnProgress& now, const Sink& sink) {
  const auto say = [&](std::string_view name, double value) {
    if (sink) sink({now.steps, index_, name, value});
  };
  const LearningCurve::Bin& bin = curve_.bins().back();
  if (bin.episodes > 0) say("episodic_return", bin.mean());
  say("episodes", static_cast<double>(now.episodes));
  if (!approximates_) return;
  say("processor_seconds", processor_seconds_);
  const std::vector<Measure> measures = learner_->measures();
  measured_.resize(measures.size());
  for (std::size_t i = 0; i < measures.size(); ++i) {
    const std::uint64_t count = measures[i].count - measured_[i].count;
    const double sum = measures[i].sum - measured_[i].sum;
    if (count > 0) say(measures[i].name, sum / static_cast<double>(count));
    measured_[i] = {measures[i].sum, measures[i].count};
  }
}

void Training::persist(Archive& archive) {
  archive("seed", seed_);
  archive("seconds", seconds_);
  archive("processor_seconds", processor_seconds_);
  archive("returns", returns_);
  archive("curve", curve_);
  archive("measured", measured_);
  archive("learner", *learner_);
  if (certifier_) archive("certifier", *certifier_);
}

}  // namespace quoll
