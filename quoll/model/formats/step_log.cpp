#include "quoll/model/formats/step_log.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "quoll/base/text.hpp"

namespace quoll {
namespace {

constexpr std::array<std::string_view, 6> column_names = {"state",      "action",     "reward",
                                                          "next_state", "terminated", "truncated"};
constexpr std::string_view header = "state,action,reward,next_state,terminated,truncated";

std::string in_quotes(std::string_view text) {
  constexpr std::size_t most = 60;
  return "'" + std::string(text.substr(0, most)) + (text.size() > most ? "...'" : "'");
}

// A row of nothing but commas, as spreadsheets leave them.
bool is_blank(std::string_view line) {
  return trim(line).find_first_not_of(", \t") == std::string_view::npos;
}

}  // namespace

bool StepLog::fail(std::size_t column, std::string expected, std::string nearest) {
  error_ = {path_, lines_.number(), column, std::move(expected), std::move(nearest)};
  return false;
}

Error StepLog::fault(Column column, std::string expected, std::string nearest) const {
  return {path_, lines_.number(), given(column) ? fields_.at[place_[column]] + 1 : 0,
          std::move(expected), std::move(nearest)};
}

bool StepLog::next(LoggedStep& step) {
  std::string_view line;
  while (!error_ && lines_.next(line)) {
    if (is_blank(line)) continue;
    if (columns_ > 0) return read_row(line, step);
    if (trim(line).front() != '#' && !read_header(line)) return false;
  }
  if (error_) return false;
  if (!lines_.error().empty()) return fail(0, lines_.error());
  if (columns_ == 0) return fail(0, "the header " + std::string(header) + " expected");
  return false;
}

bool StepLog::read_header(std::string_view line) {
  const std::string expected = "the header " + std::string(header) + " expected";
  if (const auto quote = fields_.split(line)) return fail(*quote + 1, expected);
  if (fields_.count > Fields::most) {
    return fail(0, "at most " + std::to_string(Fields::most) + " columns expected, not " +
                       std::to_string(fields_.count));
  }
  place_.fill(Fields::most);
  Error stranger;
  for (std::size_t i = 0; i < fields_.count; ++i) {
    const std::string_view name = fields_.text[i];
    const auto at =
        static_cast<std::size_t>(std::ranges::find(column_names, name) - column_names.begin());
    if (at == column_names.size()) {
      const std::string near = nearest(name, column_names);
      if (!near.empty() && stranger.column == 0) {
        stranger = {path_, lines_.number(), fields_.at[i] + 1, std::string(name), near};
      }
    } else if (given(static_cast<Column>(at))) {
      return fail(fields_.at[i] + 1, "one column " + in_quotes(name) + " expected, not two");
    } else {
      place_[at] = i;
    }
  }
  if (std::count(place_.begin(), place_.end(), Fields::most) == 6) {
    return fail(1, expected + ", not " + in_quotes(line));
  }
  for (std::size_t i = state; i <= terminated; ++i) {
    if (given(static_cast<Column>(i))) continue;
    const bool misspelt = stranger.nearest == column_names[i];
    return fail(misspelt ? stranger.column : 0,
                "a column " + in_quotes(column_names[i]) + " expected" +
                    (misspelt ? ", not " + in_quotes(stranger.expected) : ""));
  }
  columns_ = fields_.count;
  return true;
}

bool StepLog::read_flag(Column column, bool& flag) {
  const std::string_view text = field(column);
  flag = text == "1" || text == "true" || text == "True";
  if (flag || text == "0" || text == "false" || text == "False") return true;
  error_ = fault(column, "0, 1, false or true expected for " + std::string(column_names[column]) +
                             ", not " + in_quotes(text));
  return false;
}

bool StepLog::read_row(std::string_view line, LoggedStep& step) {
  if (const auto quote = fields_.split(line)) {
    return fail(*quote + 1, "a field in quotes that ends on its line expected");
  }
  if (fields_.count != columns_) {
    return fail(0, counted(columns_, "field") + " expected, as in the header, not " +
                       std::to_string(fields_.count));
  }
  const std::optional<double> number = parse_short_number(field(reward));
  if (!number || !std::isfinite(*number)) {
    error_ =
        fault(reward, "a finite number expected for the reward, not " + in_quotes(field(reward)));
    return false;
  }
  step = {field(state), field(action), field(next_state), *number, false, false};
  if (!read_flag(terminated, step.terminated)) return false;
  if (given(truncated) && !read_flag(truncated, step.truncated)) return false;
  for (const Column column : {state, action, next_state}) {
    if (!field(column).empty() || (column == next_state && step.terminated)) continue;
    error_ = fault(column, "a name expected for the " + std::string(column_names[column]));
    return false;
  }
  return true;
}

}  // namespace quoll
