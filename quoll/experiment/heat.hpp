#pragma once
// What a race gives: plain data, for tables, pictures, JSON and the log of a suite.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quoll {

/// From which states a policy must be good: from all, where start strategies may put the world into
/// any state, or from the start alone, where all they can do is begin anew.
enum class RaceMode : std::uint8_t { all, start };
inline constexpr std::string_view race_mode_names[] = {"all", "start"};

/// How a heat ended.
enum class HeatEnd : std::uint8_t {
  reached,      ///< good at two successive checkpoints
  steps,        ///< the steps it may take are over
  seconds,      ///< the seconds it may take are over
  halted,       ///< the learner stopped (diverged, or nothing left to do) and is not good
  interrupted,  ///< somebody asked to stop: it does not count
};
inline constexpr std::string_view heat_end_names[] = {"reached", "steps", "seconds", "halted",
                                                      "interrupted"};

/// One entrant in one world with one seed.
struct Heat {
  std::uint64_t seed = 0;
  HeatEnd end = HeatEnd::interrupted;
  /// Steps until the policy was good; if it never was, the steps done.
  std::uint64_t steps = 0;
  /// Processor seconds of those steps and of reading the policy once; the referee's do not count.
  double seconds = 0.0;
  std::uint64_t bytes = 0;  ///< of the learner, as it would be saved

  bool good() const { return end == HeatEnd::reached; }
};

/// Median and quartiles, linear between neighbours; nan where there is nothing.
struct Quartiles {
  double lower = 0.0, median = 0.0, upper = 0.0;
};
/// Of the values that are numbers.
Quartiles quartiles(std::span<const double> values);

/// All heats of one entrant in one world.
struct EntrantResult {
  std::string word;      ///< as people call it
  std::string settings;  ///< the word that repeats it whatever the defaults
  std::string note;      ///< one more fact, or empty
  std::string refused;   ///< why it cannot run in this world; empty = it can
  std::vector<Heat> heats;

  // Filled in by summarise(). A seed that failed enters with the most steps it might have taken,
  // and with the seconds these would have taken at its own speed.
  std::uint64_t failures = 0;
  Quartiles steps, seconds;
  double step_seconds = 0.0;  ///< median seconds per step
  std::uint64_t bytes = 0;    ///< median
  /// How many times fewer steps and seconds than the yardstick: ratio of the medians; nan where one
  /// of them ran no seed.
  double fewer_steps = 0.0, fewer_seconds = 0.0;

  /// The median seed failed: figures are bounds.
  bool failed() const { return 2 * failures > heats.size(); }
};

/// Everything one race says. The first entrant is the yardstick, the lecture's method.
struct RaceResult {
  std::string world;    ///< its name
  std::string command;  ///< what is typed to name the world with its parameters
  RaceMode mode = RaceMode::start;
  double discount = 1.0;
  std::uint64_t states = 0, choices = 0;
  bool deterministic = false;
  std::uint64_t seeds = 0, first_seed = 1;
  std::uint64_t cap_steps = 0;
  double cap_seconds = 0.0;  ///< 0 = none
  bool interrupted = false;
  std::vector<EntrantResult> entrants;
};

/// An entrant who fails with each of so many first seeds runs no others: its median is the cap
/// anyway.
inline constexpr std::uint64_t trial_seeds = 5;
bool retired(std::span<const Heat> heats);

/// Fills in what follows from the heats. Heats that were interrupted are dropped.
void summarise(RaceResult& race);

/// The geometric mean; nan of nothing. Values must be above 0.
double geometric_mean(std::span<const double> values);

}  // namespace quoll
