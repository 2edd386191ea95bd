#include "quoll/experiment/return_watch.hpp"

#include <numeric>

namespace quoll {

void ReturnReached::persist(Archive& archive) {
  archive("steps", steps);
  archive("episodes", episodes);
  archive("mean", mean);
  archive("processor_seconds", processor_seconds);
}

void ReturnWatch::look_for(double goal, std::uint64_t step, double processor_seconds) {
  if (goal_ == goal) return;
  goal_ = goal;
  reached_.reset();
  decide(step, processor_seconds);
}

void ReturnWatch::add(const FinishedEpisode& episode, double processor_seconds) {
  totals_[episodes_++ % window] = episode.total;
  decide(episode.step, processor_seconds);
}

void ReturnWatch::add(std::span<const Update> log, double processor_seconds) {
  for (const Update& update : log) {
    open_.step = update.step;
    open_.total += update.reward;
    ++open_.steps;
    if (!update.terminated && !update.truncated) continue;
    add(open_, processor_seconds);
    open_ = {};
  }
}

void ReturnWatch::decide(std::uint64_t step, double processor_seconds) {
  if (!goal_ || reached_ || !full() || !(mean() >= *goal_)) return;
  reached_ = ReturnReached{step, episodes_, mean(), processor_seconds};
}

double ReturnWatch::mean() const {
  return std::accumulate(totals_.begin(), totals_.end(), 0.0) / static_cast<double>(window);
}

void ReturnWatch::persist(Archive& archive) {
  archive("goal", goal_);
  archive("reached", reached_);
  archive("totals", totals_);
  archive("episodes", episodes_);
  archive("open_total", open_.total);
  archive("open_steps", open_.steps);
}

}  // namespace quoll
