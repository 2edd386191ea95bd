#include "quoll/env/binned.hpp"

#include <charconv>
#include <cmath>

#include "quoll/base/text.hpp"

namespace quoll {
namespace {

constexpr std::uint64_t most_states = 0x7fffffff;

Error not_bins(std::string_view text, const std::vector<Measured>& numbers,
               const std::string& found) {
  std::string names;
  for (const Measured& number : numbers) {
    names += (names.empty() ? "" : ", ") + std::string(number.name);
  }
  return {"--with bins", 0, 0,
          counted(numbers.size(), "whole number") + " from 1 up (" + names + ") expected, not '" +
              std::string(text) + "'" + found,
          ""};
}

std::string digits(double value) {
  constexpr int kept = 4;
  char text[32];
  const double whole = std::fabs(value) < 1e-12 ? 0.0 : value;
  const auto end =
      std::to_chars(text, text + sizeof text, whole, std::chars_format::general, kept).ptr;
  return {text, end};
}

}  // namespace

Result<Bins> Bins::parse(std::string_view text, std::vector<Measured> numbers) {
  const std::vector<std::string_view> pieces = split(text, ',');
  if (pieces.size() != numbers.size() || numbers.size() > most_numbers) {
    return not_bins(text, numbers, "");
  }
  Bins bins;
  std::uint64_t states = 1;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::optional<std::uint64_t> count = parse_count(pieces[i]);
    if (!count || *count == 0) return not_bins(text, numbers, "");
    if (*count > most_states / states) {
      return not_bins(text, numbers, ": more than 2^31 - 1 states");
    }
    states *= *count;
    const auto& [name, low, high] = numbers[i];
    bins.cuts_.push_back(
        {low, static_cast<double>(*count) / (high - low), static_cast<std::uint32_t>(*count)});
  }
  bins.states_ = static_cast<State>(states);
  return bins;
}

State Bins::number(std::span<const float> observation) const {
  State state = 0;
  for (std::size_t i = 0; i < cuts_.size(); ++i) {
    const auto& [low, per_unit, count] = cuts_[i];
    const double place = (double{observation[i]} - low) * per_unit;
    const State bin = !(place > 0.0)                        ? 0
                      : place >= static_cast<double>(count) ? count - 1
                                                            : static_cast<State>(place);
    state = state * count + bin;
  }
  return state;
}

std::string Bins::name(State state) const {
  std::string text;
  for (std::size_t i = cuts_.size(); i-- > 0;) {
    const auto& [low, per_unit, count] = cuts_[i];
    const State bin = state % count;
    state /= count;
    const std::string from = bin > 0 ? digits(low + bin / per_unit) : "";
    const std::string to = bin + 1 < count ? digits(low + (bin + 1) / per_unit) : "";
    text = from + ".." + to + (text.empty() ? "" : " ") + text;
  }
  return text;
}

}  // namespace quoll
