// Grid worlds as text: "key = value" lines, a line "map", a picture in letters (docs/worlds.md).

#include "quoll/model/grid.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/lines.hpp"

namespace quoll {
namespace {

constexpr std::array<std::string_view, 6> keys = {"moves",    "slip",     "move_reward",
                                                  "discount", "terminal", "reward.X"};
constexpr std::string_view reward_key = "reward.";

// The key of a "key = value" line: small letters and '_', or reward. and one letter. Picture rows
// with
// '=' do not look like this.
std::optional<std::string_view> key_of(std::string_view line) {
  std::size_t equals = line.find('=');
  // In "reward.= = 5" the first '=' is the letter.
  if (equals != std::string_view::npos && trim(line.substr(0, equals)) == reward_key) {
    equals = line.find('=', equals + 1);
  }
  if (equals == std::string_view::npos) return std::nullopt;
  const std::string_view key = trim(line.substr(0, equals));
  const std::string_view word = key.substr(0, std::min(key.find('.'), key.size()));
  if (word.size() < 2) return std::nullopt;
  for (const char letter : word) {
    if (!(letter >= 'a' && letter <= 'z') && letter != '_') return std::nullopt;
  }
  return key;
}

class GridReader {
 public:
  GridReader(std::string_view content, const std::string& path) : lines_(content), path_(path) {}

  Result<Grid> read(std::uint64_t& first_row) {
    bool in_map = false;
    std::string_view line;
    while (lines_.next(line)) {
      if (!in_map) {
        const std::string_view text = trim(line);
        if (text.empty() || text.front() == '%') continue;
        if (text == "map") {
          in_map = true;
          continue;
        }
        if (const auto key = key_of(line)) {
          if (!read_setting(line, *key)) return error_;
          continue;
        }
        in_map = true;
      }
      if (grid_.rows.empty()) first_row = lines_.number();
      add_row(line);
    }
    if (!lines_.error().empty()) return Error{path_, lines_.number(), 0, lines_.error(), ""};
    while (!grid_.rows.empty() && grid_.rows.back().empty()) grid_.rows.pop_back();
    if (grid_.rows.empty()) {
      return Error{path_, 0, 0, "expected a picture of the grid, with # . S G P", ""};
    }
    return std::move(grid_);
  }

 private:
  void add_row(std::string_view line) {
    std::string& row = grid_.rows.emplace_back(line);
    for (char& letter : row) {
      if (letter == ' ') letter = '.';
    }
  }

  bool fail(std::size_t column, std::string expected, std::string near = "") {
    error_ = {path_, lines_.number(), column, std::move(expected), std::move(near)};
    return false;
  }

  bool read_setting(std::string_view line, std::string_view key) {
    const std::size_t key_column = static_cast<std::size_t>(key.data() - line.data()) + 1;
    const std::size_t after = line.find('=', key_column - 1 + key.size()) + 1;
    const std::string_view value = trim(line.substr(after));
    const std::size_t column = after + 1;
    if (!seen_.emplace(key).second) {
      return fail(key_column, "expected one '" + std::string(key) + "', found a second");
    }
    if (key == "terminal") {
      grid_.terminal.clear();
      for (const char letter : value) {
        if (letter == ' ' || letter == '\t' || letter == ',') continue;
        if (grid_.terminal.find(letter) == std::string::npos) grid_.terminal += letter;
      }
      return true;
    }
    const bool is_reward = key.size() == reward_key.size() + 1 && key.starts_with(reward_key);
    if (!is_reward && std::find(keys.begin(), keys.end() - 1, key) == keys.end() - 1) {
      return fail(
          key_column,
          "expected moves, slip, move_reward, discount, terminal or reward.LETTER, found '" +
              std::string(key) + "'",
          nearest(key, keys));
    }
    const auto number = parse_number(value);
    if (!number) return fail(column, "expected a number for " + std::string(key));
    if (is_reward) {
      const char letter = key.back();
      if (letter == '#') return fail(key_column, "expected no reward for walls");
      grid_.reward[letter] = *number;
    } else if (key == "moves") {
      if (*number != 4 && *number != 8) return fail(column, "expected moves = 4 or 8");
      grid_.moves = static_cast<std::uint32_t>(*number);
    } else if (key == "slip") {
      if (!(*number >= 0 && *number <= 1)) return fail(column, "expected a slip from 0 to 1");
      grid_.slip = *number;
    } else if (key == "move_reward") {
      grid_.move_reward = *number;
    } else {
      grid_.discount = *number;
    }
    return true;
  }

  Lines lines_;
  const std::string& path_;
  Grid grid_;
  std::set<std::string> seen_;
  Error error_;
};

}  // namespace

Result<Grid> parse_grid(std::string_view content, const std::string& path,
                        std::uint64_t& first_row) {
  return GridReader(content, path).read(first_row);
}

Result<MdpArrays> read_grid(std::string_view content, const std::string& path) {
  std::uint64_t first_row = 1;
  const auto grid = parse_grid(content, path, first_row);
  if (!grid) return grid.error();
  auto arrays = to_arrays(*grid);
  if (arrays) return arrays;
  Error error = arrays.error();
  error.file = path;
  if (error.line > 0) error.line += first_row - 1;
  return error;
}

std::string to_text(const Grid& grid) {
  std::string text;
  text += "moves = " + std::to_string(grid.moves) + "\n";
  text += "slip = " + shortest(grid.slip) + "\n";
  text += "move_reward = " + shortest(grid.move_reward) + "\n";
  text += "discount = " + shortest(grid.discount) + "\n";
  for (const auto& [letter, reward] : grid.reward) {
    text += std::string("reward.") + letter + " = " + shortest(reward) + "\n";
  }
  text += "terminal = " + grid.terminal + "\nmap\n";
  const std::size_t columns = grid.rows.empty() ? 0 : grid.rows.front().size();
  text.reserve(text.size() + grid.rows.size() * (columns + 1));
  for (const std::string& row : grid.rows) {
    text += row;
    text += '\n';
  }
  return text;
}

}  // namespace quoll
