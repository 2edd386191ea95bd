#pragma once
// Names to numbers while a file is read: each new name gets the next number. Made for files of ten
// million rows: no allocation per name, and a short name is compared inside the table itself.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/model/names.hpp"

namespace quoll {

class NameIndex {
 public:
  NameIndex();

  /// What the table compares of a name: all of a name of up to 11 bytes, its length in the top byte
  /// of `high`; 88 bits of hash of a longer one, whose text then decides.
  struct Key {
    std::uint64_t low;
    std::uint32_t high;
  };
  static Key key_of(std::string_view name);
  /// The key of a name, whose place begins to be loaded for an insert some rows later: with
  /// millions of names the time goes into waiting for memory.
  Key prefetch(std::string_view name) const;

  /// The number of `name`; a name not met before gets size(). At most 2^32 - 2 names.
  std::uint32_t insert(std::string_view name) { return insert(name, key_of(name)); }
  std::uint32_t insert(std::string_view name, Key key);
  /// The number of a name met before.
  std::optional<std::uint32_t> find(std::string_view name) const;

  std::uint32_t size() const { return static_cast<std::uint32_t>(offsets_.size() - 1); }
  /// The name with this number; valid until the next insert.
  std::string_view operator[](std::uint32_t number) const {
    return std::string_view(text_).substr(offsets_[number],
                                          offsets_[number + 1] - offsets_[number]);
  }

  /// Frees the table and hands out the names: `number` maps a name's number to its place in the
  /// list; empty = as they were met. The index is empty afterwards.
  Names take(std::span<const std::uint32_t> number);

 private:
  struct Slot {
    std::uint64_t low;
    std::uint32_t high;
    std::uint32_t number;
  };
  static std::uint64_t hash(Key key) { return mix(key.low ^ (key.high * golden_gamma)); }
  std::size_t place_of(Key key, std::string_view name) const;
  void grow();

  std::vector<Slot> slots_;
  std::string text_;
  std::vector<std::uint64_t> offsets_;
};

}  // namespace quoll
