#pragma once
// The border to everything that learns: a learner owns its closed loop of acting and updating, and
// is advanced by a number of steps. It never prints, times or reads files.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "quoll/act/policy.hpp"
#include "quoll/base/archive.hpp"
#include "quoll/env/world.hpp"
#include "quoll/learn/finished_episode.hpp"
#include "quoll/learn/settings.hpp"
#include "quoll/learn/update.hpp"

namespace quoll {

/// A value above what any policy could earn: proof that it estimates nothing (docs/lecture.md).
struct Impossible {
  bool found = false;
  std::uint64_t step = 0;
  State state = 0;
  Action action = 0;
  double value = 0.0;
  double bound = 0.0;  ///< max(max |Q0|, R / (1 - discount))
};

/// Where a learner stands; all counts since the beginning of the run.
struct LearnProgress {
  enum class Halt : std::uint8_t { none, stable, diverged } halt = Halt::none;
  std::uint64_t steps = 0;
  std::uint64_t episodes = 0;  ///< finished ones
  /// Undiscounted returns of the finished episodes; each reward counts for whoever moved, also
  /// where two players move in turn.
  double return_sum = 0.0;
  std::uint64_t logged = 0;  ///< updates written to the log by the last advance
  Impossible impossible;     ///< the first one
  /// Work that the last step made due is left, since nobody wanted to wait: advance(0) goes on.
  bool unfinished = false;
};

/// What was learned, per choice of the model (choice_begin(s) + a), in plain doubles. Without a
/// model the rows are those of the environment: row_begin[s] + a. Without rows at all (row_begin
/// empty) the values are a function of what is observed: Learner::policy() is all there is.
struct Estimates {
  std::vector<std::uint64_t> row_begin;  ///< first choice of each state, and the end
  std::vector<double> q;
  std::vector<std::uint32_t> visits;
  std::vector<double> reward_estimate;  ///< rules with their own rE; else empty
  bool single_precision = true;         ///< q holds floats
  /// Per state, whether q tells of actions that were never tried, too; empty: of none.
  std::vector<std::uint8_t> foreseen;
};

/// A number that a learner tells about itself, such as "td_loss" (mean squared error of an update)
/// or "q_values" (mean value of the actions learned from): its sum and how often it was counted,
/// both since the beginning of the run, so that the mean over any stretch is a difference of both.
struct Measure {
  std::string_view name;
  double sum = 0.0;
  std::uint64_t count = 0;
};

struct LearnedNetwork;

class Learner {
 public:
  virtual ~Learner() = default;
  /// Acts and learns for at most `steps` steps; exactly that many unless it halts or is told to
  /// stop (ask). Learners that walk several lanes together take whole rounds: up to lanes - 1 steps
  /// more. With a log, stops when the log is full; the bits are the same with and without. Learners
  /// that approximate have nothing to write into a log.
  virtual LearnProgress advance(std::uint64_t steps, std::span<Update> log) = 0;
  /// Whom to ask, every few milliseconds, where work between two steps takes seconds: once the
  /// answer is no, advance() returns with fewer steps, and its next call goes on with that work.
  /// The bits are the same. Nobody is asked at first.
  virtual void ask(const std::function<bool()>& /*keep_going*/) {}
  /// Whoever reads the log looks at what happened only: best_next, target and step_size of an
  /// Update may be left out from now on, where finding them costs time.
  virtual void log_experience_only() {}
  virtual LearnProgress progress() const = 0;
  /// A row for each state of a world with a model. Learners that approximate may have none in other
  /// worlds.
  virtual Estimates estimates() const = 0;
  /// Greedy as the learner is now, independent of its later steps. Here: that of the estimates.
  virtual std::unique_ptr<Policy> policy() const;
  /// A copy of the network it has learned (deep/learned_network.hpp); nullptr for those without.
  virtual std::shared_ptr<const LearnedNetwork> network() const { return nullptr; }
  /// The episodes that ended during the last advance(), in order; learners that approximate tell
  /// them, of others the log does.
  virtual std::span<const FinishedEpisode> finished() const { return {}; }
  /// What else it tells about itself; always the same names in the same order.
  virtual std::vector<Measure> measures() const { return {}; }
  /// Everything that continuing needs, exactly: loading and advancing continues bit for bit.
  virtual void persist(Archive& archive) = 0;
};

/// What a method is, beyond its name.
struct LearnerTraits {
  /// Its values tend to the optimal ones however it explores; false: to those of its exploring.
  bool off_policy = true;
  /// Its table is planned by the solvers, to within their intervals.
  bool plans = false;
  /// Knows an upper and a lower value of each state, as starts of widest gap need.
  bool has_bounds = false;
  /// Tries only what may matter from where it starts: not every value is learned.
  bool directed = false;
  /// Learns a function of what is observed, or of numbered states through an encoding: needs no
  /// list of states, and what is only for tables (step sizes, initial values, stability) is not
  /// its.
  bool approximates = false;
  /// By networks: its bits depend on the processor's arithmetic (nn::Arithmetic::fused).
  bool networks = false;
  /// Learns from a table that it is handed, not by experience: no method that learn or race offer.
  bool taught = false;
  /// What --epsilon auto stands for.
  std::string_view epsilon = "0.1";
  /// What --optimiser auto stands for; empty = it has none.
  std::string_view optimiser = {};
  /// Hopes: begins with the most that any policy can earn unless --initial-value says else, and
  /// acts on that: --explore has no say.
  bool optimistic = false;
  /// Settings of all tables that it does not read, ", " between them: they are refused.
  std::string_view ignores = {};
};

/// One line of the registry of learners.
struct LearnerEntry {
  std::string_view method;
  std::string_view rule;  ///< "" = the method has no choice of rules
  std::string_view summary;
  /// False for a rule that exists to be studied: it is neither exported nor certified.
  bool sound;
  std::unique_ptr<Learner> (*make)(const LearnSetup& setup);
  /// The same rule applied to given transitions (state, action, reward, next, terminated of each),
  /// with the numbers of each update filled in; needs a world with a model. Nullptr for methods
  /// with memory, whose updates are more than one step's.
  std::vector<Update> (*replay)(const LearnSetup& setup, std::span<const Update> script);
  LearnerTraits traits{};
  /// What the method needs of a world beyond a list of its states; nullptr = nothing.
  Result<void> (*check)(const LearnSetup& setup) = nullptr;
  /// What an update does to the table, one line; empty for rules, whose formulas replay tells.
  std::string_view formula = {};
};
std::span<const LearnerEntry> learners();

/// The learner that the settings name, for this world; `initial_rewards` per choice for the rules
/// that take them (empty = those of the settings).
Result<std::unique_ptr<Learner>> make_learner(const LearnSettings& settings, const World& world,
                                              const std::vector<double>& initial_rewards = {});

/// The entry make_learner uses, or an Error that names the nearest.
Result<const LearnerEntry*> find_learner(const LearnSettings& settings);
/// The same for what people may ask for: learners() only, none that are taught.
Result<const LearnerEntry*> find_offered(const LearnSettings& settings);

/// The greedy policy of the estimates: among visited actions only, ties to the lowest index;
/// no_action where none was visited and for ends. Empty without rows.
std::vector<Action> greedy_policy(const Estimates& estimates);

}  // namespace quoll
