#pragma once
// Certificates on the command line: solve writes them, verify judges them.

#include <string>

#include "quoll/cli/common.hpp"
#include "quoll/cli/explored.hpp"
#include "quoll/cli/verb.hpp"
#include "quoll/env/world.hpp"
#include "quoll/model/solution.hpp"

namespace quoll::cli {

/// Writes what a solution of the world's model claims, never over `input`, the file of the world.
Result<void> write_certificate(const std::string& file, const World& world,
                               const Solution& solution, bool maximise, const std::string& input);

/// Checks a certificate against a model, and prints what is proved or the first state that violates
/// it. A world without parameters on the command line is opened with those of the certificate.
Exit verify_certificate(const WorldOption& world, const ExploreOption& explore,
                        const std::string& file, bool json);

}  // namespace quoll::cli
