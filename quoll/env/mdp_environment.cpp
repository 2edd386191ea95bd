#include "quoll/env/mdp_environment.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/env/grid_looks.hpp"
#include "quoll/env/table.hpp"

namespace quoll {
namespace {

// What both ways of drawing share: the model, step limits, what states look like.
class ModelEnvironment : public Environment, private Inspector {
 public:
  ModelEnvironment(std::shared_ptr<const Mdp> mdp, std::shared_ptr<const Looks> looks,
                   const Lanes& lanes)
      : mdp_(std::move(mdp)),
        limit_(lanes.episode_steps),
        elapsed_(lanes.count),
        looks_(std::move(looks)) {
    for (State s = 0; s < mdp_->states(); ++s) {
      most_actions_ = std::max(most_actions_, mdp_->actions(s));
    }
    double sum = 0.0;
    for (std::uint64_t i = 0; i < mdp_->start().size(); ++i) {
      start_sum_.push_back(sum += mdp_->start_probability(i));
    }
  }

  Spaces spaces() const override {
    return {most_actions_, static_cast<std::uint32_t>(mdp_->states()), 0, {}, false};
  }
  std::uint32_t actions(State state) const override {
    return mdp_->terminal(state) ? 0 : mdp_->actions(state);
  }
  bool set(std::uint32_t lane, State) override {  // the state is the caller's column
    elapsed_[lane] = 0;
    return true;
  }
  Inspector* inspector() override { return this; }

 protected:
  // The last start takes what rounding leaves over.
  State start(double draw) const {
    const auto found = std::upper_bound(start_sum_.begin(), start_sum_.end() - 1, draw);
    return mdp_->start()[static_cast<std::size_t>(found - start_sum_.begin())];
  }
  bool turn_passes(State next) const { return mdp_->alternating() && !mdp_->terminal(next); }
  // Nothing happens in an end.
  void rest(std::size_t lane, Experience& now) {
    now.next[lane] = now.state[lane];
    now.feedback[lane] = {0.0, true, ++elapsed_[lane] == limit_};
  }

  std::shared_ptr<const Mdp> mdp_;
  std::uint64_t limit_;
  std::vector<std::uint64_t> elapsed_;

 private:
  Tree state(std::uint32_t, State at) const override { return Tree(mdp_->state_name(at)); }
  Result<void> set(std::uint32_t lane, const Tree& state, State& at) override {
    std::string nearest;
    if (const auto* const name = std::get_if<std::string>(&state.value)) {
      if (const std::optional<State> found = mdp_->find_state(*name)) {
        at = *found;
        elapsed_[lane] = 0;
        return {};
      }
      nearest = mdp_->arrays().state_names.nearest(*name);
    } else if (const auto* const index = std::get_if<std::int64_t>(&state.value);
               index && *index >= 0 && static_cast<std::uint64_t>(*index) < mdp_->states()) {
      at = static_cast<State>(*index);
      elapsed_[lane] = 0;
      return {};
    }
    return Error{"", 0, 0, "the name or the number of a state expected", nearest};
  }
  Tree observation(std::uint32_t, State at) const override {
    return looks_->observation ? looks_->observation(at) : Tree(std::int64_t{at});
  }
  std::string text(std::uint32_t, State at) const override {
    if (looks_->text) return looks_->text(at);
    return mdp_->layout() ? grid_state_text(*mdp_, at) : mdp_->state_name(at) + "\n";
  }
  Drawing drawing(std::uint32_t, State at) const override {
    if (looks_->drawing) return looks_->drawing(at);
    return mdp_->layout() ? grid_state_drawing(*mdp_, at) : Drawing();
  }

  std::shared_ptr<const Looks> looks_;
  std::vector<double> start_sum_;
  Action most_actions_ = 0;
};

// The draws of the packed tables: a stream for starts and one for steps.
class TableEnvironment final : public ModelEnvironment {
 public:
  TableEnvironment(std::shared_ptr<const Mdp> mdp, std::shared_ptr<const Looks> looks,
                   const Lanes& lanes)
      : ModelEnvironment(std::move(mdp), std::move(looks), lanes),
        table_(stochastic_table<double>(*mdp_, {0, mdp_->choices()})) {
    for (std::uint32_t lane = 0; lane < lanes.count; ++lane) {
      dice_.push_back(stream(lanes.seed, "world", lane));
      start_dice_.push_back(stream(lanes.seed, "start", lane));
    }
  }

