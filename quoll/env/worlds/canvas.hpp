#pragma once
// A small page of letters for the text forms of worlds that move in the plane.

#include <cstddef>
#include <string>
#include <vector>

namespace quoll {

class Canvas {
 public:
  Canvas(int width, int height)
      : rows_(static_cast<std::size_t>(height), std::string(static_cast<std::size_t>(width), ' ')) {
  }

  /// The letter in column x and row y (down); what lies outside is left out.
  void put(double x, double y, char letter) {
    const double column = x + 0.5, row = y + 0.5;
    if (!(column >= 0.0 && row >= 0.0 && row < static_cast<double>(rows_.size()) &&
          column < static_cast<double>(rows_[0].size()))) {
      return;
    }
    rows_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = letter;
  }
  /// Letters from one point to another, both included.
  void line(double x0, double y0, double x1, double y1, char letter) {
    constexpr int pieces = 24;
    for (int i = 0; i <= pieces; ++i) {
      const double share = static_cast<double>(i) / pieces;
      put(x0 + share * (x1 - x0), y0 + share * (y1 - y0), letter);
    }
  }
  void write(double x, double y, const std::string& letters) {
    for (std::size_t i = 0; i < letters.size(); ++i) {
      put(x + static_cast<double>(i), y, letters[i]);
    }
  }
  /// The lines without blanks at their ends.
  std::string text() const {
    std::string all;
    for (const std::string& row : rows_) all += row.substr(0, row.find_last_not_of(' ') + 1) + '\n';
    return all;
  }

 private:
  std::vector<std::string> rows_;
};

/// "-0.123": the number rounded to the thousandth, for a line of text.
inline std::string thousandths(double value) {
  if (!(value > -1e15 && value < 1e15)) return "far";
  const double scaled = value * 1000.0;
  auto whole = static_cast<long long>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
  std::string digits = std::to_string(whole < 0 ? -whole : whole);
  if (digits.size() < 4) digits.insert(0, 4 - digits.size(), '0');
  return (whole < 0 ? "-" : "") + digits.substr(0, digits.size() - 3) + "." +
         digits.substr(digits.size() - 3);
}

}  // namespace quoll
