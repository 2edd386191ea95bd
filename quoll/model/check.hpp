#pragma once
// Lint for models: what a careful reader would ask about before trusting an answer.

#include <string>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

struct Finding {
  enum class Severity : std::uint8_t { warning, error } severity;
  std::string kind;      ///< stable key: "unreachable", "dead-end", "row-sum", "duplicate", ...
  std::string sentence;  ///< for people, with names; ends with how many more there are
  std::uint64_t count = 1;
  std::vector<std::string> names;  ///< up to 10 states or moves concerned
};

/// Findings about a valid model: unreachable states, dead ends (no actions, not declared terminal is
/// an end by definition; a dead end is a state that cannot reach any end), duplicate moves, a discount
/// that underflows on the longest shortest path from the start, undefined undiscounted values.
std::vector<Finding> check(const Mdp& mdp);

}  // namespace quoll
