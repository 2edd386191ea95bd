#pragma once
// What can be asked of a race.

#include <cstdint>
#include <limits>
#include <string>

#include "quoll/cli/common.hpp"
#include "quoll/experiment/race.hpp"

namespace quoll::cli {

struct RaceSettings {
  std::string methods;
  RaceMode mode = RaceMode::start;
  std::uint64_t seeds = 30;
  std::uint64_t seed = 1;
  double discount = 0.0;
  std::string from;
  std::uint64_t cap_steps = 50'000'000;
  double cap_seconds = 10.0;

  void describe(Describer& d) {
    d("methods", methods,
      "who runs against the lecture's method: METHOD or METHOD:key=value:key=value, separated by "
      "commas; without it every method");
    d.choice("mode", mode, race_mode_names,
             "from which states a policy must be good: from all, any of which may be chosen as a "
             "start, or from the start alone");
    d("seeds", seeds, 1, 1e6, "how many seeds each entrant runs, from --seed on");
    d("seed", seed, "which random numbers");
    d("discount", discount, std::numeric_limits<double>::denorm_min(), 1,
      "discount factor of the future; without it the world's own");
    d("from", from, "the state every episode begins in, instead of the world's start");
    d("cap_steps", cap_steps, 1, 1e15, "steps after which a seed has failed");
    d("cap_seconds", cap_seconds, 0, 1e9,
      "processor seconds after which a seed has failed; 0 = no such limit");
  }
};

struct RaceOptions {
  WorldOption world;
  OutputOption output;
  GivenSettings given;
  bool suite = false;
  unsigned threads = 0;
};

/// Runs a suite of races; exit 2 when it was interrupted.
Exit race_suite(const RaceOptions& options, const RaceSettings& settings);

}  // namespace quoll::cli