  void restart(std::span<const std::uint8_t> restart, Experience& now) override {
    for (std::size_t lane = 0; lane < dice_.size(); ++lane) {
      if (!restart[lane]) continue;
      now.state[lane] = start(unit(start_dice_[lane].next()));
      elapsed_[lane] = 0;
    }
  }
  void step(Experience& now) override {
    const StochasticTable<double>::View table = table_.view();
    for (std::size_t lane = 0; lane < dice_.size(); ++lane) {
      const std::uint64_t draw = dice_[lane].next();
      if (mdp_->terminal(now.state[lane])) {
        rest(lane, now);
        continue;
      }
      const std::uint64_t choice = mdp_->choice_begin(now.state[lane]) + now.action[lane];
      const Landing<double> landing = table.step(choice, draw);
      now.next[lane] = landing.next;
      now.feedback[lane] = {landing.reward, landing.terminated, ++elapsed_[lane] == limit_,
                            turn_passes(now.next[lane])};
    }
  }
  void persist(Archive& archive) override {
    for (std::size_t lane = 0; lane < dice_.size(); ++lane) {
      archive("dice", dice_[lane]);
      archive("start_dice", start_dice_[lane]);
      archive("elapsed", elapsed_[lane]);
    }
  }

 private:
  StochasticTable<double> table_;
  std::vector<Rng> dice_, start_dice_;
};

// The draws of Gymnasium's tables: one generator, one uniform number a start and a step.
class GuestTableEnvironment final : public ModelEnvironment {
 public:
  GuestTableEnvironment(std::shared_ptr<const Mdp> mdp, std::shared_ptr<const Looks> looks,
                        const Lanes& lanes)
      : ModelEnvironment(std::move(mdp), std::move(looks), lanes) {
    for (std::uint32_t lane = 0; lane < lanes.count; ++lane) {
      if (lanes.draws && lane == 0)
        dice_.emplace_back(lanes.draws);
      else
        dice_.emplace_back(lanes.seed + lane);
    }
  }

  void restart(std::span<const std::uint8_t> restart, Experience& now) override {
    for (std::size_t lane = 0; lane < dice_.size(); ++lane) {
      if (!restart[lane]) continue;
      now.state[lane] = start(dice_[lane].uniform());
      elapsed_[lane] = 0;
    }
  }
  void step(Experience& now) override {
    for (std::size_t lane = 0; lane < dice_.size(); ++lane) {
      const double draw = dice_[lane].uniform();
      if (mdp_->terminal(now.state[lane])) {
        rest(lane, now);
        continue;
      }
      const std::uint64_t choice = mdp_->choice_begin(now.state[lane]) + now.action[lane];
      std::uint64_t outcome = mdp_->outcome_begin(choice);
      double sum = mdp_->probability(outcome);
      while (outcome + 1 < mdp_->outcome_end(choice) && !(sum > draw)) {
        sum += mdp_->probability(++outcome);
      }
      now.next[lane] = mdp_->next(outcome);
      now.feedback[lane] = {mdp_->reward(choice, outcome), mdp_->terminal(now.next[lane]),
                            ++elapsed_[lane] == limit_, turn_passes(now.next[lane])};
    }
  }
  void persist(Archive& archive) override {
    for (std::size_t lane = 0; lane < dice_.size(); ++lane) {
      archive("dice", dice_[lane]);
      archive("elapsed", elapsed_[lane]);
    }
  }

 private:
  bool draws_left() const override { return dice_[0].good(); }

  std::vector<GuestDice> dice_;
};

}  // namespace

std::unique_ptr<Environment> mdp_environment(std::shared_ptr<const Mdp> mdp, const Lanes& lanes,
                                             std::shared_ptr<const Looks> looks, Seeding seeding) {
  if (!looks) looks = std::make_shared<const Looks>();
  if (lanes.draws || seeding == Seeding::gymnasium) {
    return std::make_unique<GuestTableEnvironment>(std::move(mdp), std::move(looks), lanes);
  }
  return std::make_unique<TableEnvironment>(std::move(mdp), std::move(looks), lanes);
}

}  // namespace quoll
