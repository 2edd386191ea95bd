#pragma once
// One list of fields for saving and for loading: a type names its fields in persist(Archive&), and
// the same call writes them or reads them back. Each field carries its name and type, so a file of
// another layout is refused with the name of the first field that differs; a reader never allocates
// more than the bytes present can justify. The layout is specified in docs/formats.md.
//
// A field is a bool, a number of 1, 2, 4 or 8 bytes, an enum over one, a type with persist, or a
// string, vector, array or optional of those (std::vector<bool> is not). Give fields a width that
// is the same on every machine: std::uint64_t, not std::size_t. An enum is read back as the number
// it was saved as: the persist that lists it checks that it is one of its words, and calls fail()
// otherwise.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "quoll/base/error.hpp"

namespace quoll {

class Archive {
 public:
  /// An empty archive to write into.
  Archive() = default;
  /// An archive to read from; the bytes must outlive it.
  explicit Archive(std::span<const std::byte> bytes) : input_(bytes), saving_(false) {}

  bool saving() const { return saving_; }
  /// False after the first field that did not fit; later fields are left as they are.
  bool good() const { return good_; }
  /// What was wrong with the first field that did not fit.
  const Error& error() const { return error_; }
  const std::vector<std::byte>& bytes() const { return output_; }
  /// True when reading has used every byte.
  bool at_end() const { return position_ == input_.size(); }

  template <class T>
  void operator()(std::string_view name, T& field) {
    if constexpr (std::is_enum_v<T>) {
      auto number = static_cast<std::underlying_type_t<T>>(field);
      (*this)(name, number);
      field = static_cast<T>(number);
    } else if constexpr (std::is_arithmetic_v<T>) {
      if (expect(name, type_of<T>(), 1)) payload(type_of<T>(), &field, 1, sizeof(T));
    } else if constexpr (requires { field.persist(*this); }) {
      if (expect(name, 'g', 0)) field.persist(*this);
    } else if constexpr (requires { field.has_value(); }) {
      maybe(name, field);
    } else {
      sequence(name, field);
    }
  }

  /// Marks the loading of what was read as failed, with the reason: for values that contradict. The
  /// first reason stays.
  void fail(std::string reason);

 private:
  template <class T>
  static constexpr char type_of() {
    static_assert(sizeof(T) <= 8, "long double has no portable layout");
    if constexpr (std::is_same_v<T, bool>) return 'b';
    if constexpr (std::is_same_v<T, float>) return 'f';
    if constexpr (std::is_same_v<T, double>) return 'd';
    return "?12?4???8"[sizeof(T)];
  }

  template <class T>
  void maybe(std::string_view name, std::optional<T>& field) {
    const std::uint64_t count = length(name, 'o', 0, field.has_value() ? 1 : 0);
    if (good_ && count > 1) fail("an optional field holds one value or none");
    if (!good_) return;
    if (!saving_) field.reset();
    if (count == 0) return;
    if (!saving_) field.emplace();
    (*this)("item", *field);
  }

  template <class Sequence>
  void sequence(std::string_view name, Sequence& field) {
    using T = typename Sequence::value_type;
    static_assert(!std::is_same_v<Sequence, std::vector<bool>>, "use std::vector<std::uint8_t>");
    constexpr bool flat = std::is_arithmetic_v<T>;
    constexpr bool fixed = !requires { field.resize(1); };
    constexpr char type = [] {
      if constexpr (flat) return type_of<T>();
      return 'v';
    }();
    const std::uint64_t count = length(name, type, flat ? sizeof(T) : 0, field.size());
    if (good_ && fixed && count != field.size()) differs(name, count, field.size());
    if (!good_) return;
    if constexpr (flat) {
      if constexpr (!fixed) {
        if (!saving_) field.resize(count);
      }
      payload(type, field.data(), count, sizeof(T));
    } else if constexpr (fixed) {
      for (auto& item : field) (*this)("item", item);
    } else {
      // Items may be far larger in memory than in the file: they are made one by one as they are
      // read.
      if (!saving_) field.clear();
      for (std::uint64_t index = 0; index < count && good_; ++index) {
        if (!saving_) field.emplace_back();
        (*this)("item", field[index]);
      }
    }
  }

  /// Writes the head of a field, or reads it and compares name, type and count.
  bool expect(std::string_view name, char type, std::uint64_t count);
  /// The same for a field whose count the file decides: what it says, if that many items of at
  /// least `size` bytes (0 = a nested field) can be present.
  std::uint64_t length(std::string_view name, char type, std::size_t size, std::uint64_t count);
  /// The values, `size` bytes each, least significant byte first.
  void payload(char type, void* data, std::uint64_t count, std::size_t size);
  void differs(std::string_view name, std::uint64_t found, std::uint64_t expected);

  std::vector<std::byte> output_;
  std::span<const std::byte> input_;
  std::size_t position_ = 0;
  bool saving_ = true;
  bool good_ = true;
  Error error_;
};

}  // namespace quoll
