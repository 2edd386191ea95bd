#pragma once
// Aligned text tables, and the tables of named values they serve.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

/// How a terminal takes text; the caller finds out (TTY, NO_COLOR, --ascii, locale).
struct TerminalStyle {
  std::uint32_t width = 80;  ///< columns; 0 = unlimited
  bool unicode = true;       ///< false: plain ASCII
  bool color = false;        ///< ANSI 256-colour escape sequences
};

/// A number for people: 6 significant digits, no trailing zeros, never "-0".
std::string number_text(double value);

class TextTable {
 public:
  enum class Align : std::uint8_t {
    left,
    right,
    point
  };  ///< point: decimal points below each other
  struct Column {
    std::string title;
    Align align = Align::left;
  };

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// Adds a row; missing cells are empty.
  void row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  void blank_line() { rows_.emplace_back(); }

  /// The lines, two blanks between columns, no trailing blanks; a line of titles first if there is
  /// one that is not empty.
  std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// A further column of numbers per choice beside Q.
struct ChoiceColumn {
  std::string title;
  std::span<const double> values;  ///< per choice
};

/// What a Q table shows; all spans but those marked "per state" are per choice, and may be empty
/// (then their column is left out).
struct QTableView {
  const Mdp* mdp = nullptr;
  std::span<const double> q;
  bool q_is_float = true;  ///< q holds floats: rounded as such before it is printed
  std::span<const double> q_star;
  std::span<const std::uint32_t> visits;
  std::span<const Action> policy;  ///< per state; empty = greedy by q
  std::vector<ChoiceColumn> more;  ///< e.g. the standard rule beside the printed one
  std::string q_title = "Q";
  std::optional<std::uint64_t> marked;                    ///< a choice to point at with `mark`
  std::string mark;                                       ///< e.g. "<- first difference"
  std::uint64_t states = 20;                              ///< at most so many states; 0 = all
  std::string_view rest = "use --json --all or -o FILE";  ///< advice when states are left out
};

/// One block per state, one line per action: Q, true Q*, visits. '*' marks the actions of largest
/// Q,
/// "<- best" the policy's. Cost: the states shown.
std::string q_table(const QTableView& view);

/// What a table of values shows.
struct ValueTableView {
  const Mdp* mdp = nullptr;
  std::span<const double> lower, upper;   ///< per state
  std::string title = "V*";               ///< what the values are
  std::span<const Action> policy;         ///< per state; may be empty
  std::span<const std::uint8_t> optimal;  ///< per choice, 1 = optimal; may be empty
  std::uint64_t states = 20;              ///< at most so many; 0 = all
  std::string_view rest = "use --json --all or -o FILE";
};

/// One line per state: its value (or interval where lower and upper differ in print), the policy's
/// action, and the other optimal actions.
std::string value_table(const ValueTableView& view);

}  // namespace quoll
