#pragma once
// A run: some seeds of one way to learn in one world, until a limit or a goal; saved, resumed,
// judged.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "quoll/experiment/evaluation.hpp"
#include "quoll/experiment/training.hpp"
#include "quoll/learn/choice.hpp"
#include "quoll/model/solution.hpp"
#include "quoll/solve/optimality.hpp"

namespace quoll {

/// How a world was named: enough to find it again.
struct WorldSource {
  std::string name;  ///< built-in name or file
  std::vector<std::pair<std::string, std::string>> parameters;
};

/// Where all seeds together stand, for progress lines.
struct RunProgress {
  std::uint64_t steps = 0, episodes = 0;
  std::uint64_t finished = 0;         ///< seeds that are done
  double seconds = 0.0;               ///< since this call began
  std::optional<double> mean_return;  ///< of the episodes of each seed's last closed bin
};

/// What one seed came to.
struct SeedResult {
  std::uint64_t seed = 0, steps = 0, episodes = 0;
  double seconds = 0.0;
  Stop stop = Stop::none;
  Impossible impossible;
  std::vector<Action> policy;  ///< greedy among visited; empty where the learner has no table
  double processor_seconds = 0.0;
  std::optional<double> training_return;  ///< of the last 100 training episodes, if it is known
  std::optional<ReturnReached> reached;   ///< of --until return
  /// Where an exact answer is known; never of a rule that exists to be studied.
  std::optional<Optimality> optimality;
  /// States whose chosen action is optimal, among the states the verdict is about.
  std::uint64_t optimal_states = 0, judged_states = 0;
  /// From experience alone, where it was asked for; its policy is the seed's if it was reached.
  std::optional<ExperienceCertificate> certificate;
  Played played;
};

/// What a run came to.
struct RunResult {
  std::optional<Solution> exact;
  std::string no_exact;  ///< why there is no exact answer
  std::vector<SeedResult> seeds;
  /// Over the mean returns of `counted` seeds: where somebody stopped only some, while they learned
  /// or while they played, of the others; where all, of those that had begun.
  Statistics statistics;
  std::uint64_t counted = 0;
  std::uint64_t cut_short = 0;  ///< seeds that learned, whose greedy episodes somebody stopped
  std::optional<std::uint64_t>
      solved;            ///< of these at or above the world's own mark, if it has one
  double seconds = 0.0;  ///< learning, all seeds together
};

class Run {
 public:
  /// The method "auto" is settled here (learn/choice.hpp).
  static Result<Run> start(RunSettings settings, WorldSource source, const World& world,
                           std::vector<double> initial_rewards);
  /// A run of the method "distil": each seed is taught the `share` of the states of `table`, whose
  /// rows are those of the world (learn/deep/distil.hpp).
  static Result<Run> distil(RunSettings settings, WorldSource source, const World& world,
                            const Estimates& table, double share = 1.0);
  /// Reads a run file; finds its world again (beside the file if not where it was), and refuses a
  /// world that has changed since. `watch` = whether it goes on to watch for stability. `offered`
  /// is taken instead if it has the same model.
  static Result<Run> load(const std::string& path, bool watch = true,
                          const World* offered = nullptr);
  /// Whether the goal of these limits can be reached by this run's method.
  Result<void> allows(const RunSettings& limits) const;
  /// Writes the run atomically. Between calls of advance() only.
  Result<void> save(const std::string& path);

  /// Learns until every seed has met a limit of the settings, or `keep_going` returns false. Called
  /// between chunks from one thread at a time; `pause` (seconds, 0 = never) gives the caller the
  /// run back every so often, for saving: then false is returned. True = all seeds are done.
  bool advance(const RunSettings& limits, double pause,
               const std::function<bool(const RunProgress&)>& keep_going, const Sink& sink);

  /// Judges and plays the policies. `solve_too` = find the exact answer if the model is known.
  RunResult result(bool solve_too, const std::function<bool()>& keep_going = {}) const;

  const RunSettings& settings() const { return settings_; }
  /// How many processors advance() and result() use; changes no result.
  void set_threads(unsigned threads) { settings_.threads = threads; }
  const WorldSource& source() const { return source_; }
  const World& world() const { return *world_; }
  double discount() const;
  const LearnerEntry& entry() const { return *entry_; }
  /// What was settled on for "auto"; none where the settings named the method.
  const std::optional<MethodChoice>& choice() const { return choice_; }
  std::vector<Training>& trainings() { return trainings_; }
  const std::vector<Training>& trainings() const { return trainings_; }

 private:
  static Result<Run> begin(RunSettings settings, WorldSource source, const World& world,
                           std::vector<double> initial_rewards);
  void persist(Archive& archive);
  Limits limits_of(const RunSettings& asked) const;
  void sum_up(RunResult& result) const;
  std::vector<State> starts() const;
  std::function<bool(const Learner&)> referee() const;

  RunSettings settings_;
  WorldSource source_;
  std::shared_ptr<const World> world_;
  std::vector<double> initial_rewards_;
  const LearnerEntry* entry_ = nullptr;
  std::optional<MethodChoice> choice_;
  std::vector<Training> trainings_;
};

/// Steps after which a run without a limit gives up on being stable: max(10^6, 2000 x pairs); the
/// pairs of a world without a model are its states x its largest number of actions.
std::uint64_t default_budget(const World& world);

/// Steps of a run without a limit whose method knows no table.
inline constexpr std::uint64_t default_steps = 500'000;

}  // namespace quoll
