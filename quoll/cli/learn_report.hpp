#pragma once
// What `learn` prints: for people, and as JSON (docs/json.md).

#include <string>

#include "quoll/cli/learn_explain.hpp"
#include "quoll/experiment/run.hpp"
#include "quoll/report/table.hpp"

namespace quoll::cli {

/// What is told besides the result.
struct LearnStory {
  bool all = false;                        ///< complete lists
  bool until_stable = false;               ///< --until stable was asked for
  bool until_return = false;               ///< --until return:R was
  bool bounded = false;                    ///< a limit or a goal was asked for
  const ComingUpdates* coming = nullptr;   ///< of --explain
  const StandardBeside* beside = nullptr;  ///< of the rule as-printed
};

/// Table or grid, verdict, curve, and what to do next.
std::string learn_text(const Run& run, const RunResult& result, const TerminalStyle& style,
                       const LearnStory& story);

/// One JSON object, with the updates of --explain if there are any.
std::string learn_json(const Run& run, const RunResult& result, const LearnStory& story);

/// Whether this seed was to become stable and did not.
bool missed_stable(const SeedResult& seed, const LearnStory& story);

/// A pair, and how often it was tried.
struct PairVisits {
  std::uint32_t visits = 0;
  State state = 0;
  Action action = 0;
};

/// The ten pairs that were tried least, of those reachable from the starts: what keeps a run from
/// being stable. Of the first seed that missed that goal; empty when none did, or without a model.
std::vector<PairVisits> least_visited(const Run& run, const RunResult& result,
                                      const LearnStory& story);

/// Q* per choice, or empty.
std::vector<double> q_star_all(const Mdp& mdp, const Solution& exact, double discount);

}  // namespace quoll::cli
