#include "quoll/env/mdp_environment.hpp"

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "quoll/env/grid_looks.hpp"
#include "quoll/env/lane_dice.hpp"
#include "quoll/env/table.hpp"

namespace quoll {
namespace {

// What the environments of one model share, each part built when it is first asked for.
class SharedModel {
 public:
  SharedModel(std::shared_ptr<const Mdp> mdp, Looks looks)
      : mdp_(std::move(mdp)), looks_(std::move(looks)) {}

  const Mdp& mdp() const { return *mdp_; }
  const Looks& looks() const { return looks_; }
  Action most_actions() const { return facts().most_actions; }
  // The last start takes what rounding leaves over.
  State start(double draw) const {
    const std::vector<double>& sum = facts().start_sum;
    const auto found = std::upper_bound(sum.begin(), sum.end() - 1, draw);
    return mdp_->start()[static_cast<std::size_t>(found - sum.begin())];
  }
  StochasticTable<double>::View table() const {
    std::call_once(table_once_,
                   [&] { table_ = stochastic_table<double>(*mdp_, {0, mdp_->choices()}); });
    return table_.view();
  }
  const GridLooks& grid() const {
    std::call_once(grid_once_, [&] { grid_.emplace(*mdp_); });
    return *grid_;
  }

 private:
  struct Facts {
    std::vector<double> start_sum;
    Action most_actions = 0;
  };

  const Facts& facts() const {
    std::call_once(facts_once_, [&] {
      for (State s = 0; s < mdp_->states(); ++s) {
        facts_.most_actions = std::max(facts_.most_actions, mdp_->actions(s));
      }
      double sum = 0.0;
      for (std::uint64_t i = 0; i < mdp_->start().size(); ++i) {
        facts_.start_sum.push_back(sum += mdp_->start_probability(i));
      }
    });
    return facts_;
  }

  std::shared_ptr<const Mdp> mdp_;
  Looks looks_;
  mutable std::once_flag facts_once_, table_once_, grid_once_;
  mutable Facts facts_;
  mutable StochasticTable<double> table_;
  mutable std::optional<GridLooks> grid_;
};

// The draws of the packed tables: 64 bits a step.
class TableDraws {
 public:
  explicit TableDraws(const SharedModel& model) : table_(model.table()) {}

  static std::uint64_t draw(Rng& dice) { return dice.next(); }
  Landing<double> step(std::uint64_t choice, std::uint64_t draw) const {
    return table_.step(choice, draw);
  }

 private:
  StochasticTable<double>::View table_;
};

// The draws of Gymnasium's tables: one uniform number a step, and the first outcome, in the order
// of the model's arrays, whose running sum exceeds it.
class RunningSums {
 public:
  explicit RunningSums(const SharedModel& model) : mdp_(model.mdp()) {}

  static double draw(GuestDice& dice) { return dice.uniform(); }
  Landing<double> step(std::uint64_t choice, double draw) const {
    std::uint64_t outcome = mdp_.outcome_begin(choice);
    double sum = mdp_.probability(outcome);
    while (outcome + 1 < mdp_.outcome_end(choice) && !(sum > draw)) {
      sum += mdp_.probability(++outcome);
    }
    const State next = mdp_.next(outcome);
    return {next, mdp_.reward(choice, outcome), mdp_.terminal(next)};
  }

 private:
  const Mdp& mdp_;
};

template <class DiceOfLanes>
class ModelEnvironment final : public Environment, private Inspector {
 public:
  ModelEnvironment(std::shared_ptr<const SharedModel> model, const Lanes& lanes)
      : model_(std::move(model)),
        mdp_(model_->mdp()),
        moves_(*model_),
        dice_(lanes),
        limit_(lanes.episode_steps),
        elapsed_(lanes.count) {}

