#pragma once
// The names of states or actions: stored text in one block, or made by rule for worlds of a million
// cells. A name is made when somebody looks at it.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quoll {

class Names {
 public:
  /// No names.
  Names() = default;

  /// `count` names "0", "1", ... with a prefix.
  static Names numbered(std::string prefix, std::uint64_t count);

  /// Names "r3c14" for cells of a grid `columns` wide; `cells[i]` = row * columns + column of name
  /// i.
  static Names cells(std::uint32_t columns, std::vector<std::uint32_t> cells);

  /// Stored names, one after the other; offsets has one more entry than there are names.
  static Names stored(std::string text, std::vector<std::uint64_t> offsets);

  std::uint64_t size() const;
  std::string operator[](std::uint64_t index) const;

  /// Index of a name, or nothing. Linear in the number of names for stored names.
  std::optional<std::uint64_t> find(std::string_view name) const;

  /// The known name nearest to a misspelt one, or "" (also when there are over 100,000 names).
  std::string nearest(std::string_view name) const;

  /// Appends a stored name; only for lists that began empty or stored.
  void push_back(std::string_view name);

  /// Bytes of memory held.
  std::uint64_t bytes() const;

  bool is_stored() const { return kind_ == Kind::stored; }

 private:
  enum class Kind : std::uint8_t { stored, numbered, cells };
  Kind kind_ = Kind::stored;
  std::string text_;                    // stored: all names; numbered: the prefix
  std::vector<std::uint64_t> offsets_;  // stored: begin of each name, and the end
  std::vector<std::uint32_t> cells_;    // cells: row * columns + column
  std::uint64_t count_ = 0;             // numbered
  std::uint32_t columns_ = 0;           // cells
};

}  // namespace quoll
