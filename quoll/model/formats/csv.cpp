// Worlds as tables of transitions: state,action,next_state,probability,reward (docs/worlds.md). A
// file passes through one block of memory, twice: once to count its lines, so that no array has to
// grow.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/fields.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/lines.hpp"
#include "quoll/model/formats/mentions.hpp"
#include "quoll/model/letters.hpp"
#include "quoll/model/name_index.hpp"
#include "quoll/model/rows.hpp"

namespace quoll {
namespace {

enum Column : std::size_t { state, action, next_state, probability, reward };
constexpr std::array<std::string_view, 5> column_names = {"state", "action", "next_state",
                                                          "probability", "reward"};
constexpr std::array<std::string_view, 5> property_names = {"discount", "alternating", "start",
                                                            "terminal", "actions"};
constexpr std::string_view header = "state,action,next_state,probability,reward";
constexpr double default_discount = 0.95;
constexpr std::uint64_t most_rows = 0xffffffff;

std::string in_quotes(std::string_view text) {
  constexpr std::size_t most = 60;
  return "'" + std::string(text.substr(0, most)) + (text.size() > most ? "...'" : "'");
}

class CsvReader {
 public:
  CsvReader(Lines& lines, const std::string& path)
      : lines_(lines), path_(path), rows_(lines.count()) {}

  Result<MdpArrays> read();

 private:
  bool fail(std::size_t column, std::string expected, std::string near = "");
  bool read_property(std::string_view line);
  bool read_mentions(std::string_view line, std::size_t from, std::vector<Mention>& to);
  bool read_header(std::string_view line);
  bool read_row(std::string_view line);
  bool read_number(Column column, double& value);
  bool number_of(Column column, NameIndex& index, std::uint32_t& number);
  bool check_name(std::string_view name, std::uint64_t line, std::size_t column);
  bool put_next();
  bool take_next();
  bool find_mentioned(const Mention& mention, State& found, double& weight);
  bool finish(MdpArrays& arrays);
  bool finish_start(MdpArrays& arrays);
  std::string_view field(Column column) const { return fields_.text[place_[column]]; }
  std::size_t column_of(Column column) const { return fields_.at[place_[column]] + 1; }

  struct Successor {
    std::string name;
    NameIndex::Key key;
    std::uint64_t line;
    std::size_t column;
  };

