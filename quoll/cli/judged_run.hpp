#pragma once
// A saved run judged from its file: its policy, and what that policy can lose at most.

#include <string>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/base/json.hpp"
#include "quoll/experiment/run.hpp"
#include "quoll/model/solution.hpp"
#include "quoll/solve/optimality.hpp"
#include "quoll/verify/verify.hpp"

namespace quoll::cli {

/// The reason why a run may be neither certified nor exported; empty = it may.
std::string unsound(const Run& run);

/// Why this run has no table of states, or "" when it has.
std::string no_table(const Run& run);

/// "rule standard", or the method where that has no choice of rules.
std::string rule_words(const LearnerEntry& entry);
/// The member "rule" of a JSON object: null where the method has no choice of rules.
void write_rule(JsonWriter& json, const LearnerEntry& entry);

/// One seed's policy, greedy among the actions it visited.
struct JudgedSeed {
  std::uint64_t seed = 0, steps = 0;
  std::vector<Action> policy;
  Optimality optimality;
};

struct JudgedRun {
  Solution exact;
  Verdict verdict;  ///< of the independent checker about `exact`
  std::vector<JudgedSeed> seeds;
};

/// Solves the run's model once, has the answer checked independently, and judges the policies of
/// `count` of its seeds, from the one at `begin` on, on the states reachable from its starts.
/// Error: no model, values not defined, or a setting that does not resolve.
Result<JudgedRun> judge_run(const Run& run, std::size_t begin, std::size_t count);

}  // namespace quoll::cli
