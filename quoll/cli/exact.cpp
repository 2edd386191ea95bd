#include "quoll/cli/exact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "quoll/solve/methods.hpp"
#include "quoll/solve/optimality.hpp"
#include "quoll/solve/rounding.hpp"

namespace quoll::cli {

Interval start_value(const Mdp& mdp, std::span<const double> lower, std::span<const double> upper) {
  Interval sum;
  if (mdp.start().size() == 1) return {lower[mdp.start()[0]], upper[mdp.start()[0]]};
  for (std::uint64_t i = 0; i < mdp.start().size(); ++i) {
    const State s = mdp.start()[i];
    const double share = mdp.start_probability(i);
    if (share == 0.0) continue;
    sum.lower = add_down(sum.lower, scale_down(share, lower[s]));
    sum.upper = add_up(sum.upper, scale_up(share, upper[s]));
  }
  return sum;
}

double wanted_width(double width, bool given, double relative, std::span<const double> lower,
                    std::span<const double> upper) {
  if (given) return width;
  double size = 0.0;
  for (const std::span<const double> bounds : {lower, upper}) {
    for (const double x : bounds) {
      if (std::isfinite(x)) size = std::max(size, std::fabs(x));
    }
  }
  return std::max(width, relative * size);
}

bool asked_for(const GivenSettings& given, std::string_view key) {
  const auto all = given.given();
  if (!all) return false;
  return std::any_of(all->begin(), all->end(), [&](const auto& one) { return one.first == key; });
}

OptimalActions::OptimalActions(const Mdp& mdp, const Solution& solution, bool maximise)
    : mdp_(mdp) {
  tied_.emplace(mdp, solution);
  if (maximise) return;
  Result<Mdp> turned = negated_rewards(mdp);
  if (!turned) return;  // cannot happen: only signs differ from a valid model
  turned_.push_back(std::move(*turned));
  mirrored_.push_back(solution);
  turn_signs(mirrored_[0].lower, mirrored_[0].upper);
  tied_.emplace(turned_[0], mirrored_[0]);
}

std::vector<Action> OptimalActions::of(State state) const {
  return tied_->of(state);
}

std::vector<std::uint8_t> OptimalActions::flags(std::uint64_t states) const {
  std::vector<std::uint8_t> flags(mdp_.choices(), 0);
  for (State s = 0; s < states && s < mdp_.states(); ++s) {
    for (const Action a : of(s)) flags[mdp_.choice_begin(s) + a] = 1;
  }
  return flags;
}

void write_interval(JsonWriter& json, std::string_view key, const Interval& interval) {
  json.key(key).begin_object();
  json.member("lower", interval.lower).member("upper", interval.upper).end_object();
}

void write_action(JsonWriter& json, std::string_view key, const Mdp& mdp, State state,
                  Action action) {
  if (action == no_action) {
    json.null_member(key);
  } else {
    json.member(key, mdp.action_name(mdp.choice_begin(state) + action));
  }
}

}  // namespace quoll::cli
