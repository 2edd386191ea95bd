#include "quoll/experiment/training.hpp"

#include <algorithm>
#include <chrono>

namespace quoll {

std::string_view stop_name(Stop stop) {
  constexpr std::string_view names[] = {"none",      "steps",    "episodes", "time",       "stable",
                                        "certified", "diverged", "budget",   "interrupted"};
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
  if (!settings.certified.empty() && !settings.by_model) {
    const Result<TabularSetup> setup = resolve(learn, world, initial_rewards);
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
}

// An episode takes at least one step, so as many steps as episodes are left cannot overshoot.
std::uint64_t Training::chunk(const Limits& limits, const LearnProgress& now) const {
  std::uint64_t steps = std::min<std::uint64_t>(curve_.boundary() - now.steps, 1 << 16);
  if (certifier_) steps = std::min({steps, certifier_->due() - now.steps, largest_log});
  if (limits.referee) steps = std::min(steps, std::max(refereed_, now.steps + 1) - now.steps);
  if (limits.steps > 0) steps = std::min(steps, limits.steps - now.steps);
  if (limits.budget > 0) steps = std::min(steps, limits.budget - now.steps);
  if (limits.episodes > 0) steps = std::min(steps, limits.episodes - now.episodes);
  return steps;
}

LearnProgress Training::advance_by(std::uint64_t steps) {
  if (!certifier_) return learner_->advance(steps, {});
  log_.resize(largest_log);
  const LearnProgress now = learner_->advance(steps, std::span(log_).first(steps));
  certifier_->observe(std::span(log_).first(now.logged));
  return now;
}

Stop Training::advance(const Limits& limits, const Between& between, const Sink& sink) {
  using Clock = std::chrono::steady_clock;
  LearnProgress now = learner_->progress();
  const Clock::time_point begun = Clock::now();
  const double before = seconds_;
  bool certified = certifier_ && certifier_->certificate().reached;
  for (;;) {
    seconds_ = before + std::chrono::duration<double>(Clock::now() - begun).count();
    using Halt = LearnProgress::Halt;
    if (certifier_ && now.steps >= certifier_->due()) certified = certifier_->check();
    if (limits.referee && now.steps >= refereed_) {
      refereed_ = now.steps + 1 + now.steps / 20;
      certified = limits.referee(*learner_);
    }
    stop_ = certified                                                ? Stop::certified
            : now.halt == Halt::stable                               ? Stop::stable
            : now.halt == Halt::diverged                             ? Stop::diverged
            : limits.steps > 0 && now.steps >= limits.steps          ? Stop::steps
            : limits.episodes > 0 && now.episodes >= limits.episodes ? Stop::episodes
            : limits.budget > 0 && now.steps >= limits.budget        ? Stop::budget
            : limits.seconds > 0.0 && seconds_ >= limits.seconds     ? Stop::time
            : between && !between(*this)                             ? Stop::interrupted
                                                                     : Stop::none;
    if (stop_ != Stop::none) return stop_;
    now = advance_by(chunk(limits, now));
    if (curve_.advance(now.steps, now.episodes, now.return_sum) && sink) {
      const LearningCurve::Bin& bin = curve_.bins().back();
      if (bin.episodes > 0) sink({now.steps, index_, "episodic_return", bin.mean()});
      sink({now.steps, index_, "episodes", static_cast<double>(now.episodes)});
    }
  }
}

void Training::persist(Archive& archive) {
  archive("seed", seed_);
  archive("seconds", seconds_);
  archive("curve", curve_);
  archive("learner", *learner_);
  if (certifier_) archive("certifier", *certifier_);
}

}  // namespace quoll
