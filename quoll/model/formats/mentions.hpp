#pragma once
// Lists of names on a property line of a CSV world: "# start = HALL:0.7 "BIG HALL":0.3".

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/base/error.hpp"

namespace quoll {

/// One name as NAME, NAME:WEIGHT, "NAME" or "NAME":WEIGHT. Whether a colon outside quotes belongs
/// to the name can only be told when all names are known; `text` holds it.
struct Mention {
  std::string text;
  bool quoted = false;
  std::optional<double> weight;  ///< only of a quoted name
  std::uint64_t line = 0;
  std::size_t column = 0;
};

/// The names in line[from..], between blanks or commas, put behind `to`. Errors have line and
/// column.
Result<void> parse_mentions(std::string_view line, std::size_t from, std::uint64_t number,
                            std::vector<Mention>& to);

/// Writes property lines "# key = name name ...", over several lines if there are many names.
class MentionWriter {
 public:
  MentionWriter(std::string& out, std::string_view key) : out_(out), key_(key) {}
  void add(std::string_view name, std::optional<double> weight = std::nullopt);
  void end();

 private:
  std::string& out_;
  std::string_view key_;
  std::size_t count_ = 0;
};

}  // namespace quoll
