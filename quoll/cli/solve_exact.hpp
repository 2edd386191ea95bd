#pragma once
// quoll solve --exact: the answer as fractions, and how it is told.

#include <cstdint>
#include <optional>
#include <string>

#include "quoll/base/error.hpp"
#include "quoll/base/json.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/model/solution.hpp"
#include "quoll/solve/rational_solver.hpp"

namespace quoll::cli {

/// Proves the policy of `solution` optimal, or improves it until it is, with progress on stderr;
/// nothing if interrupted. Error: see solve_in_rationals(), and a value outside its bounds.
Result<std::optional<RationalSolution>> prove_exactly(const Mdp& mdp, const Solution& solution,
                                                      bool maximise, bool quiet);

/// One line per state, of the first `states`: value, fraction, action.
std::string exact_table(const Mdp& mdp, const RationalSolution& exact, std::uint64_t states);

/// What was proved, in one line.
std::string exact_verdict(const Mdp& mdp, const RationalSolution& exact);

/// "exact": {"start", "switched", "values"}.
void write_exact(JsonWriter& json, const Mdp& mdp, const RationalSolution& exact, bool all);

}  // namespace quoll::cli
