// quoll export RUN --to c|json|csv|moves|onnx|safetensors: the policy of a saved run, or its
// network, for other programs.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/export_targets.hpp"
#include "quoll/cli/judged_run.hpp"
#include "quoll/cli/policy_file.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/env/listed.hpp"
#include "quoll/report/export_map.hpp"

namespace quoll::cli {
namespace {

struct ExportOptions {
  std::string run;
  std::string to;
  std::string file;
  std::string name;
  std::string seed;  // empty = the first
};

template <std::string (*write)(const PolicyExport&)>
Result<std::string> always(const PolicyExport& policy) {
  return write(policy);
}
Result<std::string> moves(const PolicyExport& policy) {
  return moves_csv({policy.mdp, policy.policy, {}});
}
constexpr std::array<ExportTarget, 6> targets{
    {{"c", ".h", "a header for C99 and C++ that checks itself: a table of moves, or a network",
      always<policy_c>, network_c},
     {"json", ".json", "the move of each state, and what is proved of them", always<policy_json>,
      nullptr},
     {"csv", ".csv", "the move of each state: state,action", always<policy_csv>, nullptr},
     {"moves", "", "the moves of a grid with their places: x,y,state,move", moves, nullptr},
     {"onnx", ".onnx", "a network with everything around it, from what is observed to Q", nullptr,
      network_onnx},
     {"safetensors", ".safetensors", "the numbers of a network by name, as PyTorch lays them out",
      nullptr, network_safetensors}}};

/// By --to, else by the ending of -o.
Result<const ExportTarget*> find_target(const ExportOptions& options) {
  Nearest nearest(options.to);
  for (const ExportTarget& target : targets) {
    nearest.offer(target.name);
    if (options.to == target.name) return &target;
    if (options.to.empty() && !target.extension.empty() &&
        options.file.ends_with(target.extension)) {
      return &target;
    }
  }
  if (options.to.empty()) {
    return Error{
        "--to", 0, 0,
        "c, json, csv, onnx or safetensors expected, or -o with a name in .h, .json, .csv, "
        ".onnx or .safetensors",
        ""};
  }
  return Error{"--to", 0, 0,
               "c, json, csv, moves, onnx or safetensors expected, not '" + options.to + "'",
               nearest.best()};
}

/// Which of the run's seeds is wanted.
Result<std::size_t> find_seed(const ExportOptions& options, const Run& run) {
  if (options.seed.empty()) return std::size_t{0};
  const auto seed = parse_count(options.seed);
  const std::vector<Training>& trainings = run.trainings();
  for (std::size_t i = 0; seed && i < trainings.size(); ++i) {
    if (trainings[i].seed() == *seed) return i;
  }
  return Error{"--seed", 0, 0,
               fmt::format("{} to {} expected, the seeds of this run, not '{}'",
                           trainings.front().seed(), trainings.back().seed(), options.seed),
               ""};
}

std::string learned_by(const Run& run, const Training& training) {
  const LearnSettings& learn = run.settings().learn;
  return fmt::format("Learned by {}{}, discount {}, seed {}, {} steps.", learn.method,
                     run.entry().rule.empty() ? "" : ", " + rule_words(run.entry()),
                     shortest(run.discount()), training.seed(),
                     grouped(training.learner().progress().steps));
}

/// What the head of the file says about the policy.
Result<std::vector<std::string>> origin(const Run& run, const Training& training,
                                        const JudgedRun& judged) {
  const JudgedSeed& seed = judged.seeds.front();
  std::vector<std::string> lines{learned_by(run, training)};
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

Result<std::string> policy_text(const ExportOptions& options, const ExportTarget& target,
                                const Run& run, std::size_t index) {
  const Training& training = run.trainings()[index];
  const Result<std::shared_ptr<const Mdp>> states = listed(run.world());
  if (!states) return Error{run_file(options.run), 0, 0, states.error().expected, ""};
  PolicyExport policy;
  policy.mdp = states->get();
  policy.name = options.name.empty() ? run.world().name : options.name;
  const Result<JudgedRun> judged = judge_run(run, index, 1);
  std::vector<Action> actions;
  if (judged) {
    actions = judged->seeds.front().policy;
    const Result<std::vector<std::string>> lines = origin(run, training, *judged);
    if (!lines) return lines.error();
    policy.origin = *lines;
  } else {
    actions = greedy_policy(training.learner().estimates());
    policy.origin = {learned_by(run, training),
                     run.world().mdp ? "No certificate: " + message(judged.error()) + "."
                                     : "No certificate: the model is not known."};
  }
  policy.policy = actions;
  return target.policy(policy);
}

Result<std::string> network_text(const ExportOptions& options, const ExportTarget& target,
                                 const Run& run, const Training& training) {
  Result<NetworkExport> what = network_export(run.world(), training.learner().network());
  if (!what) {
    return Error{run_file(options.run), 0, 0, "not exported: " + what.error().expected, ""};
  }
  if (!options.name.empty()) what->name = options.name;
  what->method = run.settings().learn.method;
  what->discount = run.discount();
  what->origin = {learned_by(run, training)};
  return target.network(*what);
}

/// Why this run cannot be written so, and how it can; "" = it can.
std::string refused(const Run& run, const Training& training, const ExportTarget& target) {
  const std::string missing = no_table(run);
  const bool network = training.learner().network() != nullptr;
  const LearnProgress::Halt halt = training.learner().progress().halt;
  if (network && halt == LearnProgress::Halt::diverged) {
    return "its values have left every bound";
  }
  if (network && target.network != nullptr) return "";
  if (missing.empty() && target.policy != nullptr) return "";
  const std::string& method = run.settings().learn.method;
  if (missing.empty()) {
    return fmt::format(
        "{} learned a table, no network; --to c, json, csv or moves expected, not '{}'", method,
        target.name);
  }
  if (network) return missing + "; --to c, onnx or safetensors expected";
  if (target.policy != nullptr) return missing;
  return method + " learned a function that is no network; play and evaluate take such a run";
}

Result<Exported> exported(const ExportOptions& options, const ExportTarget& target) {
  const std::string file = run_file(options.run);
  const Result<Run> run = Run::load(file, false);
  if (!run) return run.error();
  const std::string reason = unsound(*run);
  if (!reason.empty()) return Error{file, 0, 0, "not exported: " + reason, ""};
  const Result<std::size_t> index = find_seed(options, *run);
  if (!index) return index.error();
  const Training& training = run->trainings()[*index];
  const std::string refusal = refused(*run, training, target);
  if (!refusal.empty()) return Error{file, 0, 0, "not exported: " + refusal, ""};
  // Where states are numbered a table says it all.
  const bool as_policy = target.policy != nullptr && no_table(*run).empty();
  Result<std::string> text = as_policy ? policy_text(options, target, *run, *index)
                                       : network_text(options, target, *run, training);
  if (!text) return text.error();
  return Exported{std::move(*text), run->source().name};
}

Exit export_run(const ExportOptions& options) {
  const Result<const ExportTarget*> target = find_target(options);
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

std::span<const ExportTarget> export_targets() {
  return targets;
}

void declare_export(Options& options) {
  auto given = std::make_shared<ExportOptions>();
  options.word("run", given->run, "a saved run: run.quoll, or the folder of a run");
  options.option("--to", &given->to, "c | json | csv | moves | onnx | safetensors",
                 "what to write; moves: x,y,state,move of a grid; onnx, safetensors: a network; "
                 "without: by the name of -o");
  options.option("-o,--output", &given->file, "FILE", "the file to write; without: on stdout");
  options.option("--seed", &given->seed, "N", "which of the run's seeds; without: the first one");
  options.option("--name", &given->name, "NAME",
                 "what the C names begin with; without: the world's name");
  options.run([given] { return export_run(*given); });
}

}  // namespace quoll::cli
