#pragma once
// Learning from logs alone: the world is taken to be what was counted. Actions never tried are left
// out, and what the counts are sure of is told beside what they say (Strehl, Littman 2008).

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "quoll/experiment/settings.hpp"
#include "quoll/learn/certifier.hpp"
#include "quoll/learn/tabular/planning.hpp"
#include "quoll/model/solution.hpp"
#include "quoll/solve/optimality.hpp"

namespace quoll {

/// What was learned, and from what.
struct LogLearning {
  World world;                       ///< as given, else the states and actions that the logs name
  bool named_by_logs = false;        ///< no world was given
  std::shared_ptr<const Mdp> names;  ///< states and actions; only the world's model is more
  double discount = 1.0;
  std::uint64_t steps = 0, ended = 0, cut = 0;  ///< rows, and those that ended or were cut off
  CountedModel model;                           ///< per choice of `names`
  Plan plan;                                    ///< optimal among what was tried
  double stuck = 0.0;                           ///< value of a state where nothing was tried
  RewardRange seen;                             ///< smallest and largest reward in the logs
  std::optional<RewardRange> rewards;           ///< as declared or given
  std::uint64_t misfits = 0;                    ///< steps that the given world cannot have made
  /// Bounds on the optimal values that hold with the confidence asked for, or why there are none.
  std::optional<Certifier> certifier;
  std::string no_bounds;
  /// The policy judged by the model, where the world has one.
  std::optional<Solution> exact;
  std::optional<Optimality> optimality;
  std::string no_exact;

  std::uint64_t visits(State s) const;
  /// Whether something can be done in this state, and nothing was tried.
  bool unknown(State s) const {
    return names->actions(s) > 0 && !names->terminal(s) && visits(s) == 0;
  }
  /// Mean reward of a pair that was tried.
  double mean_reward(std::uint64_t pair) const;
};

/// Reads the logs and plans. Of the settings count discount, reward_range, successors and
/// confidence. `world` = none: the logs are read twice, and a discount must be given. Errors: those
/// of read_steps() and of the settings; values that are not defined at discount 1.
Result<LogLearning> learn_from_logs(std::span<const std::string> files,
                                    const std::optional<World>& world, const RunSettings& settings);

}  // namespace quoll