  Lines& lines_;
  const std::string& path_;
  MdpRows rows_;
  NameIndex states_, actions_;
  Fields fields_;
  std::array<std::size_t, 5> place_{};
  std::string last_state_, last_action_;  // the names of the row before: rows come in groups
  std::uint32_t state_ = 0, action_ = 0;
  std::array<Successor, 16> queue_;
  std::size_t first_waiting_ = 0, waiting_ = 0;
  std::optional<double> discount_;
  bool alternating_ = false;
  std::vector<Mention> start_, terminal_, first_actions_;
  std::vector<std::uint32_t> index_;  // per number in states_: index in the model
  Error error_;
};

bool CsvReader::fail(std::size_t column, std::string expected, std::string near) {
  error_ = {path_, lines_.number(), column, std::move(expected), std::move(near)};
  return false;
}

Result<MdpArrays> CsvReader::read() {
  bool in_rows = false;
  std::string_view line;
  while (lines_.next(line)) {
    if (trim(line).empty()) continue;
    if (in_rows) {
      if (!read_row(line)) return error_;
    } else if (trim(line).front() == '#') {
      if (!read_property(line)) return error_;
    } else {
      if (!read_header(line)) return error_;
      in_rows = true;
    }
  }
  if (!lines_.error().empty()) return Error{path_, lines_.number(), 0, lines_.error(), ""};
  if (!in_rows) return Error{path_, 0, 0, "expected the header line " + std::string(header), ""};
  if (states_.size() == 0) {
    return Error{path_, lines_.number(), 0, "expected at least one row below the header", ""};
  }
  while (waiting_ > 0) {
    if (!take_next()) return error_;
  }
  MdpArrays arrays = rows_.finish(states_.size(), index_);
  if (!finish(arrays)) return error_;
  return arrays;
}

// "# key = value" above the header; any other line with '#' is a comment.
bool CsvReader::read_property(std::string_view line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return true;
  const std::size_t mark = line.find('#');
  const std::string_view key = trim(line.substr(mark + 1, equals - mark - 1));
  if (key == "start") return read_mentions(line, equals + 1, start_);
  if (key == "terminal") return read_mentions(line, equals + 1, terminal_);
  if (key == "actions") {
    if (!read_mentions(line, equals + 1, first_actions_)) return false;
    for (const Mention& mention : first_actions_) {
      if (!check_name(mention.text, mention.line, mention.column)) return false;
      actions_.insert(mention.text);
    }
    return true;
  }
  const std::size_t column = static_cast<std::size_t>(key.data() - line.data()) + 1;
  if (key == "discount") {
    if (discount_) return fail(column, "expected one discount, found a second");
    discount_ = parse_number(trim(line.substr(equals + 1)));
    if (!discount_) return fail(equals + 2, "expected a number after 'discount ='");
    return true;
  }
  if (key == "alternating") {
    const std::string_view value = trim(line.substr(equals + 1));
    alternating_ = value == "true";
    if (alternating_ || value == "false") return true;
    return fail(equals + 2, "expected true or false after 'alternating ='");
  }
  const std::string near = nearest(key, property_names);
  if (!near.empty()) {
    return fail(
        column,
        "expected discount, alternating, start, terminal or actions, found " + in_quotes(key),
        near);
  }
  return true;
}

bool CsvReader::read_mentions(std::string_view line, std::size_t from, std::vector<Mention>& to) {
  const auto parsed = parse_mentions(line, from, lines_.number(), to);
  if (parsed) return true;
  error_ = parsed.error();
  error_.file = path_;
  return false;
}

bool CsvReader::read_header(std::string_view line) {
  const std::string expected = "expected the header line " + std::string(header);
  if (const auto quote = fields_.split(line)) return fail(*quote + 1, expected);
  std::array<bool, 5> found{};
  bool any = false;
  for (std::size_t i = 0; i < std::min(fields_.count, Fields::most); ++i) {
    any = any || std::find(column_names.begin(), column_names.end(), fields_.text[i]) !=
                     column_names.end();
  }
  if (!any) return fail(1, expected + ", found " + in_quotes(line));
  for (std::size_t i = 0; i < std::min(fields_.count, Fields::most); ++i) {
    const std::string_view name = fields_.text[i];
    const auto at = static_cast<std::size_t>(
        std::find(column_names.begin(), column_names.end(), name) - column_names.begin());
    if (at == column_names.size()) {
      return fail(fields_.at[i] + 1,
                  "expected only the columns " + std::string(header) + ", found " + in_quotes(name),
                  nearest(name, column_names));
    }
    if (found[at]) return fail(fields_.at[i] + 1, "expected one column " + in_quotes(name));
    found[at] = true;
    place_[at] = i;
  }
  for (std::size_t i = 0; i < column_names.size(); ++i) {
    if (!found[i]) return fail(0, "expected a column " + in_quotes(column_names[i]));
  }
  return true;
}

// The number of the name in this column, which is new or known.
bool CsvReader::number_of(Column column, NameIndex& index, std::uint32_t& number) {
  const std::string_view name = field(column);
  const std::uint32_t before = index.size();
  number = index.insert(name);
  if (number < before) return true;
  return check_name(name, lines_.number(), column_of(column));
}

// A name is checked once, when it is new.
bool CsvReader::check_name(std::string_view name, std::uint64_t line, std::size_t column) {
  if (const std::string_view reason = name_fault(name); !reason.empty()) {
    error_ = {path_, line, column, std::string(reason), ""};
    return false;
  }
  if (states_.size() <= max_states && actions_.size() <= max_states) return true;
  error_ = {path_, line, column, "expected below 2^31 states and actions", ""};
  return false;
}

// The successor of this row waits its turn while its place in the table is loaded. The order of
// first mention among names that are only successors does not change by waiting.
bool CsvReader::put_next() {
  if (waiting_ == queue_.size() && !take_next()) return false;
  Successor& last = queue_[(first_waiting_ + waiting_) % queue_.size()];
  last.name = field(next_state);
  last.key = states_.prefetch(last.name);
  last.line = lines_.number();
  last.column = column_of(next_state);
  ++waiting_;
  return true;
}

bool CsvReader::take_next() {
  const Successor& first = queue_[first_waiting_];
  const std::uint32_t before = states_.size();
  const std::uint32_t number = states_.insert(first.name, first.key);
  rows_.add_next(number);
  first_waiting_ = (first_waiting_ + 1) % queue_.size();
  --waiting_;
  return number < before || check_name(first.name, first.line, first.column);
}

bool CsvReader::read_number(Column column, double& value) {
  const auto number = parse_short_number(field(column));
  if (!number) {
    return fail(column_of(column), "expected a number for the " +
                                       std::string(column_names[column]) + ", found " +
                                       in_quotes(field(column)));
  }
  value = *number;
  return true;
}

bool CsvReader::read_row(std::string_view line) {
  if (const auto quote = fields_.split(line)) {
    return fail(*quote + 1, "expected a field in quotes that ends on its line");
  }
  if (fields_.count != column_names.size()) {
    return fail(0, "expected 5 fields as in the header, found " + std::to_string(fields_.count));
  }
  const bool no_action = field(action).empty();
  const bool no_next = field(next_state).empty();
  if (field(state).empty()) {
    // Spreadsheets leave rows of nothing but commas.
    if (trim(line).find_first_not_of(", \t") == std::string_view::npos) return true;
    return fail(column_of(state), "expected a state");
  }
  if (field(state) != last_state_) {
    if (!number_of(state, states_, state_)) return false;
    last_state_ = field(state);
    last_action_.clear();
  }
  if (no_action && no_next) {
    for (const Column column : {probability, reward}) {
      if (!field(column).empty()) {
        return fail(column_of(column), "expected nothing more in a row that only names a state");
      }
    }
    rows_.declare(state_);
    return true;
  }
  if (no_action) return fail(column_of(action), "expected an action");
  if (no_next) return fail(column_of(next_state), "expected a next state");
  if (field(action) != last_action_) {
    if (!number_of(action, actions_, action_)) return false;
    last_action_ = field(action);
  }
  double p = 0;
  double r = 0;
  if (!read_number(probability, p) || !read_number(reward, r)) return false;
  if (rows_.size() == most_rows) return fail(0, "expected at most 2^32 - 1 rows");
  rows_.add(state_, action_, p, r, lines_.number());
  return put_next();
}

// A bare A:0.5 may be a name as it stands; if not, the part behind the last colon is a weight.
bool CsvReader::find_mentioned(const Mention& mention, State& found, double& weight) {
  auto number = states_.find(mention.text);
  std::optional<double> written = mention.weight;
  const std::size_t colon = mention.text.rfind(':');
  if (!number && !mention.quoted && colon != std::string::npos) {
    number = states_.find(std::string_view(mention.text).substr(0, colon));
    written = parse_number(std::string_view(mention.text).substr(colon + 1));
    if (number && !written) number.reset();
  }
  if (!number) {
    constexpr std::uint32_t most_compared = 100'000;
    Nearest near(mention.text);
    for (std::uint32_t i = 0; i < std::min(states_.size(), most_compared); ++i) {
      near.offer(states_[i]);
    }
    error_ = {path_, mention.line, mention.column,
              "expected a state that the rows name, found " + in_quotes(mention.text), near.best()};
    return false;
  }
  if (written && !(*written > 0 && std::isfinite(*written))) {
    error_ = {path_, mention.line, mention.column, "expected a weight above 0", ""};
    return false;
  }
  weight = written.value_or(-1);
  found = index_[*number];
  return true;
}

bool CsvReader::finish_start(MdpArrays& arrays) {
  if (start_.size() == 1 && start_.front().text == "uniform" && !states_.find("uniform")) {
    return true;
  }
  std::vector<std::pair<State, double>> start;
  double total = 0;
  for (const Mention& mention : start_) {
    State found = 0;
    double weight = 0;
    if (!find_mentioned(mention, found, weight)) return false;
    if (!start.empty() && (weight < 0) != (start.front().second < 0)) {
      error_ = {path_, mention.line, mention.column,
                "expected a weight for each start state or for none", ""};
      return false;
    }
    start.emplace_back(found, weight);
    total += weight;
  }
  std::sort(start.begin(), start.end());
  for (const auto& [found, weight] : start) {
    const bool again = !arrays.start.empty() && arrays.start.back() == found;
    if (!again) arrays.start.push_back(found);
    if (weight < 0) continue;
    // Weights that are probabilities already keep their bits.
    const double share = std::abs(total - 1) <= 1e-9 ? weight : weight / total;
    if (again) {
      arrays.start_probability.back() += share;
    } else {
      arrays.start_probability.push_back(share);
    }
  }
  return true;
}

bool CsvReader::finish(MdpArrays& arrays) {
  if (!finish_start(arrays)) return false;
  for (const Mention& mention : terminal_) {
    State found = 0;
    double weight = 0;
    if (!find_mentioned(mention, found, weight)) return false;
    arrays.terminal.push_back(found);
  }
  std::sort(arrays.terminal.begin(), arrays.terminal.end());
  arrays.terminal.erase(std::unique(arrays.terminal.begin(), arrays.terminal.end()),
                        arrays.terminal.end());
  arrays.discount = discount_.value_or(default_discount);
  arrays.alternating = alternating_;
  const bool ordered = std::is_sorted(index_.begin(), index_.end());
  arrays.state_names = states_.take(ordered ? std::span<const std::uint32_t>() : index_);
  arrays.action_names = actions_.take({});
  return true;
}

}  // namespace

Result<MdpArrays> read_csv(std::string_view content, const std::string& path) {
  Lines lines(content);
  return CsvReader(lines, path).read();
}

Result<MdpArrays> read_csv_path(const std::string& path, const Parameters&) {
  auto lines = Lines::open(path);
  if (!lines) return lines.error();
  return CsvReader(*lines, path).read();
}

}  // namespace quoll
