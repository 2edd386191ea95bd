#pragma once
// What `learn` prints: for people, and as JSON (docs/json.md).

#include <string>

#include "quoll/cli/learn_explain.hpp"
#include "quoll/experiment/run.hpp"
#include "quoll/report/table.hpp"

namespace quoll::cli {

/// Table or grid, verdict, curve, and what to do next.
std::string learn_text(const Run& run, const RunResult& result, const TerminalStyle& style,
                       bool all);

/// One JSON object, with the updates of --explain if there are any.
std::string learn_json(const Run& run, const RunResult& result, bool all,
                       const ComingUpdates* coming = nullptr);

/// Q* per choice, or empty.
std::vector<double> q_star_all(const Mdp& mdp, const Solution& exact, double discount);

}  // namespace quoll::cli
