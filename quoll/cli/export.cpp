// quoll export RUN --to c|json|csv|moves: the policy of a saved run, for other programs.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/judged_run.hpp"
#include "quoll/cli/policy_file.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/env/listed.hpp"
#include "quoll/report/export_map.hpp"
#include "quoll/report/export_policy.hpp"

namespace quoll::cli {
namespace {

struct ExportOptions {
  std::string run;
  std::string to;
  std::string file;
  std::string name;
};

struct Target {
  std::string_view name, extension;  // none = only by name
  Result<std::string> (*write)(const PolicyExport& policy);
};
template <std::string (*write)(const PolicyExport&)>
Result<std::string> always(const PolicyExport& policy) {
  return write(policy);
}
Result<std::string> moves(const PolicyExport& policy) {
  return moves_csv({policy.mdp, policy.policy, {}});
}
constexpr std::array<Target, 4> targets{{{"c", ".h", always<policy_c>},
                                         {"json", ".json", always<policy_json>},
                                         {"csv", ".csv", always<policy_csv>},
                                         {"moves", "", moves}}};

/// By --to, else by the ending of -o.
Result<const Target*> find_target(const ExportOptions& options) {
  Nearest nearest(options.to);
  for (const Target& target : targets) {
    nearest.offer(target.name);
    if (options.to == target.name) return &target;
    if (options.to.empty() && !target.extension.empty() &&
        options.file.ends_with(target.extension)) {
      return &target;
    }
  }
  if (options.to.empty()) {
    return Error{"--to", 0, 0, "c, json or csv expected, or -o with a name in .h, .json or .csv",
                 ""};
  }
  return Error{"--to", 0, 0, "c, json, csv or moves expected, not '" + options.to + "'",
               nearest.best()};
}

std::string learned_by(const Run& run) {
  const LearnSettings& learn = run.settings().learn;
  const Training& first = run.trainings().front();
  return fmt::format("Learned by {}{}, discount {}, seed {}, {} steps.", learn.method,
                     run.entry().rule.empty() ? "" : ", " + rule_words(run.entry()),
                     shortest(run.discount()), first.seed(),
                     grouped(first.learner().progress().steps));
}

/// What the head of the file says about the policy.
Result<std::vector<std::string>> origin(const Run& run, const JudgedRun& judged) {
  const JudgedSeed& seed = judged.seeds.front();
  std::vector<std::string> lines{learned_by(run)};
  const Optimality& judgement = seed.optimality;
  const std::string_view answer = !judgement.optimal   ? "not decided"
                                  : *judgement.optimal ? "yes"
                                                       : "no";
  lines.push_back(fmt::format("Optimal: {} ({}).", answer, judgement.proof));
  if (!std::isfinite(judgement.regret)) {
    lines.push_back("No certificate: what this policy can lose has no bound.");
  } else if (judged.verdict.accepted) {
    lines.push_back(fmt::format("Certified: no state reachable from its starts loses more than {}.",
                                shortest(judgement.regret)));
  } else {
    lines.push_back("No certificate: the bounds do not hold: " + judged.verdict.reason + ".");
  }
  return lines;
}

struct Exported {
  std::string text;
  std::string world;  // the name of the world, perhaps a file's
};

Result<Exported> exported(const ExportOptions& options, const Target& target) {
  const std::string file = run_file(options.run);
  const Result<Run> run = Run::load(file, false);
  if (!run) return run.error();
  const std::string reason = unsound(*run);
  if (!reason.empty()) return Error{file, 0, 0, "not exported: " + reason, ""};
  const Result<std::shared_ptr<const Mdp>> states = listed(run->world());
  if (!states) return Error{file, 0, 0, states.error().expected, ""};
  PolicyExport policy;
  policy.mdp = states->get();
  policy.name = options.name.empty() ? run->world().name : options.name;
  const Result<JudgedRun> judged = judge_run(*run, 1);
  std::vector<Action> actions;
  if (judged) {
    actions = judged->seeds.front().policy;
    const Result<std::vector<std::string>> lines = origin(*run, *judged);
    if (!lines) return lines.error();
    policy.origin = *lines;
  } else {
    actions = greedy_policy(run->trainings().front().learner().estimates());
    policy.origin = {learned_by(*run), run->world().mdp
                                           ? "No certificate: " + message(judged.error()) + "."
                                           : "No certificate: the model is not known."};
  }
  policy.policy = actions;
  Result<std::string> text = target.write(policy);
  if (!text) return text.error();
  return Exported{std::move(*text), run->source().name};
}

Exit export_policy(const ExportOptions& options) {
  const Result<const Target*> target = find_target(options);
  if (!target) return fail(target.error());
  const Result<Exported> out = exported(options, **target);
  if (!out) return fail(out.error());
  if (options.file.empty()) return print(out->text) ? done : user_error;
  const Result<void> written =
      write_output(options.file, out->text, {run_file(options.run), out->world});
  if (!written) return fail(written.error());
  return done;
}

}  // namespace

void declare_export(Options& options) {
  auto given = std::make_shared<ExportOptions>();
  options.word("run", given->run, "a saved run: run.quoll, or the folder of a run");
  options.option("--to", &given->to, "c | json | csv | moves",
                 "what to write; moves: x,y,state,move of a grid; without: by the name of -o");
  options.option("-o,--output", &given->file, "FILE", "the file to write; without: on stdout");
  options.option("--name", &given->name, "NAME",
                 "what the C names begin with; without: the world's name");
  options.run([given] { return export_policy(*given); });
}

}  // namespace quoll::cli
