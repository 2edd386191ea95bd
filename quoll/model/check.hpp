#pragma once
// Lint for models: what a careful reader would ask about before trusting an answer.

#include <cstdint>
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
  std::uint64_t line = 0;          ///< of the first one in its file; 0 = not known
};

/// Every reason why Mdp::make would refuse these arrays, one Finding per kind in the order of the
/// arrays; each sentence begins with what is wrong at the first place. Empty = a valid model.
/// If the arrays do not fit together ("shape"), that is the only finding.
std::vector<Finding> check_arrays(const MdpArrays& arrays);

/// The first of them, as make() reports it: false = none.
bool first_fault(const MdpArrays& arrays, Error& error);

/// Findings about a valid model: "no-end", "gaining-cycle" (errors, at discount 1:
/// undiscounted_fault), "unreachable", "dead-end" (reached states from which no end can be reached,
/// if there are ends), "duplicate" and "remark" (the reader's remarks), "underflow" (a reward at
/// the end of the longest shortest path to an end, or from the start if there is none, counts less
/// than the smallest normal float).
std::vector<Finding> check(const Mdp& mdp);

}  // namespace quoll
