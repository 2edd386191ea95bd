#include "quoll/report/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "quoll/base/utf8.hpp"

namespace quoll {

namespace {

/// Columns before the decimal point (or the end of the digits) and from there on.
struct PointSplit {
  std::size_t before = 0, after = 0;
};

PointSplit point_split(std::string_view cell) {
  const std::size_t point = cell.find('.');
  if (point == std::string_view::npos) return {display_width(cell), 0};
  return {display_width(cell.substr(0, point)), display_width(cell.substr(point))};
}

struct Widths {
  std::size_t whole = 0;
  PointSplit point;
};

Widths widths_of(const TextTable::Column& column, std::size_t index,
                 const std::vector<std::vector<std::string>>& rows) {
  Widths widths;
  for (const auto& row : rows) {
    if (index >= row.size()) continue;
    const PointSplit split = point_split(row[index]);
    widths.point.before = std::max(widths.point.before, split.before);
    widths.point.after = std::max(widths.point.after, split.after);
    widths.whole = std::max(widths.whole, display_width(row[index]));
  }
  if (column.align == TextTable::Align::point) {
    widths.whole = widths.point.before + widths.point.after;
  }
  widths.whole = std::max(widths.whole, display_width(column.title));
  return widths;
}

void append_cell(std::string& line, std::string_view cell, TextTable::Align align,
                 const Widths& widths) {
  std::size_t right = 0;
  if (align == TextTable::Align::point && !cell.empty()) {
    right = widths.point.after - std::min(widths.point.after, point_split(cell).after);
  }
  const std::size_t room = widths.whole - std::min(widths.whole, display_width(cell) + right);
  if (align != TextTable::Align::left) line.append(room, ' ');
  line += cell;
  line.append(align == TextTable::Align::left ? room : right, ' ');
}

void append_line(std::string& out, std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  out += line;
  out += '\n';
}

}  // namespace

std::string number_text(double value) {
  std::string text = fmt::format("{:.6g}", value);
  return text == "-0" ? "0" : text;
}

std::string TextTable::text() const {
  std::vector<Widths> widths;
  bool titled = false;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    widths.push_back(widths_of(columns_[i], i, rows_));
    titled = titled || !columns_[i].title.empty();
  }
  std::string out;
  if (titled) {
    std::string line;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (i > 0) line += "  ";
      const Align align = columns_[i].align == Align::left ? Align::left : Align::right;
      append_cell(line, columns_[i].title, align, widths[i]);
    }
    append_line(out, std::move(line));
  }
  for (const auto& row : rows_) {
    std::string line;
    for (std::size_t i = 0; i < columns_.size() && i < row.size(); ++i) {
      if (i > 0) line += "  ";
      append_cell(line, row[i], columns_[i].align, widths[i]);
    }
    append_line(out, std::move(line));
  }
  return out;
}

}  // namespace quoll
