// quoll verify WORLD FILE: a certificate, or what the policy of a saved run can lose at most,
// checked independently.

#include "quoll/verify/verify.hpp"

#include <fmt/format.h>

#include <cmath>

#include "quoll/base/json.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/certificate.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/judged_run.hpp"
#include "quoll/cli/policy_file.hpp"
#include "quoll/cli/same_world.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/verify/certificate.hpp"

namespace quoll::cli {
namespace {

struct VerifyOptions {
  WorldOption world;
  ExploreOption explore;
  std::string file;
  bool json = false;
};

/// What became of a verification: a reason to refuse, or a judged run.
struct Outcome {
  std::string refusal;
  std::optional<JudgedRun> judged;
};

Result<Outcome> examine(const Run& run) {
  Outcome outcome;
  outcome.refusal = unsound(run);
  if (!outcome.refusal.empty()) return outcome;
  Result<JudgedRun> judged = judge_run(run, 0, run.trainings().size());
  if (!judged) return judged.error();
  if (!judged->verdict.accepted) {
    outcome.refusal = "the bounds do not hold: " + judged->verdict.reason;
  }
  outcome.judged = std::move(*judged);
  return outcome;
}

std::string verify_json(const Run& run, const Outcome& outcome, const std::string& file) {
  JsonWriter json(JsonStyle::pretty);
  json.begin_object();
  json.member("world", run.world().name).member("file", file);
  json.member("method", run.settings().learn.method);
  write_rule(json, run.entry());
  json.member("discount", run.discount()).member("accepted", outcome.refusal.empty());
  if (outcome.refusal.empty())
    json.null_member("reason");
  else
    json.member("reason", outcome.refusal);
  json.key("runs").begin_array();
  if (outcome.judged && outcome.refusal.empty()) {
    for (const JudgedSeed& seed : outcome.judged->seeds) {
      json.begin_object().member("seed", seed.seed).member("steps", seed.steps);
      if (seed.optimality.optimal)
        json.member("optimal", *seed.optimality.optimal);
      else
        json.null_member("optimal");
      json.member("proof", seed.optimality.proof).member("regret", seed.optimality.regret);
      json.member("worst", run.world().mdp->state_name(seed.optimality.worst));
      json.member("unreachable", seed.optimality.unreachable).end_object();
    }
  }
  json.end_array().end_object();
  return json.text() + "\n";
}

std::string verify_text(const Run& run, const JudgedRun& judged) {
  std::string text = fmt::format(
      "accepted  {}   {}, discount {}: the bounds of the exact answer ({}) hold, checked "
      "independently\n",
      run.world().name, rule_words(run.entry()), shortest(run.discount()), judged.exact.method);
  for (const JudgedSeed& seed : judged.seeds) {
    const Optimality& judgement = seed.optimality;
    text += fmt::format("seed {}, {}: optimal {} ({})", seed.seed, counted(seed.steps, "step"),
                        !judgement.optimal   ? "not decided"
                        : *judgement.optimal ? "yes"
                                             : "no",
                        judgement.proof);
    text += std::isfinite(judgement.regret)
                ? "; no state loses more than " + number_text(judgement.regret)
                : std::string("; what it can lose has no bound");
    if (judgement.regret > 0.0) {
      text += " (at " + run.world().mdp->state_name(judgement.worst) + ")";
    }
    if (judgement.unreachable > 0) {
      text += fmt::format("; {} states cannot be reached and are left out",
                          grouped(judgement.unreachable));
    }
    text += "\n";
  }
  return text;
}

Exit verify(const VerifyOptions& options) {
  if (is_certificate(options.file)) {
    return verify_certificate(options.world, options.explore, options.file, options.json);
  }
  const Result<World> world = options.world.open();
  if (!world) return fail(world.error());
  const std::string file = run_file(options.file);
  const Result<Run> run = Run::load(file, false);
  if (!run) return fail(run.error());
  if (!world->mdp) return fail({"", 0, 0, "the model of " + world->name + " is not known", ""});
  if (const Result<void> same = check_same_world(*run, file, *world); !same) {
    return fail(same.error());
  }
  const Result<Outcome> outcome = examine(*run);
  if (!outcome) return fail(outcome.error());
  const bool accepted = outcome->refusal.empty();
  const std::string text = options.json ? verify_json(*run, *outcome, file)
                           : accepted   ? verify_text(*run, *outcome->judged)
                                        : "refused  " + outcome->refusal + "\n";
  if (!print(text)) return user_error;
  return accepted ? done : refused;
}

}  // namespace

void declare_verify(Options& options) {
  auto given = std::make_shared<VerifyOptions>();
  given->world.declare(options);
  given->explore.declare(options);
  options.word("file", given->file,
               "a certificate of solve, or a saved run: run.quoll, or the folder of a run");
  options.flag("--json", &given->json, "print one JSON object on stdout");
  options.run([given] { return verify(*given); });
}

}  // namespace quoll::cli
