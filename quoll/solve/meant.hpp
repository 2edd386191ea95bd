#pragma once
// The numbers a person meant by the doubles of a model: 0.1 for the double nearest to a tenth, 1/3
// for the one nearest to a third. Only builds that found GMP define these.

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/solve/rational.hpp"

namespace quoll {

/// The shortest decimal that rounds to a finite double.
Rational shortest_decimal(double value);

/// The first convergent of the continued fraction of `value` that is at most `distance` away and
/// has a denominator up to 1,000,000: numerator and denominator. At distance 0 it must round to
/// `value`. Nothing if there is none.
std::optional<std::pair<std::int64_t, std::int64_t>> simple_fraction(double value,
                                                                     double distance = 0.0);

/// What was meant by a number that stands alone: its shortest decimal if that has at most 15
/// digits, else its simple fraction if there is one, else the decimal.
Rational meant(double value);

/// What was meant by a probability that was computed: as meant(), but its simple fraction may be
/// 2^-51 away, so that 1 - 0.8 = 0.19999999999999996 is a fifth.
Rational meant_by_computing(double value);

/// A model in fractions. The probabilities of a choice are read as meant() says; if their sum is
/// not 1 then, as shortest decimals; if not then either, as meant_by_computing() says.
class MeantModel {
 public:
  /// Error: a choice, or the start, whose probabilities sum to 1 in no reading, by name. Costs
  /// must be turned into rewards by `maximise` = false. Memory: some 40 bytes per outcome.
  static Result<MeantModel> read(const Mdp& mdp, double discount, bool maximise);
  MeantModel(MeantModel&&) = default;
  MeantModel& operator=(MeantModel&&) = default;

  /// Nullptr = 1, without doubt.
  const Rational* probability(std::uint64_t outcome) const {
    return probability_.empty() ? nullptr : probability_[outcome];
  }
  /// Expected reward of a choice, its sign turned if rewards are costs.
  const Rational& reward(std::uint64_t choice) const { return reward_[choice]; }
  /// What the value of a next state is multiplied by.
  const Rational& carry() const { return carry_; }
  /// Whether some probability was read as another number than its double stands for.
  bool computed() const { return computed_; }
  const Rational& start_probability(std::uint64_t index) const { return start_[index]; }

 private:
  MeantModel() = default;
  using Numbers = std::map<double, Rational>;

  const Rational& once(Numbers& known, double value, Rational (*reading)(double));
  bool read_row(const Mdp& mdp, std::uint64_t choice);
  void read_reward(const Mdp& mdp, std::uint64_t choice);
  bool read_start(const Mdp& mdp);

  Numbers meant_, decimal_, near_;            // nodes stay where they are when the maps move
  std::vector<const Rational*> probability_;  // per outcome; empty = all 1
  std::vector<Rational> reward_, start_;
  Rational carry_;
  bool computed_ = false;
};

}  // namespace quoll
