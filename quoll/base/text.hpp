#pragma once
// Small text tools: numbers as people write them, and the nearest known name to a misspelt one.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quoll {

/// `text` without leading and trailing blanks.
std::string_view trim(std::string_view text);

/// The pieces of `text` between separators, each trimmed; "" gives one empty piece.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The whole of `text` as a finite or infinite decimal number, also a fraction "1/3"; independent
/// of the locale. Nothing when any letter is left over or a double cannot hold it (1e400).
std::optional<double> parse_number(std::string_view text);

/// The whole of `text` as an unsigned integer below 2^64, also "1e6" and "2_000".
std::optional<std::uint64_t> parse_count(std::string_view text);

/// The fewest digits that read back as the same number: "0.1", "100000", "1e+30", "inf", "nan";
/// with an exponent below 1e-4 and from 1e16.
std::string shortest(double value);
std::string shortest(float value);

/// The name with the smallest edit distance to `word` (transpositions count 1), if it is near
/// enough to be a slip of the hand: at most 1 + length / 4 edits. Empty otherwise. Case does not
/// count, nor '-' for '_'; of equally near names the first one.
std::string nearest(std::string_view word, std::span<const std::string_view> names);
std::string nearest(std::string_view word, std::span<const std::string> names);

/// "1,234,567" for people.
std::string grouped(std::uint64_t value);

/// "1 step", "2,000 steps": a count with its noun.
std::string counted(std::uint64_t value, std::string_view noun);

/// The nearest-name search over names that are made on demand.
class Nearest {
 public:
  explicit Nearest(std::string_view word);
  void offer(std::string_view name);
  std::string best() const;

 private:
  std::string word_, best_;
  std::size_t distance_;
};

}  // namespace quoll
