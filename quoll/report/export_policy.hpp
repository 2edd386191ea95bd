#pragma once
// A policy as plain data for other programs: JSON, CSV, and a C header that needs nothing.

#include <span>
#include <string>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

/// A policy and where it comes from.
struct PolicyExport {
  const Mdp* mdp = nullptr;
  std::span<const Action> policy;   ///< per state; no_action for ends and states never seen
  std::string name;                 ///< of the world; a C identifier is made from it
  std::vector<std::string> origin;  ///< sentences for the head of the file, one line each
};

/// "state,action" and one row per state that has an action, names quoted where they must be.
std::string policy_csv(const PolicyExport& policy);

/// {"world", "origin", "policy": [{"state", "action"}]}, complete.
std::string policy_json(const PolicyExport& policy);

/// More states than this, and a C header carries numbers only.
inline constexpr std::uint64_t c_names_limit = 100'000;

/// A header for C99 and C++: NAME_action(state) gives the number of the action among all action
/// names, or -1. Compiled with QUOLL_SELF_TEST it is a program that checks itself on up to 64
/// states and returns 0. One byte per state up to 254 action names.
std::string policy_c(const PolicyExport& policy);

}  // namespace quoll
