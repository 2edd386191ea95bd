#include "quoll/learn/deep/walkers.hpp"

#include <algorithm>

namespace quoll {

Walkers::Walkers(const LearnSetup& setup, std::uint32_t count)
    : environment_(setup.world->make({count, setup.seed, setup.episode_steps, nullptr})),
      spaces_(environment_->spaces()),
      count_(count),
      state_(count),
      next_(count),
      action_(count),
      feedback_(count),
      observation_(std::size_t{count} * spaces_.observation),
      next_observation_(observation_.size()),
      totals_(count),
      begun_(count) {
  std::vector<Action> counts(spaces_.states);
  bool equal = true;
  for (State s = 0; s < spaces_.states; ++s) {
    const Action offered = environment_->actions(s);
    counts[s] = offered == 0 ? spaces_.actions : offered;
    equal = equal && counts[s] == spaces_.actions;
  }
  if (!equal) counts_ = std::move(counts);
  show();
  environment_->restart(std::vector<std::uint8_t>(count, 1), now_);
}

void Walkers::show() {
  now_ = {state_, action_, feedback_, next_, observation_, next_observation_};
}

void Walkers::step() {
  environment_->step(now_);
  ++rounds_;
  for (std::size_t lane = 0; lane < count_; ++lane) {
    totals_[lane] += feedback_[lane].reward;
    if (feedback_[lane].over()) [[unlikely]] {
      end_episode(lane);
    }
  }
  progress_.steps += count_;
}

void Walkers::end_episode(std::size_t lane) {
  finished_.push_back({progress_.steps + lane + 1, totals_[lane], rounds_ - begun_[lane]});
  ++progress_.episodes;
  progress_.return_sum += totals_[lane];
  totals_[lane] = 0.0;
  begun_[lane] = rounds_;
}

void Walkers::go_on() {
  state_.swap(next_);
  observation_.swap(next_observation_);
  show();
  environment_->restart({}, now_);
}

void Walkers::persist(Archive& archive) {
  archive("environment", *environment_);
  archive("state", state_);
  archive("observation", observation_);
  archive("totals", totals_);
  archive("begun", begun_);
  archive("rounds", rounds_);
  archive("steps", progress_.steps);
  archive("episodes", progress_.episodes);
  archive("return_sum", progress_.return_sum);
  if (archive.saving()) return;
  const bool fits = state_.size() == count_ && totals_.size() == count_ &&
                    begun_.size() == count_ && observation_.size() == next_observation_.size();
  const bool known = spaces_.states == 0 || std::all_of(state_.begin(), state_.end(), [&](State s) {
                       return s < spaces_.states;
                     });
  if (!fits || !known) {
    archive.fail("the saved lanes do not fit this world");
    state_.assign(count_, 0);
    observation_.assign(next_observation_.size(), 0.0F);
    totals_.assign(count_, 0.0);
    begun_.assign(count_, 0);
  }
  show();
}

}  // namespace quoll
