#include "quoll/cli/learn_certificate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "quoll/base/text.hpp"
#include "quoll/cli/certificate.hpp"
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

std::string basis_text(const Certifier& certifier) {
  if (certifier.certain()) return "from experience, the world being deterministic";
  return fmt::format("from experience, with {} % confidence",
                     shortest(100.0 * certifier.goal().confidence));
}

std::string goal_text(const CertifyGoal& goal) {
  const std::string gap =
      goal.relative ? shortest(100.0 * goal.gap) + " % of it" : shortest(goal.gap);
  return gap + (goal.everywhere ? " in every state" : " at the start");
}

std::string blocking_text(const Run& run, const Certifier& certifier) {
  std::string text;
  std::uint64_t needed = 0;
  const std::vector<Blocking> pairs = certifier.blocking();
  for (const Blocking& pair : pairs) needed += pair.needed;
  for (const Blocking& pair : std::span(pairs).first(std::min<std::size_t>(pairs.size(), 5))) {
    text +=
        fmt::format("{}({}, {}) tried {}", text.empty() ? "Blocked by " : ", ",
                    state_text(run.world(), pair.state),
                    action_text(run.world(), pair.state, pair.action), counted(pair.tried, "time"));
  }
  if (text.empty()) return "";
  return text + fmt::format("; about {} more samples are needed.\n", grouped(needed));
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
  std::string text = fmt::format(
      "{} {}: the start value lies in [{}, {}], and the policy loses at most {} ({}; asked {}).\n",
      found.reached ? "Certified" : "Not certified,", basis_text(*certifier),
      number_text(found.start_lower), number_text(found.start_upper), number_text(found.gap),
      "at " + state_text(run.world(), found.widest), goal_text(certifier->goal()));
  if (!found.reached) text += blocking_text(run, *certifier);
  std::string assumed;
  for (const std::string& one : certifier->assumptions()) {
    assumed += (assumed.empty() ? "" : "; ") + one;
  }
  return text + "Assumed: " + assumed + ".\n";
}

void write_learned_certificate(JsonWriter& json, const Run& run, const RunResult& result) {
  const SeedResult& first = result.seeds.front();
  if (const Certifier* const certifier = certifier_of(run)) {
    const ExperienceCertificate& found = *first.certificate;
    if (found.lower.empty()) {
      json.null_member("certificate");
      return;
    }
    json.key("certificate").begin_object();
    json.member("lower", found.start_lower).member("upper", found.start_upper);
    json.member("gap", found.gap).member("reached", found.reached);
    json.member("basis",
                certifier->certain() ? "experience-deterministic" : "experience-confidence");
    if (certifier->certain())
      json.null_member("confidence");
    else
      json.member("confidence", certifier->goal().confidence);
    json.key("assumptions").begin_array();
    for (const std::string& one : certifier->assumptions()) json.value(one);
    json.end_array();
    json.key("blocking").begin_array();
    for (const Blocking& pair : found.reached ? std::vector<Blocking>() : certifier->blocking(10)) {
      json.begin_object().member("state", state_text(run.world(), pair.state));
      json.member("action", action_text(run.world(), pair.state, pair.action));
      json.member("visits", pair.tried).member("needed", pair.needed).end_object();
    }
    json.end_array().end_object();
    return;
  }
  const std::optional<Optimality>& judged = first.optimality;
  if (!result.exact || !judged || !run.entry().sound) {
    json.null_member("certificate");
    return;
  }
  const Mdp& mdp = *run.world().mdp;
  double lower = 0.0, upper = 0.0;
  for (std::uint64_t i = 0; i < mdp.start().size(); ++i) {
    lower += mdp.start_probability(i) * result.exact->lower[mdp.start()[i]];
    upper += mdp.start_probability(i) * result.exact->upper[mdp.start()[i]];
  }
  json.key("certificate").begin_object();
  json.member("lower", lower).member("upper", upper).member("gap", judged->regret);
  json.member("basis", "model").null_member("confidence");
  json.key("assumptions").begin_array().end_array().end_object();
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
