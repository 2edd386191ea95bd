#include "quoll/solve/discounted.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "quoll/solve/methods.hpp"
#include "quoll/solve/sweep.hpp"

namespace quoll {

Discounted::Discounted(const Mdp& mdp, const SolveSettings& settings, double discount,
                       std::string_view method)
    : mdp_(mdp),
      settings_(settings),
      discount_(discount),
      scale_(mdp),
      start_(start_bounds(scale_, discount, mdp)),
      value_(mdp.states(), 0.0),
      backed_up_(mdp.states(), 0.0) {
  solution_.method = method;
  solution_.discount = discount;
  solution_.policy.assign(mdp.states(), no_action);
  for (State s = 0; s < mdp.states(); ++s) {
    if (!mdp.terminal(s) && start_.lower > -infinity) value_[s] = start_.lower;
  }
}

Residual Discounted::residual_of_value() {
  return {value_.data(), backed_up_.data(), solution_.policy.data()};
}

bool Discounted::certify() {
  return certify_with(backed_up_,
                      sweep_all(mdp_, discount_, residual_of_value(), settings_.threads));
}

bool Discounted::certify(PolicyRows& rows) {
  const PackingResidual packing(residual_of_value(), rows);
  return certify_with(backed_up_, sweep_all(mdp_, discount_, packing, settings_.threads));
}

bool Discounted::certify_with(std::vector<double>& backed_up, const Differences& change) {
  ++solution_.sweeps;
  solution_.backups += mdp_.states();
  double size = 0.0;
  for (const double v : backed_up) size = std::max(size, std::fabs(v));
  for (const double v : value_) size = std::max(size, std::fabs(v));
  std::swap(value_, backed_up);
  if (change.greatest == -infinity) {  // only ends
    bounds_ = {0.0, 0.0, 0.0};
    return true;
  }
  span_ = change.span();
  residual_ = std::max(std::fabs(change.least), std::fabs(change.greatest));
  bounds_ = span_bounds(scale_, discount_, change.least, change.greatest, size);
  stopped_ = !may_continue(settings_, solution_, bounds_.width());
  return stopped_ || bounds_.width() <= std::max(settings_.width, 2.0 * bounds_.rounding);
}

double Discounted::aim() const {
  return std::max(0.25 * settings_.width * (1.0 - discount_) / discount_,
                  0.1 * bounds_.rounding * (1.0 - discount_));
}

bool Discounted::count(std::uint64_t updates, double change) {
  updates_ += updates;
  solution_.backups += updates;
  solution_.sweeps += updates_ / mdp_.states();
  updates_ %= mdp_.states();
  stopped_ = !may_continue(settings_, solution_, change * discount_ / (1.0 - discount_));
  return !stopped_;
}

// The larger of two inductive lower bounds is one again, as is the smaller of two upper ones.
Solution Discounted::finish() {
  solution_.lower = std::move(value_);
  solution_.upper = solution_.lower;
  for (State s = 0; s < mdp_.states(); ++s) {
    if (mdp_.terminal(s)) continue;
    solution_.lower[s] = std::max(add_down(solution_.lower[s], bounds_.lower), start_.lower);
    solution_.upper[s] = std::min(add_up(solution_.upper[s], bounds_.upper), start_.upper);
  }
  conclude(mdp_, solution_, settings_.width);
  return std::move(solution_);
}

Solution solve_discounted(const Mdp& mdp, const SolveSettings& settings, double discount) {
  constexpr std::size_t least_bands = 8;
  Discounted run(mdp, settings, discount, "wavefront");
  if (!wavefront(run, least_bands)) {
    run.set_method("modified-policy-iteration");
    modified_policy_iteration(run);
  }
  return run.finish();
}

}  // namespace quoll
