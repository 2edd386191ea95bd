#pragma once
// What the verbs with exact answers share.

#include <cstdint>
#include <span>
#include <vector>

#include "quoll/model/mdp.hpp"
#include "quoll/model/solution.hpp"
#include "quoll/report/json.hpp"

namespace quoll::cli {

struct Interval {
  double lower = 0.0, upper = 0.0;
};

/// Bounds on the expected value of the start distribution, rounded outward.
Interval start_value(const Mdp& mdp, std::span<const double> lower, std::span<const double> upper);

/// Optimal actions of a solution, for rewards and for costs.
class OptimalActions {
 public:
  /// For costs (maximise = false) holds a copy of the model with the signs turned.
  OptimalActions(const Mdp& mdp, const Solution& solution, bool maximise);
  std::vector<Action> of(State state) const;
  /// Per choice, 1 = optimal, for the first `states` states; 0 for the others.
  std::vector<std::uint8_t> flags(std::uint64_t states) const;

 private:
  const Mdp& mdp_;
  const Solution& solution_;
  std::vector<Mdp> turned_;  // empty when maximising
  std::vector<Solution> mirrored_;
};

/// "start": {"lower", "upper"}.
void write_interval(JsonWriter& json, std::string_view key, const Interval& interval);

/// The name of an action of a state, or null for no_action.
void write_action(JsonWriter& json, std::string_view key, const Mdp& mdp, State state,
                  Action action);

}  // namespace quoll::cli
