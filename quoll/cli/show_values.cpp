// The values that `show` puts on a world.

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "quoll/base/text.hpp"
#include "quoll/cli/learn_report.hpp"
#include "quoll/cli/seeds_curve.hpp"
#include "quoll/cli/show.hpp"
#include "quoll/env/listed.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll::cli {
namespace {

Result<Solution> solved(const Mdp& mdp, double discount) {
  SolveSettings settings;
  settings.discount = discount;
  settings.width = 1e-9;
  settings.threads = 0;
  return solve(mdp, settings);
}

// Greedy values among the visited actions, and all actions that share them.
void be_greedy(Exhibit& exhibit) {
  const Mdp& mdp = *exhibit.mdp;
  exhibit.value.assign(mdp.states(), std::numeric_limits<double>::quiet_NaN());
  exhibit.best.assign(mdp.choices(), 0);
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) {
      exhibit.value[s] = 0.0;
      continue;
    }
    if (exhibit.policy[s] == no_action) continue;
    exhibit.value[s] = exhibit.q[mdp.choice_begin(s) + exhibit.policy[s]];
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      exhibit.best[c] = exhibit.visits[c] > 0 && exhibit.q[c] == exhibit.value[s];
    }
  }
}

}  // namespace

Result<Exhibit> exact_exhibit(const World& world, double discount) {
  const Mdp& mdp = *world.mdp;
  Result<Solution> exact = solved(mdp, discount);
  if (!exact) return exact.error();
  Exhibit exhibit;
  exhibit.name = world.name;
  exhibit.mdp = &mdp;
  exhibit.title = fmt::format("{}: exact values, discount {}", world.name, shortest(discount));
  exhibit.value.resize(mdp.states());
  exhibit.best.assign(mdp.choices(), 0);
  const TiedActions tied(mdp, *exact);
  for (State s = 0; s < mdp.states(); ++s) {
    const double lower = exact->lower[s], upper = exact->upper[s];
    exhibit.value[s] = lower == upper ? lower : 0.5 * (lower + upper);
    for (const Action a : tied.of(s)) {
      exhibit.best[mdp.choice_begin(s) + a] = 1;
    }
  }
  exhibit.q = q_star_all(mdp, *exact, discount);
  exhibit.policy = exact->policy;
  return exhibit;
}

Exhibit bare_exhibit(const World& world, const std::string& why) {
  Exhibit exhibit;
  exhibit.name = world.name;
  exhibit.mdp = world.mdp.get();
  exhibit.title = world.name + " without values: " + why;
  return exhibit;
}

Exhibit learned_exhibit(const Run& run) {
  const World& world = run.world();
  Exhibit exhibit;
  exhibit.name = world.name;
  exhibit.learned = true;
  const Training& first = run.trainings().front();
  const LearnSettings& learn = run.settings().learn;
  exhibit.title = fmt::format(
      "{}: learned values, {}{}, discount {}, seed {}, {} steps", world.name, learn.method,
      learn.rule == "standard" ? "" : " " + learn.rule, shortest(run.discount()), first.seed(),
      grouped(first.learner().progress().steps));
  exhibit.curves = curves_of(run);
  const Estimates estimates = first.learner().estimates();
  if (estimates.row_begin.empty()) return exhibit;
  const Result<std::shared_ptr<const Mdp>> states = listed(world);
  if (!states) return exhibit;
  exhibit.states = *states;
  exhibit.mdp = exhibit.states.get();
  exhibit.q = estimates.q;
  exhibit.visits = estimates.visits;
  exhibit.q_is_float = estimates.single_precision;
  exhibit.policy = greedy_policy(estimates);
  be_greedy(exhibit);
  if (!world.mdp) return exhibit;
  const Result<Solution> exact = solved(*world.mdp, run.discount());
  if (exact) exhibit.q_star = q_star_all(*world.mdp, *exact, run.discount());
  return exhibit;
}

}  // namespace quoll::cli
