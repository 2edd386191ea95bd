#include "quoll/solve/meant.hpp"

#ifdef QUOLL_GMP

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "quoll/base/text.hpp"

namespace quoll {

namespace {

constexpr double largest_denominator = 1e6;
constexpr std::size_t short_digits = 15;      // so many every double keeps
constexpr double rounding_of_sums = 0x1p-51;  // what a few sums of probabilities may be off

// A finite double as digits times a power of ten.
struct Decimal {
  std::string digits;  // with the sign, without zeros at the end
  int exponent = 0;

  explicit Decimal(double value) {
    const std::string text = shortest(value);
    const std::size_t mark = std::min(text.find('e'), text.size());
    if (mark < text.size()) exponent = std::atoi(text.c_str() + mark + 1);
    bool after_point = false;
    for (const char letter : text.substr(0, mark)) {
      if (letter == '.') {
        after_point = true;
        continue;
      }
      digits += letter;
      if (after_point) --exponent;
    }
    while (digits.size() > 1 && digits.back() == '0') {
      digits.pop_back();
      ++exponent;
    }
  }

  std::size_t count() const {
    const std::size_t first = digits.find_first_not_of("-0");
    return first == std::string::npos ? 0 : digits.size() - first;
  }

  Rational exactly() const {
    const auto power = ten_to(static_cast<std::uint32_t>(std::abs(exponent)));
    Integer whole(digits);
    if (exponent < 0) return {whole, power};
    whole *= power;
    return {whole, Integer(1)};
  }
};

Rational meant_within(double value, double distance) {
  const Decimal decimal(value);
  if (decimal.count() > short_digits) {
    if (const auto simple = simple_fraction(value, distance)) {
      return {Integer(simple->first), Integer(simple->second)};
    }
  }
  return decimal.exactly();
}

}  // namespace

Rational shortest_decimal(double value) {
  return Decimal(value).exactly();
}

// Continued fractions: Knuth, TAOCP 2, 4.5.3. A fraction p/q that rounds to a double x of moderate
// size is nearer to it than 1/(2 q^2), hence a convergent (Legendre). p and q are whole doubles, so
// that p / q == x asks exactly whether the fraction rounds to x.
std::optional<std::pair<std::int64_t, std::int64_t>> simple_fraction(double value,
                                                                     double distance) {
  const double size = std::fabs(value);
  if (!(size < 0x1p53 / largest_denominator)) return std::nullopt;
  double before_p = 1.0, before_q = 0.0;
  double p = std::floor(size), q = 1.0;
  double rest = size - p;
  while (std::fabs(p / q - size) > distance) {
    if (rest == 0.0) return std::nullopt;
    const double turned = 1.0 / rest;
    const double part = std::floor(turned);
    rest = turned - part;
    const double next_q = part * q + before_q;
    if (!(next_q <= largest_denominator)) return std::nullopt;
    const double next_p = part * p + before_p;
    before_p = p, before_q = q;
    p = next_p, q = next_q;
  }
  const auto numerator = static_cast<std::int64_t>(p);
  return std::pair(value < 0.0 ? -numerator : numerator, static_cast<std::int64_t>(q));
}

Rational meant(double value) {
  return meant_within(value, 0.0);
}

Rational meant_by_computing(double value) {
  return meant_within(value, rounding_of_sums);
}

const Rational& MeantModel::once(Numbers& known, double value, Rational (*reading)(double)) {
  const auto place = known.find(value);
  if (place != known.end()) return place->second;
  return known.emplace(value, reading(value)).first->second;
}

bool MeantModel::read_row(const Mdp& mdp, std::uint64_t choice) {
  const std::uint64_t begin = mdp.outcome_begin(choice), end = mdp.outcome_end(choice);
  const auto sums_to_one = [&](Numbers& known, Rational (*reading)(double)) {
    Rational sum;
    for (std::uint64_t o = begin; o < end; ++o) {
      probability_[o] = &once(known, mdp.probability(o), reading);
      sum += *probability_[o];
    }
    return sum.compare(1.0) == 0;
  };
  if (sums_to_one(meant_, meant) || sums_to_one(decimal_, shortest_decimal)) return true;
  computed_ = true;
  return sums_to_one(near_, meant_by_computing);
}

void MeantModel::read_reward(const Mdp& mdp, std::uint64_t choice) {
  const std::vector<double>& by_outcome = mdp.arrays().outcome_reward;
  if (by_outcome.empty()) {
    reward_[choice] = once(meant_, mdp.reward(choice), meant);
    return;
  }
  for (std::uint64_t o = mdp.outcome_begin(choice); o < mdp.outcome_end(choice); ++o) {
    Rational part = once(meant_, by_outcome[o], meant);
    if (!probability_.empty()) part *= *probability_[o];
    reward_[choice] += part;
  }
}

bool MeantModel::read_start(const Mdp& mdp) {
  const auto count = static_cast<std::int64_t>(mdp.start().size());
  if (mdp.arrays().start_probability.empty()) {
    start_.assign(mdp.start().size(), Rational(Integer(1), Integer(count)));
    return true;
  }
  for (Rational (*reading)(double) : {meant, shortest_decimal, meant_by_computing}) {
    start_.clear();
    Rational sum;
    for (std::uint64_t i = 0; i < mdp.start().size(); ++i) {
      start_.push_back(reading(mdp.start_probability(i)));
      sum += start_.back();
    }
    if (sum.compare(1.0) == 0) return true;
  }
  return false;
}

Result<MeantModel> MeantModel::read(const Mdp& mdp, double discount, bool maximise) {
  MeantModel model;
  model.carry_ = meant(discount);
  if (mdp.alternating()) model.carry_.negate();
  if (!mdp.arrays().probability.empty()) model.probability_.resize(mdp.outcomes());
  model.reward_.resize(mdp.choices());
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      if (!model.probability_.empty() && !model.read_row(mdp, c)) {
        return Error{"--exact", 0, 0,
                     "the probabilities of state " + mdp.state_name(s) + ", action " +
                         mdp.action_name(c) +
                         " do not sum to exactly 1, read as decimals or as fractions like 1/3",
                     ""};
      }
      model.read_reward(mdp, c);
      if (!maximise) model.reward_[c].negate();
    }
  }
  if (model.read_start(mdp)) return model;
  return Error{"--exact", 0, 0, "the probabilities of the start states do not sum to exactly 1",
               ""};
}

}  // namespace quoll

#endif
