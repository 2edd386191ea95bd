#pragma once
// Logs of steps that somebody took: a table with the columns state, action, reward, next_state,
// terminated and, if it likes, truncated, in any order among others (docs/logs.md). One line of
// memory, however long the file.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "quoll/base/error.hpp"
#include "quoll/model/formats/fields.hpp"
#include "quoll/model/formats/lines.hpp"

namespace quoll {

/// A row: names as they stand in the file.
struct LoggedStep {
  std::string_view state, action, next_state;  ///< next_state may be empty after an end
  double reward = 0.0;                         ///< finite
  bool terminated = false, truncated = false;
};

class StepLog {
 public:
  enum Column : std::size_t { state, action, reward, next_state, terminated, truncated };

  /// Reads from `lines`, which must outlive this; `path` is what errors call them.
  StepLog(Lines& lines, std::string path) : lines_(lines), path_(std::move(path)) {}

  /// The next row, valid until the next call; false at the end, or at the first row that is none
  /// (see error()). Cost: one pass over the line.
  bool next(LoggedStep& step);

  /// Why next() stopped before the end; nothing when it did not.
  const std::optional<Error>& error() const { return error_; }
  /// An error about this field of the row that next() gave last.
  Error fault(Column column, std::string expected, std::string nearest = "") const;

 private:
  bool fail(std::size_t column, std::string expected, std::string nearest = "");
  bool read_header(std::string_view line);
  bool read_row(std::string_view line, LoggedStep& step);
  bool read_flag(Column column, bool& flag);
  bool given(Column column) const { return place_[column] < Fields::most; }
  std::string_view field(Column column) const { return fields_.text[place_[column]]; }

  Lines& lines_;
  std::string path_;
  Fields fields_;
  std::array<std::size_t, 6> place_{};  // of each column; Fields::most = it is not there
  std::size_t columns_ = 0;             // 0 = the header was not read yet
  std::optional<Error> error_;
};

}  // namespace quoll
