#pragma once
// Updates told with their own numbers: the formula with every value plugged in, the old and the new
// value; and two rules side by side on the same transitions.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/base/json.hpp"
#include "quoll/learn/update.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// "100", and "(-2)" where a sign would read badly.
std::string factor_text(double value);

/// "(HALL, To-CAVE)".
std::string pair_text(const Mdp& mdp, State state, Action action);

/// What the rule is called in formulas, and what else each line says.
struct UpdateWords {
  std::string_view q = "Q";  ///< "QE" for the rules that have rE
  /// Where the first summand comes from: "" = the observed reward, else said as rE.
  enum class Reward : std::uint8_t { observed, stored, mean } reward = Reward::observed;
  bool chance = false;  ///< say whether chance chose the action: the updates are a learner's own
  bool memory = false;  ///< of a method with memory: what it took as the value of the next state is
                        ///< said as a number, and what else it changed is told

  /// By the name of the rule: standard, as-printed, reward-estimate.
  static UpdateWords of(std::string_view rule);
};

/// A value that an update changed beside that of its own pair.
struct OtherChange {
  std::uint64_t choice = 0;
  double old_value = 0.0, new_value = 0.0;
};

/// Tells one update after the other, following the values of the table that the updates make.
class UpdateTeller {
 public:
  /// `q` per choice, before the first update; `visits` likewise or empty.
  UpdateTeller(const Mdp& mdp, std::vector<double> q, double discount, UpdateWords words,
               std::vector<std::uint32_t> visits = {});

  /// Two lines: the step, and its formula; then what else was changed. Then all of it counts.
  std::string tell(const Update& update, std::span<const OtherChange> others = {});

  /// The formula alone, "0 + 0.8 * max{To-GOAL 100, To-HALL 0} = 80"; changes nothing.
  std::string formula(const Update& update) const;

  /// One JSON object with the numbers of the update and the row of the next state; then it counts.
  /// `is_float` = the table holds floats; `standard` = the value the standard rule gives there.
  void write(JsonWriter& json, const Update& update, bool is_float,
             std::optional<double> standard = {}, std::span<const OtherChange> others = {});

  std::span<const double> q() const { return q_; }
  std::span<const std::uint32_t> visits() const { return visits_; }

 private:
  std::string best_text(const Update& update) const;
  std::string change_text(const Update& update, const std::string& name) const;
  std::string others_text(std::span<const OtherChange> others) const;
  std::string choice_text(std::uint64_t choice) const;
  State owner(std::uint64_t choice) const;
  void count(const Update& update, std::span<const OtherChange> others);

  const Mdp& mdp_;
  std::vector<double> q_;
  std::vector<std::uint32_t> visits_;
  double discount_;
  UpdateWords words_;
};

/// Two rules on the same transitions.
struct RuleComparison {
  const Mdp* mdp = nullptr;
  std::span<const Update> printed, standard;  ///< of equal length, the same transitions
  double discount = 1.0;
  bool episodes = false;  ///< the updates are a learner's own: say where episodes end
};

/// Index of the first update whose new values differ (relative 1e-6), or nothing.
std::optional<std::size_t> first_difference(const RuleComparison& view);

/// One line per update, both sums written out, the first difference marked.
std::string comparison_text(const RuleComparison& view);

}  // namespace quoll
