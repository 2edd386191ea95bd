#include "quoll/report/curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "quoll/base/utf8.hpp"
#include "quoll/report/axis.hpp"
#include "quoll/report/progress.hpp"

namespace quoll {

namespace {

/// Dots of a chart: 2 x 4 per letter in Braille, 1 x 1 in ASCII.
class Canvas {
 public:
  Canvas(std::uint32_t columns, std::uint32_t rows, bool unicode)
      : columns_(columns), unicode_(unicode), letters_(std::size_t{columns} * rows, 0) {
    width_ = static_cast<int>(columns) * (unicode ? 2 : 1);
    height_ = static_cast<int>(rows) * (unicode ? 4 : 1);
  }
  int width() const { return width_; }
  int height() const { return height_; }

  void dot(int x, int y) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    // Braille Patterns, Unicode chapter 21.1: dots 1-3, 7 left, 4-6, 8 right.
    static constexpr unsigned char bits[4][2] = {
        {0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    const int across = unicode_ ? 2 : 1, down = unicode_ ? 4 : 1;
    letters_[static_cast<std::size_t>(y / down) * columns_ +
             static_cast<std::size_t>(x / across)] |= unicode_ ? bits[y % 4][x % 2] : 1;
  }

  void line(int x1, int y1, int x2, int y2) {
    const int steps = std::max({std::abs(x2 - x1), std::abs(y2 - y1), 1});
    for (int i = 0; i <= steps; ++i) dot(between(x1, x2, i, steps), between(y1, y2, i, steps));
  }

  std::string row(std::uint32_t r) const {
    std::string out;
    for (std::size_t c = 0; c < columns_; ++c) {
      const unsigned char bits = letters_[std::size_t{r} * columns_ + c];
      if (bits == 0) {
        out += ' ';
      } else if (unicode_) {
        encode(0x2800U + bits, out);
      } else {
        out += '*';
      }
    }
    return out.erase(out.find_last_not_of(' ') + 1);
  }

 private:
  /// The whole number nearest to a + (b - a) * i / steps; halves upwards.
  static int between(int a, int b, int i, int steps) {
    const int doubled = 2 * (a * (steps - i) + b * i) + steps;
    return doubled / (2 * steps);
  }

  std::size_t columns_;
  bool unicode_;
  int width_ = 0, height_ = 0;
  std::vector<unsigned char> letters_;
};

int place(double value, const AxisRange& range, int dots) {
  return static_cast<int>(std::lround(range.share(value) * (dots - 1)));
}

void draw(Canvas& canvas, const Curve& curve, const AxisRange& x, const AxisRange& y) {
  const CurvePoint* before = nullptr;
  for (const CurvePoint& point : curve.points) {
    if (!std::isfinite(point.value)) {
      before = nullptr;
      continue;
    }
    const auto px = [&](const CurvePoint& p) { return place(p.step, x, canvas.width()); };
    const auto py = [&](const CurvePoint& p) {
      return canvas.height() - 1 - place(p.value, y, canvas.height());
    };
    const CurvePoint& from = before ? *before : point;
    canvas.line(px(from), py(from), px(point), py(point));
    before = &point;
  }
}

/// The label of each row of the chart, "" where no tick falls.
std::vector<std::string> row_labels(const AxisRange& y, std::uint32_t rows) {
  std::vector<std::string> labels(rows);
  for (const double tick : axis_ticks(y.low, y.high, std::max(2, static_cast<int>(rows) * 2 / 3))) {
    const int row = static_cast<int>(rows) - 1 - place(tick, y, static_cast<int>(rows));
    labels[static_cast<std::size_t>(row)] = number_text(tick);
  }
  return labels;
}

/// Ticks below the chart: the line with marks, and the numbers under them.
std::string x_axis(const AxisRange& x, std::uint32_t columns, std::size_t margin, bool unicode) {
  std::vector<bool> mark(columns, false);
  std::string numbers(margin + 1, ' ');
  for (const double tick : axis_ticks(x.low, x.high, std::max(2, static_cast<int>(columns) / 8))) {
    const auto at = static_cast<std::size_t>(place(tick, x, static_cast<int>(columns)));
    const std::string label = scaled_text(tick);
    const std::size_t middle = margin + 1 + at;
    const std::size_t begin = middle - std::min(middle, label.size() / 2);
    if (begin < numbers.size() && numbers.find_first_not_of(' ') != std::string::npos) continue;
    numbers.resize(std::max(numbers.size(), begin), ' ');
    numbers.replace(begin, std::string::npos, label + " ");
    mark[at] = true;
  }
  std::string line(margin, ' ');
  line += unicode ? "└" : "+";
  for (const bool ticked : mark) line += ticked ? (unicode ? "┴" : "+") : (unicode ? "─" : "-");
  numbers.erase(numbers.find_last_not_of(' ') + 1);
  return line + "\n" + numbers + "\n";
}

}  // namespace

std::string sparkline(std::span<const double> values, std::size_t width, bool unicode) {
  static constexpr std::array<std::string_view, 8> blocks{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  static constexpr std::string_view plain = "_.-:=+*#";
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  const std::size_t letters = std::min(width, values.size());
  std::string out;
  for (std::size_t i = 0; i < letters; ++i) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t j = i * values.size() / letters; j < (i + 1) * values.size() / letters; ++j) {
      if (!std::isfinite(values[j])) continue;
      sum += values[j];
      ++count;
    }
    if (count == 0) {
      out += ' ';
      continue;
    }
    const double mean = sum / static_cast<double>(count);
    const double share = high > low ? (mean - low) / (high - low) : 0.5;
    const auto level = std::min<std::size_t>(7, static_cast<std::size_t>(share * 8));
    out += unicode ? blocks[level] : plain.substr(level, 1);
  }
  return out;
}

std::string curve_text(const Curve& curve, const TerminalStyle& style, std::uint32_t columns,
                       std::uint32_t rows) {
  const AxisRanges ranges = axis_ranges({&curve, 1}, false);
  if (ranges.points == 0) return "no points yet\n";
  const std::vector<std::string> labels = row_labels(ranges.y, rows);
  std::size_t margin = 0;
  for (const std::string& label : labels) margin = std::max(margin, label.size() + 1);
  if (style.width > 0) {
    const auto taken = static_cast<std::uint32_t>(margin + 2);
    columns = std::min(columns, style.width > taken + 10 ? style.width - taken : 10U);
  }
  Canvas canvas(columns, rows, style.unicode);
  draw(canvas, curve, ranges.x, ranges.y);
  std::string out = curve.name.empty() ? "" : curve.name + "\n";
  for (std::uint32_t r = 0; r < rows; ++r) {
    const std::string& label = labels[r];
    std::string line(margin - 1 - label.size(), ' ');
    line += label + " ";
    const bool ticked = !label.empty();
    line += style.unicode ? (ticked ? "┤" : "│") : (ticked ? "+" : "|");
    const std::string dots = canvas.row(r);
    out += line + dots + "\n";
  }
  return out + x_axis(ranges.x, columns, margin, style.unicode);
}

}  // namespace quoll
