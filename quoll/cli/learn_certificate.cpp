#include "quoll/cli/learn_certificate.hpp"

#include <fmt/format.h>

#include "quoll/base/text.hpp"
#include "quoll/cli/certificate.hpp"
#include "quoll/report/bounds_report.hpp"
#include "quoll/report/table.hpp"

namespace quoll::cli {
namespace {

const Certifier* certifier_of(const Run& run) {
  return run.trainings().front().certifier();
}

std::string state_text(const World& world, State s) {
  if (world.mdp) return world.mdp->state_name(s);
  return world.state_name ? world.state_name(s) : std::to_string(s);
}

std::string action_text(const World& world, State s, Action a) {
  if (world.mdp) return world.mdp->action_name(world.mdp->choice_begin(s) + a);
  return a < world.action_names.size() ? world.action_names[a] : std::to_string(a);
}

std::string goal_text(const CertifyGoal& goal) {
  const std::string gap =
      goal.relative ? shortest(100.0 * goal.gap) + " % of it" : shortest(goal.gap);
  return gap + (goal.everywhere ? " in every state" : " at the start");
}

// With the names of what blocks it, where the goal was not reached.
BoundsReport report_of(const Run& run, const Certifier& certifier) {
  constexpr std::size_t most_named = 10;
  BoundsReport report = bounds_report(certifier);
  report.reached = certifier.certificate().reached;
  if (*report.reached) return report;
  const World& world = run.world();
  for (const Blocking& pair : certifier.blocking()) {
    report.needed += pair.needed;
    if (report.blocking.size() == most_named) continue;
    report.blocking.push_back({state_text(world, pair.state),
                               action_text(world, pair.state, pair.action), pair.tried,
                               pair.needed});
  }
  return report;
}

// What the model proves of the start's value, and what the first seed's policy loses of it.
std::optional<BoundsReport> by_model(const Run& run, const RunResult& result) {
  const std::optional<Optimality>& judged = result.seeds.front().optimality;
  if (!result.exact || !judged || !run.entry().sound) return std::nullopt;
  const Mdp& mdp = *run.world().mdp;
  BoundsReport report;
  report.by_model = true;
  for (std::uint64_t i = 0; i < mdp.start().size(); ++i) {
    report.lower += mdp.start_probability(i) * result.exact->lower[mdp.start()[i]];
    report.upper += mdp.start_probability(i) * result.exact->upper[mdp.start()[i]];
  }
  report.gap = judged->regret;
  return report;
}

}  // namespace

std::string experience_text(const Run& run, const RunResult& result) {
  const Certifier* const certifier = certifier_of(run);
  if (certifier == nullptr) return "";
  const ExperienceCertificate& found = *result.seeds.front().certificate;
  if (found.lower.empty()) {
    return fmt::format("Certificate: none yet, the first check comes after {}.\n",
                       counted(certifier->due(), "step"));
  }
  const BoundsReport report = report_of(run, *certifier);
  return fmt::format(
             "{} from experience, {}: the start value lies in [{}, {}], and the policy loses at "
             "most {} (at {}; asked {}).\n",
             found.reached ? "Certified" : "Not certified,", certainty_text(report),
             number_text(report.lower), number_text(report.upper), number_text(report.gap),
             state_text(run.world(), found.widest), goal_text(certifier->goal())) +
         blocking_text(report) + assumed_text(report);
}

void write_learned_certificate(JsonWriter& json, const Run& run, const RunResult& result) {
  const Certifier* const certifier = certifier_of(run);
  if (certifier == nullptr) return write_bounds(json, by_model(run, result));
  if (certifier->certificate().lower.empty()) return write_bounds(json, std::nullopt);
  write_bounds(json, report_of(run, *certifier));
}

Result<void> may_write_experience(const Run& run) {
  const auto refuse = [](const std::string& why) { return Error{"--certificate", 0, 0, why, ""}; };
  if (certifier_of(run) == nullptr) {
    return refuse("needs --until certified:EPS; solve writes what the model proves");
  }
  if (!run.world().mdp) return refuse("needs a world whose states have names in a model");
  return {};
}

Result<void> write_experience(const std::string& file, const Run& run, const RunResult& result) {
  const ExperienceCertificate& found = *result.seeds.front().certificate;
  if (found.lower.empty()) {
    return Error{"--certificate", 0, 0, "nothing is certified yet: no file written", ""};
  }
  Solution claim;
  claim.lower = found.lower;
  claim.upper = found.upper;
  claim.policy = found.policy;
  claim.discount = run.discount();
  claim.method = run.entry().method;
  return write_certificate(file, run.world(), claim, true, run.source().name);
}

}  // namespace quoll::cli
