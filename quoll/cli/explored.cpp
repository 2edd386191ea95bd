#include "quoll/cli/explored.hpp"

#include <chrono>

#include "quoll/base/text.hpp"
#include "quoll/env/explore.hpp"

namespace quoll::cli {
namespace {

bool aimed(const WorldSource& source) {
  for (const auto& [key, value] : source.parameters) {
    if (key.starts_with("--")) return true;
  }
  return false;
}

}  // namespace

void ExploreOption::declare(Options& options, bool always) {
  const std::string most = std::to_string(ExploreSettings().max_states);
  options.option("--max-states", &max_states, "N",
                 always ? "of a world described by code: list at most so many states [" + most + "]"
                        : "of a world described by code: list its states, at most so many, for an "
                          "exact answer");
}

Result<World> ExploreOption::with_model(Result<World> opened, const WorldSource& source,
                                        bool quiet) const {
  ExploreSettings settings;
  if (given()) {
    const std::optional<std::uint64_t> number = parse_count(max_states);
    if (!number || *number == 0 || *number > quoll::max_states) {
      return Error{"--max-states", 0, 0,
                   "a whole number from 1 to " + grouped(quoll::max_states) + " expected, not '" +
                       max_states + "'",
                   ""};
    }
    settings.max_states = *number;
  }
  // A goal in a world without a model is an error, which here it need not be.
  if (opened ? opened->mdp != nullptr : !aimed(source)) return opened;
  ProgressDisplay display(quiet, "states");
  const auto begun = std::chrono::steady_clock::now();
  settings.progress = [&](std::uint64_t found, std::uint64_t open) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun;
    display.show(found, 0, spent.count(), grouped(open) + " of them not yet gone through");
  };
  return find_explored(source.name, source.parameters, settings);
}

Result<World> ExploreOption::open(const WorldOption& world) const {
  const Result<WorldSource> source = world.source();
  if (!source) return source.error();
  return with_model(world.open(), *source);
}

}  // namespace quoll::cli