  Spaces spaces() const override {
    return {model_->most_actions(), static_cast<std::uint32_t>(mdp_.states()), 0, {}, false};
  }
  std::uint32_t actions(State state) const override {
    return mdp_.terminal(state) ? 0 : mdp_.actions(state);
  }
  bool set(std::uint32_t lane, State) override {  // the state is the caller's column
    elapsed_[lane] = 0;
    return true;
  }
  void restart(std::span<const std::uint8_t> restart, Experience& now) override {
    for (std::size_t lane = 0; lane < elapsed_.size(); ++lane) {
      if (!begins(restart, now, lane)) continue;
      now.state[lane] = model_->start(dice_.of_start(lane).uniform());
      elapsed_[lane] = 0;
    }
  }
  void step(Experience& now) override {
    for (std::size_t lane = 0; lane < elapsed_.size(); ++lane) {
      const State at = now.state[lane];
      const auto draw = Moves::draw(dice_.of_step(lane));
      const bool truncated = ++elapsed_[lane] == limit_;
      if (mdp_.terminal(at)) {  // nothing happens in an end
        now.next[lane] = at;
        now.feedback[lane] = {0.0, true, truncated};
        continue;
      }
      const Landing<double> landing = moves_.step(mdp_.choice_begin(at) + now.action[lane], draw);
      now.next[lane] = landing.next;
      now.feedback[lane] = {landing.reward, landing.terminated, truncated,
                            mdp_.alternating() && !landing.terminated};
    }
  }
  void persist(Archive& archive) override {
    for (std::size_t lane = 0; lane < elapsed_.size(); ++lane) {
      dice_.persist(archive, lane);
      archive("elapsed", elapsed_[lane]);
    }
  }
  Inspector* inspector() override { return this; }

 private:
  using Moves = std::conditional_t<std::is_same_v<DiceOfLanes, OwnDice>, TableDraws, RunningSums>;

  Tree state(std::uint32_t, State at) const override { return Tree(mdp_.state_name(at)); }
  Result<void> set(std::uint32_t lane, const Tree& state, State& at) override {
    std::string nearest;
    if (const auto* const name = std::get_if<std::string>(&state.value)) {
      if (const std::optional<State> found = mdp_.find_state(*name)) {
        at = *found;
        elapsed_[lane] = 0;
        return {};
      }
      nearest = mdp_.arrays().state_names.nearest(*name);
    } else if (const auto* const index = std::get_if<std::int64_t>(&state.value);
               index && *index >= 0 && static_cast<std::uint64_t>(*index) < mdp_.states()) {
      at = static_cast<State>(*index);
      elapsed_[lane] = 0;
      return {};
    }
    return Error{"", 0, 0, "the name or the number of a state expected", nearest};
  }
  Tree observation(std::uint32_t, State at) const override {
    const Looks& looks = model_->looks();
    return looks.observation ? looks.observation(at) : Tree(std::int64_t{at});
  }
  std::string text(std::uint32_t, State at) const override {
    if (model_->looks().text) return model_->looks().text(at);
    return mdp_.layout() ? model_->grid().text(at) : mdp_.state_name(at) + "\n";
  }
  Drawing drawing(std::uint32_t, State at) const override {
    if (model_->looks().drawing) return model_->looks().drawing(at);
    return mdp_.layout() ? model_->grid().drawing(at) : Drawing();
  }
  bool draws_left() const override { return dice_.good(); }

  std::shared_ptr<const SharedModel> model_;
  const Mdp& mdp_;
  Moves moves_;
  DiceOfLanes dice_;
  std::uint64_t limit_;
  std::vector<std::uint64_t> elapsed_;
};

}  // namespace

std::function<std::unique_ptr<Environment>(Lanes)> mdp_environments(std::shared_ptr<const Mdp> mdp,
                                                                    Looks looks,
                                                                    std::uint64_t episode_steps,
                                                                    Seeding seeding) {
  const auto model = std::make_shared<const SharedModel>(std::move(mdp), std::move(looks));
  return [model, episode_steps, seeding](Lanes lanes) {
    if (lanes.episode_steps == 0) lanes.episode_steps = episode_steps;
    return with_dice(lanes, seeding, [&](auto type) -> std::unique_ptr<Environment> {
      return std::make_unique<ModelEnvironment<typename decltype(type)::type>>(model, lanes);
    });
  };
}

}  // namespace quoll
