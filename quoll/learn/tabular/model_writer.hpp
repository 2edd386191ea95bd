#pragma once
// A model written state by state, for the solvers.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "quoll/learn/tabular/counted_model.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// Writes choice after choice, state after state. The state after the last is the end of all ways.
class ModelWriter {
 public:
  /// For about so many choices. `numbers`, if not empty: what the successors that are told are
  /// called in the model; it must outlive the writer.
  ModelWriter(std::uint64_t states, std::uint64_t choices, std::span<const State> numbers = {})
      : end_(static_cast<State>(states)), numbers_(numbers) {
    arrays_.choice_begin.reserve(states + 2);
    arrays_.next.reserve(choices);
    arrays_.reward.reserve(choices);
    arrays_.action.reserve(choices);
  }

  void begin_state() {
    arrays_.choice_begin.push_back(arrays_.reward.size());
    next_action_ = 0;
  }

  /// A choice that ends everything and is worth this much.
  void leave(double value) {
    outcome(the_end, 1.0);
    finish_choice(value);
  }

  /// A choice as it was seen; its mean reward, the bonus not counted.
  void take(const CountedModel& model, std::uint64_t pair, double bonus) {
    double reward = 0.0;
    const std::uint32_t n = model.tried(pair);
    model.each(pair, [&](const CountedModel::Outcome& seen) {
      reward += seen.reward_sum;
      arrays_.alternating = arrays_.alternating || seen.turn_passes;
      outcome(seen.next, static_cast<double>(seen.count) / n);
    });
    finish_choice(reward / n + bonus);
  }

  Result<Mdp> model(double discount) {
    begin_state();  // the end has no choices
    begin_state();
    arrays_.action_names = Names::numbered("", most_actions_);
    arrays_.state_names = Names::numbered("", std::uint64_t{end_} + 1);
    arrays_.discount = discount;
    return Mdp::make(std::move(arrays_));
  }

  /// A choice outcome by outcome; `next` may be the_end. Then finish_choice() with its mean reward.
  void outcome(State next, double probability) {
    if (probability != 1.0 && arrays_.probability.empty()) {
      arrays_.probability.assign(arrays_.next.size(), 1.0);
    }
    if (probability != 1.0 || !arrays_.probability.empty()) {
      arrays_.probability.push_back(probability);
    }
    const bool renamed = next != the_end && !numbers_.empty();
    arrays_.next.push_back(next == the_end ? end_ : renamed ? numbers_[next] : next);
  }
  void finish_choice(double reward) {
    arrays_.reward.push_back(reward);
    arrays_.action.push_back(next_action_++);
    most_actions_ = std::max(most_actions_, next_action_);
    if (single_ && arrays_.next.size() != arrays_.reward.size()) begin_outcome_begin();
    if (!single_) arrays_.outcome_begin.push_back(arrays_.next.size());
  }

 private:
  // Until now each choice had one outcome.
  void begin_outcome_begin() {
    single_ = false;
    arrays_.outcome_begin.resize(arrays_.reward.size());
    std::iota(arrays_.outcome_begin.begin(), arrays_.outcome_begin.end(), std::uint64_t{0});
  }

  bool single_ = true;
  State end_;
  std::span<const State> numbers_;
  Action next_action_ = 0, most_actions_ = 0;
  MdpArrays arrays_;
};

}  // namespace quoll
