#include "quoll/cli/certificate.hpp"

#include <fmt/format.h>

#include <chrono>
#include <limits>

#include "quoll/base/json.hpp"
#include "quoll/base/text.hpp"
#include "quoll/model/digest.hpp"
#include "quoll/verify/certificate.hpp"
#include "quoll/verify/verify.hpp"

namespace quoll::cli {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// A certificate that was checked against a model.
struct Checked {
  const World& world;
  const std::string& file;
  const Certificate& certificate;
  Verdict verdict;
  bool same_model = false;
  double seconds = 0.0;  ///< the check alone, without reading

  const Mdp& mdp() const { return *world.mdp; }
  Proved proof() const { return proved(mdp(), certificate.lower, certificate.upper); }
};

Result<World> open_world(const WorldOption& option, const ExploreOption& explore,
                         const Certificate& certificate) {
  const Result<WorldSource> source = option.source();
  if (!source) return source.error();
  if (source->parameters.empty() && !certificate.parameters.empty()) {
    // A certificate of another world may name parameters that this one does not have.
    const WorldSource said{source->name, certificate.parameters};
    Result<World> world = explore.with_model(find_world(said.name, said.parameters), said);
    if (world) return world;
  }
  return explore.open(option);
}

Result<Checked> check(OpenCertificate& open, const World& world) {
  Result<Verdict> fits = read_claims(open, *world.mdp);
  if (!fits) return fits.error();
  const Certificate& content = open.content;
  Checked checked{world, open.path, content, std::move(*fits)};
  checked.same_model = content.digest == digest(*world.mdp);
  if (!checked.verdict.accepted) return checked;
  const auto begun = std::chrono::steady_clock::now();
  Result<Verdict> verdict = verify(*world.mdp, content.lower, content.upper, content.policy,
                                   content.discount, content.maximise);
  checked.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  if (!verdict) return verdict.error();
  checked.verdict = std::move(*verdict);
  return checked;
}

void write_proof(JsonWriter& json, const Checked& checked) {
  const Proved proof = checked.proof();
  json.key("start").begin_object();
  json.member("lower", proof.start_lower).member("upper", proof.start_upper).end_object();
  json.member("gap", proof.gap);
  json.member("worst", checked.mdp().state_name(proof.widest)).member("silent", proof.silent);
  json.member("basis", "model");
}

void write_violation(JsonWriter& json, const Checked& checked) {
  const Verdict& verdict = checked.verdict;
  std::optional<std::string> state, action;
  if (verdict.state) state = checked.mdp().state_name(*verdict.state);
  if (verdict.choice) action = checked.mdp().action_name(*verdict.choice);
  json.member("state", state);
  json.member("action", action);
  json.member("claimed", verdict.claimed);
  json.member("found", verdict.found);
}

std::string checked_json(const Checked& checked) {
  const Certificate& certificate = checked.certificate;
  const Verdict& verdict = checked.verdict;
  JsonWriter json(JsonStyle::pretty);
  json.begin_object();
  json.member("world", checked.world.name).member("file", checked.file);
  json.member("method", certificate.method).member("discount", certificate.discount);
  json.member("objective", certificate.maximise ? "maximise" : "minimise");
  json.member("same_model", checked.same_model).member("seconds", checked.seconds);
  json.member("accepted", verdict.accepted);
  if (verdict.accepted) {
    json.null_member("reason");
    write_proof(json, checked);
  } else {
    json.member("reason", verdict.reason);
    write_violation(json, checked);
  }
  json.end_object();
  return json.text() + "\n";
}

std::string start_text(const Proved& proof) {
  if (proof.start_lower == proof.start_upper) return "exactly " + shortest(proof.start_lower);
  return "between " + shortest(proof.start_lower) + " and " + shortest(proof.start_upper);
}

std::string accepted_text(const Checked& checked) {
  const Certificate& certificate = checked.certificate;
  const Proved proof = checked.proof();
  std::string text = fmt::format(
      "accepted  {}   discount {}, {}: the bounds of {} and the policy hold in every state, "
      "checked "
      "independently\nstart value {}; ",
      checked.world.name, shortest(certificate.discount),
      certificate.maximise ? "largest reward" : "least cost",
      certificate.method.empty() ? "the certificate" : certificate.method, start_text(proof));
  if (proof.gap == 0.0) {
    text += proof.silent == 0 ? "the policy is optimal" : "the policy loses nothing";
  } else if (proof.gap == unbounded) {
    text += "what the policy can lose has no bound";
  } else {
    text += "no state of this policy loses more than " + shortest(proof.gap);
  }
  if (proof.gap > 0.0) text += " (at " + checked.mdp().state_name(proof.widest) + ")";
  if (proof.silent > 0)
    text +=
        fmt::format(", apart from {} of which nothing is claimed", counted(proof.silent, "state"));
  text += "\n";
  if (!checked.same_model) {
    text += "the certificate was written for another model, but what it says holds for this one\n";
  }
  return text;
}

std::string refused_text(const Checked& checked) {
  std::string text = "refused  " + checked.verdict.reason + "\n";
  if (!checked.same_model) {
    text += "the certificate was written for another model";
    if (!checked.certificate.world.empty()) text += ", called " + checked.certificate.world;
    text += "\n";
  }
  return text;
}

}  // namespace

Result<void> write_certificate(const std::string& file, const World& world,
                               const Solution& solution, bool maximise, const std::string& input) {
  Certificate certificate{.world = world.name,
                          .parameters = world.parameters,
                          .digest = digest(*world.mdp),
                          .discount = solution.discount,
                          .maximise = maximise,
                          .method = solution.method,
                          .lower = solution.lower,
                          .upper = solution.upper,
                          .policy = solution.policy};
  // Who gains for ever never ends; a certificate speaks of policies that end, and leaves it open.
  for (double& bound : maximise ? certificate.lower : certificate.upper) {
    if (bound == (maximise ? unbounded : -unbounded)) bound = -bound;
  }
  const Result<std::string> text = certificate_text(certificate, *world.mdp);
  return text ? write_output(file, *text, {input}) : text.error();
}

Exit verify_certificate(const WorldOption& option, const ExploreOption& explore,
                        const std::string& file, bool json) {
  Result<OpenCertificate> open = open_certificate(file);
  if (!open) return fail(open.error());
  const Result<World> world = open_world(option, explore, open->content);
  if (!world) return fail(world.error());
  const Result<Checked> checked = check(*open, *world);
  if (!checked) return fail(checked.error());
  const bool accepted = checked->verdict.accepted;
  const std::string text = json       ? checked_json(*checked)
                           : accepted ? accepted_text(*checked)
                                      : refused_text(*checked);
  if (!print(text)) return user_error;
  return accepted ? done : refused;
}

}  // namespace quoll::cli
