#pragma once
// What the verbs with exact answers share.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "quoll/base/json.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/model/solution.hpp"
#include "quoll/solve/optimality.hpp"

namespace quoll::cli {

struct Interval {
  double lower = 0.0, upper = 0.0;
};

/// Bounds on the expected value of the start distribution, rounded outward.
Interval start_value(const Mdp& mdp, std::span<const double> lower, std::span<const double> upper);

/// The width to hold an answer to: `width` if it was `given`, else at least `relative` of the
/// largest finite bound, because rounding leaves nothing narrower.
double wanted_width(double width, bool given, double relative, std::span<const double> lower,
                    std::span<const double> upper);

/// Whether a setting was asked for by flag or --set.
bool asked_for(const GivenSettings& given, std::string_view key);

/// Optimal actions of a solution, for rewards and for costs.
class OptimalActions {
 public:
  /// For costs (maximise = false) holds a copy of the model with the signs turned.
  OptimalActions(const Mdp& mdp, const Solution& solution, bool maximise);
  OptimalActions(const OptimalActions&) = delete;
  OptimalActions& operator=(const OptimalActions&) = delete;

  std::vector<Action> of(State state) const;
  /// Per choice, 1 = optimal, for the first `states` states; 0 for the others.
  std::vector<std::uint8_t> flags(std::uint64_t states) const;

 private:
  const Mdp& mdp_;
  std::vector<Mdp> turned_;  // empty when maximising
  std::vector<Solution> mirrored_;
  std::optional<TiedActions> tied_;
};

/// "start": {"lower", "upper"}.
void write_interval(JsonWriter& json, std::string_view key, const Interval& interval);

/// The name of an action of a state, or null for no_action.
void write_action(JsonWriter& json, std::string_view key, const Mdp& mdp, State state,
                  Action action);

}  // namespace quoll::cli
