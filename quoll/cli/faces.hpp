#pragma once
// The program's options in the forms that shells and readers want, made from the verbs' own lists.

#include <string>

namespace quoll::cli {

/// A completion script for bash: verbs, flags, the words a flag takes, files.
std::string bash_completion();

/// The manual page quoll(1) in roff.
std::string manual_page();

}  // namespace quoll::cli
