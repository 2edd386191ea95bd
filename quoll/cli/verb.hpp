#pragma once
// One verb of the program: a name, a sentence, and a function that declares its options and what
// runs. The registry in verbs.cpp is the list that help, completion and the manual page are made
// from.

#include <span>
#include <string_view>

#include "quoll/cli/options.hpp"

namespace quoll::cli {

/// Exit statuses (docs/design.md, section 7).
enum Exit : int { done = 0, user_error = 1, goal_missed = 2, refused = 3 };

struct Verb {
  std::string_view name;
  std::string_view summary;
  void (*declare)(Options& options);
};

std::span<const Verb> verbs();

}  // namespace quoll::cli
