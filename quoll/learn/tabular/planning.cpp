#include "quoll/learn/tabular/planning.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Writes choice after choice. The state after the last is the end of all ways.
class ModelWriter {
 public:
  ModelWriter(const CountedModel& model, std::uint64_t states)
      : model_(model), end_(static_cast<State>(states)) {
    arrays_.choice_begin.reserve(states + 2);
    arrays_.outcome_begin.push_back(0);
  }

  void begin_state() {
    arrays_.choice_begin.push_back(arrays_.reward.size());
    next_action_ = 0;
  }

  /// A choice that ends everything and is worth this much.
  void leave(double value) {
    outcome(end_, 1.0);
    finish_choice(value);
  }

  /// A choice as it was seen; its mean reward, the bonus not counted.
  void take(std::uint64_t pair, double bonus) {
    double reward = 0.0;
    const std::uint32_t n = model_.tried(pair);
    model_.each(pair, [&](const CountedModel::Outcome& seen) {
      reward += seen.reward_sum;
      arrays_.alternating = arrays_.alternating || seen.turn_passes;
      outcome(seen.next == the_end ? end_ : seen.next, static_cast<double>(seen.count) / n);
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

 private:
  void outcome(State next, double probability) {
    arrays_.next.push_back(next);
    arrays_.probability.push_back(probability);
  }
  void finish_choice(double reward) {
    arrays_.reward.push_back(reward);
    arrays_.action.push_back(next_action_++);
    most_actions_ = std::max(most_actions_, next_action_);
    arrays_.outcome_begin.push_back(arrays_.next.size());
  }

  const CountedModel& model_;
  State end_;
  Action next_action_ = 0, most_actions_ = 0;
  MdpArrays arrays_;
};

Result<Mdp> model_of(const CountedModel& model, const std::vector<std::uint64_t>& begin,
                     const Planning& planning) {
  const std::uint64_t states = begin.size() - 1;
  ModelWriter writer(model, states);
  for (State s = 0; s < states; ++s) {
    writer.begin_state();
    bool stuck = true, unknown = false;
    for (std::uint64_t pair = begin[s]; pair < begin[s + 1]; ++pair) {
      if (model.tried(pair) < planning.known_after) {
        unknown = true;
      } else {
        writer.take(pair, planning.bonus ? planning.bonus(pair) : 0.0);
        stuck = false;
      }
    }
    if (unknown && planning.unknown) writer.leave(*planning.unknown);
    const bool needs_way_out = planning.discount == 1.0 || !planning.unknown;
    if (begin[s] < begin[s + 1] && needs_way_out && (stuck || planning.discount == 1.0)) {
      writer.leave(planning.stuck);
    }
  }
  return writer.model(planning.discount);
}

}  // namespace

Plan plan(const CountedModel& model, const std::vector<std::uint64_t>& begin,
          const Planning& planning) {
  const std::uint64_t states = begin.size() - 1;
  Plan result;
  result.state_value.assign(states, 0.0);
  result.pair_value.assign(begin.back(), -infinity);
  const Result<Mdp> mdp = model_of(model, begin, planning);
  if (!mdp) return result;
  SolveSettings settings;
  settings.width = planning.width;
  const Result<Solution> solution = solve(*mdp, settings, planning.method);
  if (!solution) return result;
  result.solved = true;
  for (State s = 0; s < states; ++s) {
    result.state_value[s] = (solution->lower[s] + solution->upper[s]) / 2;
  }
  for (std::uint64_t pair = 0; pair < begin.back(); ++pair) {
    if (model.tried(pair) >= planning.known_after) {
      result.pair_value[pair] =
          (planning.bonus ? planning.bonus(pair) : 0.0) +
          model.backup(pair, planning.discount, [&](State s) { return result.state_value[s]; });
    } else if (planning.unknown) {
      result.pair_value[pair] = *planning.unknown;
    }
  }
  return result;
}

}  // namespace quoll
