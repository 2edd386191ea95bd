#include "quoll/env/mdp_environment.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/env/table.hpp"

namespace quoll {
namespace {

class MdpEnvironment final : public Environment {
 public:
  MdpEnvironment(std::shared_ptr<const Mdp> mdp, std::uint32_t lanes, std::uint64_t seed)
      : mdp_(std::move(mdp)), table_(stochastic_table<double>(*mdp_, {0, mdp_->choices()})) {
    for (State s = 0; s < mdp_->states(); ++s) {
      most_actions_ = std::max(most_actions_, mdp_->actions(s));
    }
    double sum = 0.0;
    for (std::uint64_t i = 0; i < mdp_->start().size(); ++i) {
      start_sum_.push_back(sum += mdp_->start_probability(i));
    }
    for (std::uint32_t lane = 0; lane < lanes; ++lane) {
      dice_.push_back(stream(seed, "world", lane));
      start_dice_.push_back(stream(seed, "start", lane));
    }
  }

  Spaces spaces() const override {
    return {most_actions_, static_cast<std::uint32_t>(mdp_->states()), 0};
  }
  void restart(std::span<const std::uint8_t> restart, Experience& now) override {
    for (std::size_t lane = 0; lane < dice_.size(); ++lane) {
      if (restart[lane]) now.state[lane] = start(unit(start_dice_[lane].next()));
    }
  }
  std::uint32_t actions(State state) const override {
    return mdp_->terminal(state) ? 0 : mdp_->actions(state);
  }
  void step(Experience& now) override {
    for (std::size_t lane = 0; lane < dice_.size(); ++lane) {
      const std::uint64_t draw = dice_[lane].next();
      if (mdp_->terminal(now.state[lane])) {
        now.next[lane] = now.state[lane];
        now.feedback[lane] = {0.0, true, false};
        continue;
      }
      const std::uint64_t choice = mdp_->choice_begin(now.state[lane]) + now.action[lane];
      const Landing<double> landing = table_.view().step(choice, draw);
      now.next[lane] = landing.next;
      now.feedback[lane] = {landing.reward, landing.terminated, false};
    }
  }
  bool set(std::uint32_t, State) override { return true; }  // the state is the caller's column
  void persist(Archive& archive) override {
    for (std::size_t lane = 0; lane < dice_.size(); ++lane) {
      archive("dice", dice_[lane]);
      archive("start_dice", start_dice_[lane]);
    }
  }

 private:
  State start(double draw) const {
    // The last start takes what rounding leaves over.
    const auto found = std::upper_bound(start_sum_.begin(), start_sum_.end() - 1, draw);
    return mdp_->start()[static_cast<std::size_t>(found - start_sum_.begin())];
  }

  std::shared_ptr<const Mdp> mdp_;
  StochasticTable<double> table_;
  std::vector<double> start_sum_;
  std::vector<Rng> dice_, start_dice_;
  Action most_actions_ = 0;
};

}  // namespace

std::unique_ptr<Environment> mdp_environment(std::shared_ptr<const Mdp> mdp, std::uint32_t lanes,
                                             std::uint64_t seed) {
  return std::make_unique<MdpEnvironment>(std::move(mdp), lanes, seed);
}

}  // namespace quoll
