#pragma once
// Races: how many steps and seconds until the policy is within 1 % of optimal, over many seeds.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "quoll/env/world.hpp"
#include "quoll/experiment/entrant.hpp"
#include "quoll/experiment/heat.hpp"
#include "quoll/experiment/referee.hpp"

namespace quoll {

/// The step after `step` at which the referee looks: the next one, or 7 % later.
std::uint64_t next_checkpoint(std::uint64_t step);

/// What one heat may take.
struct HeatCaps {
  std::uint64_t steps = 50'000'000;
  double seconds = 0.0;  ///< processor time of the learner; 0 = no limit
};

/// Runs one entrant with one seed until its greedy policy is good at two successive checkpoints;
/// the first of the two is the figure. Seconds are processor seconds of this thread inside
/// Learner::advance() and of one call of estimates(); below 20 ms they are measured once more, in
/// one piece. `keep_going` is asked every few milliseconds. Error: settings this world cannot take.
Result<Heat> run_heat(const LearnSettings& settings, const World& world, const Referee& referee,
                      RaceMode mode, const HeatCaps& caps,
                      const std::function<bool()>& keep_going = {});

/// A race in one world.
struct RacePlan {
  const World* world = nullptr;
  const Referee* referee = nullptr;
  RaceMode mode = RaceMode::start;
  std::uint64_t seeds = 30, first_seed = 1;
  HeatCaps caps;
  unsigned threads = 0;  ///< 0 = all processors; changes no step
};

/// What happens meanwhile; all may be empty. Called by one thread at a time.
struct RaceHooks {
  /// A heat that was run before, or nullptr: it is not run again.
  std::function<const Heat*(const Entrant&, std::uint64_t seed)> known;
  std::function<void(const Entrant&, const Heat&)> finished;
  /// Heats done and in all; false stops.
  std::function<bool(std::uint64_t done, std::uint64_t all)> keep_going;
};

/// Runs all heats, seed by seed, so that a race cut short has about equally many of each entrant.
/// The lecture's method in its settings comes first; of two the better median counts. An entrant
/// the world cannot take is refused, with the reason. The result is summarised; `command` is the
/// caller's to fill in.
RaceResult run_race(const RacePlan& plan, const std::vector<Entrant>& entrants,
                    const RaceHooks& hooks = {});

/// The world that always begins in one state; its step limit stays. Error: names the nearest state.
Result<World> world_from(const World& world, const std::string& state);

}  // namespace quoll
