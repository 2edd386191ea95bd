#pragma once
// What is learned, how, and by which network, above what came of it.

#include <string>

#include "quoll/experiment/run.hpp"

namespace quoll::cli {

/// One line, of networks two.
std::string learn_heading(const Run& run);

/// A line if it is a network that no seed has changed yet, else nothing.
std::string unchanged_line(const Run& run);

}  // namespace quoll::cli
