#pragma once
// How to learn, as people say it (LearnSettings: words and numbers, one list for command line, TOML
// and checkpoint), and as a learner needs it (LearnSetup: resolved against a world).

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "quoll/act/exploration.hpp"
#include "quoll/act/start.hpp"
#include "quoll/base/settings.hpp"
#include "quoll/env/world.hpp"
#include "quoll/learn/deep/deep_settings.hpp"
#include "quoll/learn/step_size.hpp"
#include "quoll/learn/value_range.hpp"

namespace quoll {

enum class Ties : std::uint8_t { uniform, first };
inline constexpr std::string_view ties_names[] = {"uniform", "first"};
enum class Precision : std::uint8_t { single, twofold };
inline constexpr std::string_view precision_names[] = {"float", "double"};
enum class Backups : std::uint8_t { full, small };
inline constexpr std::string_view backups_names[] = {"full", "small"};
inline constexpr std::string_view rule_names[] = {"standard", "as-printed", "reward-estimate"};

/// The numbers of methods with memory; each file in learn/tabular/ says which it reads.
struct MethodSettings {
  double trace_decay = 0.8;             ///< lambda
  std::uint64_t return_steps = 5;       ///< n
  std::uint64_t planning_backups = 10;  ///< backups of the model per step
  double sweep_threshold = 1e-4;        ///< theta, times the range of rewards
  Backups backups = Backups::full;
  double kappa = 1e-3;            ///< Dyna-Q+: bonus times sqrt(steps since the last visit)
  double ucb_bonus = 0.03;        ///< UCB-Q: bonus times range * sqrt(H / n)
  std::uint64_t known_after = 1;  ///< m: visits after which a pair is known
  double bonus_variance = 0.5;    ///< B
  double bonus_range = 0.3;       ///< C

  void describe(Describer& d);
};

/// The numbers of linear-q.
struct LinearSettings {
  std::uint64_t tilings = 8;
  std::string tiles = "8";      ///< in each number's range: one count, or one for each number
  double tile_step_size = 0.2;  ///< of all tilings together
  bool keep_traces = false;     ///< Watkins ends them where an action was not greedy

  void describe(Describer& d);
};

struct LearnSettings {
  std::string method = "q-learning";
  std::string rule = "standard";
  double discount = 0.0;  ///< 0 = the world's own
  std::uint64_t seed = 1;
  std::string explore = "auto";
  std::string epsilon = "auto";
  std::string temperature = "1";
  double ucb_constant = 1.4;
  double count_bonus = 0.3;
  double omega = 5.0;
  std::string start = "world";
  std::string step_size = "auto";
  std::string initial_value = "0";
  std::string initial_rewards = "world";
  Ties ties = Ties::uniform;
  double tolerance = -1.0;
  std::uint64_t episode_steps = 0;
  Precision precision = Precision::single;
  std::string reward_range;  ///< "a,b"; empty = as the world declares
  MethodSettings of_method;
  LinearSettings linear;
  DeepSettings deep;
  bool until_stable = true;  ///< set by the run: watch for stability

  void describe(Describer& d);
  void persist(Archive& archive);
};

/// Watching for the point from which nothing changes any more (docs/design.md, section 6).
struct StableSetup {
  bool watch = false;        ///< taught learners: whether to stop when all greedy actions are right
  std::uint32_t visits = 1;  ///< K: visits of every pair since the last movement
  double tolerance = 0.0;    ///< relative to max(1, |Q|)
  std::uint64_t pairs = 0;   ///< pairs reachable from the start; 0 = not known, those met so far
};

/// Everything a learner needs, resolved and checked. What is only for tables (step size, initial
/// values, stability, the guard) stays as it is here for learners that approximate.
struct LearnSetup {
  const World* world = nullptr;
  std::string method, rule;
  double discount = 1.0;
  std::uint64_t seed = 1;
  Exploration exploration;
  StartStates starts;
  StepSize step_size;
  double initial_value = 0.0;
  std::vector<double> initial_rewards;  ///< per choice, or empty
  std::uint64_t episode_steps = 2000;
  Precision precision = Precision::single;
  StableSetup stable;
  double value_bound = 0.0;            ///< B of the divergence guard; 0 = none known
  std::optional<RewardRange> rewards;  ///< as declared or given
  MethodSettings of_method;
  LinearSettings linear;
  DeepSettings deep;
};

/// Resolves the settings against the world. Errors name the flag, the range and the nearest word.
Result<LearnSetup> resolve(const LearnSettings& settings, const World& world,
                           const std::vector<double>& initial_rewards = {});

}  // namespace quoll
