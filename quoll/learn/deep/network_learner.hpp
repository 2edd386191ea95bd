#pragma once
// What learners with a network have in common: lanes that are walked, actions chosen by the online
// network, what they tell of themselves.

#include <functional>
#include <memory>
#include <vector>

#include "quoll/act/exploration.hpp"
#include "quoll/learn/deep/deep_setup.hpp"
#include "quoll/learn/deep/distribution.hpp"
#include "quoll/learn/deep/inputs.hpp"
#include "quoll/learn/deep/q_function.hpp"
#include "quoll/learn/deep/walkers.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/nn/pass.hpp"

namespace quoll {

class NetworkLearner : public Learner {
 public:
  NetworkLearner(const LearnSetup& setup, const DeepSetup& deep, std::unique_ptr<QFunction> q);

  LearnProgress advance(std::uint64_t steps, std::span<Update> log) override;
  void ask(const std::function<bool()>& keep_going) override { keep_going_ = keep_going; }
  LearnProgress progress() const override;
  std::span<const FinishedEpisode> finished() const override { return walkers_.finished(); }
  std::vector<Measure> measures() const override {
    return {{"td_loss", loss_sum_, learned_}, {"q_values", value_sum_, learned_}};
  }
  std::unique_ptr<Policy> policy() const override;
  Estimates estimates() const override;
  std::shared_ptr<const LearnedNetwork> network() const override;
  void persist(Archive& archive) override;

 protected:
  /// Steps every lane once and learns from it, or goes on with the work that the last one left.
  virtual void round() = 0;
  /// Whether it left any, because nobody wanted to wait.
  virtual bool unfinished() const { return false; }
  bool keep_going() const { return !keep_going_ || keep_going_(); }
  virtual void persist_own(Archive& archive) = 0;
  /// What values of the network are divided by to be values of the world.
  virtual double value_scale() const { return deep_.settings.reward_scale; }

  /// Writes inputs_of(lane) of where each lane is, and its action; values are asked for only where
  /// a greedy action is wanted, or if `always`: then outputs_ holds them, in order.
  void choose_actions(bool always);
  std::span<float> inputs_of(std::size_t lane) {
    return here_.span().subspan(lane * inputs_.size(), inputs_.size());
  }
  /// Where the outputs are of names of actions: which is that of an action of a state, and a row of
  /// outputs brought into the order in which the state numbers its actions.
  Action output_of(State state, Action action) const {
    return deep_.letters ? deep_.letters->output(state, action) : action;
  }
  void put_in_order(State state, float* outputs);
  /// The mean values of the actions of a row of outputs.
  void means(const float* outputs, std::span<float> q) const {
    for (std::size_t a = 0; a < q.size(); ++a) {
      q[a] = distribution_.mean({outputs + a * distribution_.atoms(), distribution_.atoms()});
    }
  }
  float carry_of(bool terminated, bool turn_passes) const {
    return terminated ? 0.0F : turn_passes ? -discount_ : discount_;
  }
  /// Counts what was learned from, and whether it is still a number.
  void tell(double loss, double value);

  Walkers walkers_;
  DeepSetup deep_;
  Inputs inputs_;
  std::unique_ptr<QFunction> q_;
  Distribution distribution_;
  float discount_;
  std::size_t actions_;
  nn::Floats outputs_;                    // of the lanes, as values() writes them
  std::vector<float> means_;              // of the actions of one state
  std::vector<float> ordered_;            // of one row of outputs
  std::vector<std::uint64_t> row_begin_;  // of the estimates, where states are numbered
  std::vector<std::uint32_t> visits_;     // per pair, there
  LearnProgress::Halt halt_ = LearnProgress::Halt::none;

 private:
  void count_visits();

  std::function<bool()> keep_going_;
  Exploration exploration_;
  std::vector<Rng> behaviour_;  // per lane
  std::vector<ChoiceDraws> draws_;
  nn::Floats here_;
  double loss_sum_ = 0.0, value_sum_ = 0.0;
  std::uint64_t learned_ = 0;
};

/// What every network learner refuses: explorations that count visits, layouts that do not go with
/// duelling.
Result<void> check_network(const LearnSetup& setup, const DeepHabits& habits);
/// What learners that remember refuse: more than fits.
Result<void> check_replay(const DeepSetup& deep);

}  // namespace quoll
