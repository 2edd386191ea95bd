#pragma once
// The worlds that methods are compared in.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "quoll/env/world.hpp"

namespace quoll {

/// One world of a suite.
struct SuiteWorld {
  std::string_view name;   ///< of its rows, files and pictures
  std::string_view world;  ///< as find_world takes it
  std::string_view with;   ///< key=value, separated by blanks
  std::string_view goal;   ///< --goal, or empty
  std::string_view from;   ///< the state every episode begins in; empty = the world's own start
  double discount;
  std::uint64_t most_seeds;
  std::string_view note;  ///< for the reader, or empty
};

struct Suite {
  std::string_view name;
  std::string_view title;
  std::span<const SuiteWorld> worlds;
};

/// standard: the worlds the methods' settings were chosen with; fresh: worlds never used for that.
std::span<const Suite> suites();
const Suite* find_suite(std::string_view name);

/// The world of a row, beginning where the row says.
Result<World> open_world(const SuiteWorld& row);

/// What is typed after `quoll race` to run that row alone.
std::string command_of(const SuiteWorld& row);

}  // namespace quoll
