#pragma once
// What is learned, how, and by which network, above what came of it.

#include <string>

#include "quoll/experiment/run.hpp"

namespace quoll::cli {

/// One line, of networks two.
std::string learn_heading(const Run& run);

}  // namespace quoll::cli
