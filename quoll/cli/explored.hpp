#pragma once
// Worlds described by code for the verbs that need a model: their states are listed.

#include <string>

#include "quoll/cli/common.hpp"

namespace quoll::cli {

/// --max-states.
struct ExploreOption {
  std::string max_states;

  /// `always`: the verb lists states without being asked to.
  void declare(Options& options, bool always = true);
  bool given() const { return !max_states.empty(); }
  /// The world that was opened from `source`, with a model; an error if there can be none. Shows
  /// progress on stderr unless `quiet`.
  Result<World> with_model(Result<World> opened, const WorldSource& source,
                           bool quiet = false) const;
  /// The same of what a command line says.
  Result<World> open(const WorldOption& world) const;
};

}  // namespace quoll::cli
