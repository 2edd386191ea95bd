#include "quoll/cli/judged_run.hpp"

#include <algorithm>

#include "quoll/solve/solver.hpp"

namespace quoll::cli {

std::string rule_words(const LearnerEntry& entry) {
  return entry.rule.empty() ? std::string(entry.method) : "rule " + std::string(entry.rule);
}

void write_rule(JsonWriter& json, const LearnerEntry& entry) {
  if (entry.rule.empty())
    json.null_member("rule");
  else
    json.member("rule", entry.rule);
}

std::string unsound(const Run& run) {
  if (run.entry().sound) return "";
  return "the rule " + run.settings().learn.rule +
         " never looks at the rewards it receives, so its values estimate nothing; learn with "
         "--rule standard";
}

std::string no_table(const Run& run) {
  if (!run.entry().traits.approximates) return "";
  if (!run.trainings().front().learner().estimates().row_begin.empty()) return "";
  return run.settings().learn.method +
         " learned a function of what is observed, no table of states; play and evaluate take such "
         "a run, and show its curve";
}

Result<JudgedRun> judge_run(const Run& run, std::size_t begin, std::size_t count) {
  const Mdp* mdp = run.world().mdp.get();
  if (mdp == nullptr) {
    return Error{"", 0, 0, "no certificate: the model of " + run.world().name + " is not known",
                 ""};
  }
  const Result<LearnSetup> setup = resolve(run.settings().learn, run.world());
  if (!setup) return setup.error();
  SolveSettings settings;
  settings.discount = run.discount();
  settings.width = 1e-9;
  Result<Solution> exact = solve(*mdp, settings);
  if (!exact) return exact.error();
  Result<Verdict> verdict = verify(*mdp, exact->lower, exact->upper, exact->policy, run.discount());
  if (!verdict) return verdict.error();
  JudgedRun judged{std::move(*exact), std::move(*verdict), {}};
  const std::size_t end = begin + std::min(count, run.trainings().size() - begin);
  for (std::size_t i = begin; i < end; ++i) {
    const Training& training = run.trainings()[i];
    JudgedSeed seed;
    seed.seed = training.seed();
    seed.steps = training.learner().progress().steps;
    seed.policy = greedy_policy(training.learner().estimates());
    seed.optimality =
        judge(*mdp, judged.exact, seed.policy, setup->starts.states(), run.discount());
    judged.seeds.push_back(std::move(seed));
  }
  return judged;
}

}  // namespace quoll::cli
