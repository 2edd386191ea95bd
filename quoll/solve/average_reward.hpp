#pragma once
// The best average reward per step over endless time (the gain), and what a start is worth beside
// it (the bias).

#include <cstdint>
#include <string_view>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {

/// How many classes of states there are in which one can stay for ever, as far as the graph says.
enum class ChainStructure : std::uint8_t {
  unichain,              ///< every policy ends up in one class: one state is always met again
  communicating,         ///< one class that holds all states
  weakly_communicating,  ///< one class, and states that every policy leaves for good
  multichain             ///< several classes: the gain may depend on the start
};

/// A maximal end component, or all ends together.
struct StayingClass {
  std::uint64_t states = 0;
  State first = 0;                  ///< its lowest state
  bool ends = false;                ///< the ends: nothing is earned there
  bool stays = false;               ///< the policy stays in it for ever once there
  double lower = 0.0, upper = 0.0;  ///< bounds on the best gain of staying
};

struct AverageSolution {
  std::vector<double> lower;   ///< per state: the policy's gain is at least this
  std::vector<double> upper;   ///< per state: no policy's gain is larger
  std::vector<Action> policy;  ///< per state; no_action for ends
  /// Per state: solves gain + bias = max r + E bias to within the gap, 0 at the first state of the
  /// class or at the ends; not certified. Of a multichain model only in
  /// the classes the policy stays in, else not a number.
  std::vector<double> bias;
  std::vector<std::uint32_t> part;  ///< per state: its class, or no_component
  std::vector<StayingClass> classes;
  ChainStructure structure = ChainStructure::multichain;
  std::uint64_t sweeps = 0;
  double gap = 0.0;        ///< largest upper - lower
  bool completed = false;  ///< not stopped before its time
  bool converged = false;  ///< completed, and gap <= the width asked for
};

/// What solve_average() is called where methods are named; it answers another question than the
/// solvers of the registry.
inline constexpr std::string_view average_method = "relative-value-iteration";
inline constexpr std::string_view average_summary =
    "the best average reward per step, its gain and bias; with --average";

/// Solves for the largest average reward per step (settings: width, maximise, threads, max_sweeps,
/// keep_going; the discount plays no part). One class: relative value iteration (part_gains). More
/// than one: the gain of staying in each, then which one to go to, a problem of total reward over
/// the classes (Puterman 1994, chapter 9; de Alfaro 1997, section 5.4). An end counts as a class
/// that earns 0 for ever. Every bound is true in spite of rounding; rows are taken to sum to 1.
/// Error: two players move in turn.
Result<AverageSolution> solve_average(const Mdp& mdp, const SolveSettings& settings = {});

}  // namespace quoll
