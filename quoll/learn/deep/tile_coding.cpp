#include "quoll/learn/deep/tile_coding.hpp"

#include <algorithm>

#include "quoll/base/text.hpp"

namespace quoll {
namespace {

// One count for each number.
Result<std::vector<std::uint64_t>> counts_of(std::string_view text, std::size_t numbers) {
  std::vector<std::uint64_t> counts;
  for (const std::string_view word : split(text, ',')) {
    const auto count = parse_count(trim(word));
    if (!count || *count == 0 || *count > TileCoder::most_features) {
      counts.clear();
      break;
    }
    counts.push_back(*count);
  }
  if (counts.size() == 1) counts.resize(numbers, counts.front());
  if (counts.size() == numbers) return counts;
  return Error{"--tiles", 0, 0,
               "a whole number from 1 up expected, or one for each of the " +
                   std::to_string(numbers) + " observed numbers, not '" + std::string(text) + "'",
               ""};
}

}  // namespace

Result<TileCoder> TileCoder::make(std::span<const Measured> numbers, std::uint64_t tilings,
                                  std::string_view tiles) {
  const Result<std::vector<std::uint64_t>> counts = counts_of(tiles, numbers.size());
  if (!counts) return counts.error();
  TileCoder coder;
  std::uint64_t cells = 1;
  coder.axes_.resize(numbers.size());
  for (std::size_t i = numbers.size(); i-- > 0;) {
    const auto count = static_cast<double>((*counts)[i]);
    coder.axes_[i] = {numbers[i].low, count / (numbers[i].high - numbers[i].low), count,
                      static_cast<std::uint32_t>(cells)};
    cells *= (*counts)[i] + 1;  // a shifted grid needs one more to cover the range
    if (cells * tilings > most_features) {
      return Error{"--tiles", 0, 0,
                   "so many tiles for " + std::to_string(numbers.size()) +
                       " numbers are more than " + std::to_string(most_features) +
                       " features; give fewer",
                   ""};
    }
  }
  coder.tilings_ = static_cast<std::uint32_t>(tilings);
  coder.cells_ = static_cast<std::uint32_t>(cells);
  for (std::uint64_t t = 0; t < tilings; ++t) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const std::uint64_t part = t * (2 * i + 1) % tilings;
      coder.shift_.push_back(static_cast<double>(part) / static_cast<double>(tilings));
    }
  }
  return coder;
}

void TileCoder::code(std::span<const float> x, std::span<std::uint32_t> on) const {
  std::fill(on.begin(), on.end(), 0);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Axis& axis = axes_[i];
    double place = (double{x[i]} - axis.low) * axis.per_unit;
    if (!(place > 0.0)) place = 0.0;
    if (place > axis.tiles) place = axis.tiles;
    for (std::uint32_t t = 0; t < tilings_; ++t) {
      auto cell = static_cast<std::uint32_t>(place + shift_[t * axes_.size() + i]);
      on[t] += cell * axis.stride;
    }
  }
  for (std::uint32_t t = 0; t < tilings_; ++t) on[t] += t * cells_;
}

}  // namespace quoll
