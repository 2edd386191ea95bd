#pragma once
// A run as people ask for it: how to learn, how long, how often.

#include <cstdint>
#include <optional>
#include <string>

#include "quoll/learn/certifier.hpp"
#include "quoll/learn/settings.hpp"

namespace quoll {

enum class CertifyScope : std::uint8_t { start, all };
inline constexpr std::string_view certify_names[] = {"start", "all"};
enum class Successors : std::uint8_t { states, listed };
inline constexpr std::string_view successors_names[] = {"states", "listed"};

struct RunSettings {
  LearnSettings learn;
  /// What "--until certified:EPS" asks for: EPS, or EPS% of the start value; empty = nothing.
  std::string certified;
  bool by_model = false;  ///< certified by the model, not by experience
  CertifyScope certify = CertifyScope::start;
  Successors successors = Successors::states;
  double confidence = 0.95;

  // Limits: they count the whole run, per seed, resumed parts included.
  std::uint64_t steps = 0;     ///< 0 = no limit
  std::uint64_t episodes = 0;  ///< 0 = no limit
  std::string time;            ///< "10s", "2m", "500ms"; empty = no limit
  /// "stable", "certified:EPS", "certified:EPS,model", "return:R" or empty.
  std::string until;
  std::uint64_t seeds = 1;  ///< seeds N .. N + seeds - 1
  unsigned threads = 0;     ///< 0 = all processors
  bool force = false;       ///< learn although undiscounted values are undefined
  std::uint64_t evaluation_episodes = 100;

  /// How to learn and how often: what a resumed run takes from its file.
  void describe(Describer& d);
  /// Limits and what may be given anew.
  void describe_limits(Describer& d);
  void persist(Archive& archive);

  /// R of "return:R".
  std::optional<double> mean_return() const;
  bool has_limit() const { return steps > 0 || episodes > 0 || !time.empty() || !until.empty(); }
};

/// Whether the settings' goal is one: "stable", "return:R" or none ("certified:EPS" is taken apart
/// by take_certified()).
Result<void> check_until(std::string_view until);

/// Takes "certified:EPS", "certified:EPS%" or either with ",model" apart into the settings. Error:
/// something else, a gap that is not positive in a noisy world or negative.
Result<void> take_certified(std::string_view until, RunSettings& settings);

/// The goal that the settings name.
CertifyGoal certify_goal(const RunSettings& settings);

/// "10s", "1.5m", "2h", "500ms", or a plain number of seconds.
Result<double> parse_duration(std::string_view text, std::string_view place);

}  // namespace quoll
