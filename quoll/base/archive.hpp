#pragma once
// One list of fields for saving and for loading: a type names its fields in persist(Archive&), and the
// same call writes them or reads them back. Each field carries its name and type, so a file of another
// layout is refused with the name of the first field that differs; a reader never allocates more than
// the bytes present can justify. The layout is specified in docs/formats.md.

#include <bit>
#include <cstdint>
#include <cstring>
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
      block(name, type_of<T>(), 1, sizeof(T), &field);
    } else if constexpr (requires { field.persist(*this); }) {
      group(name);
      field.persist(*this);
    } else {
      sequence(name, field);
    }
  }

  /// Marks the loading of what was read as failed, with the reason: for values that contradict.
  void fail(std::string reason);

 private:
  template <class T>
  static constexpr char type_of() {
    if constexpr (std::is_same_v<T, bool>) return 'b';
    if constexpr (std::is_same_v<T, float>) return 'f';
    if constexpr (std::is_same_v<T, double>) return 'd';
    return "?1248"[sizeof(T) == 8 ? 4 : sizeof(T) == 4 ? 3 : sizeof(T) == 2 ? 2 : 1];
  }

  template <class Sequence>
  void sequence(std::string_view name, Sequence& field) {
    using T = typename Sequence::value_type;
    if constexpr (std::is_arithmetic_v<T>) {
      const std::uint64_t count = length(name, type_of<T>(), sizeof(T), field.size());
      if (!good_) return;
      if (!saving_) field.resize(count);
      payload(field.data(), count * sizeof(T));
    } else {
      std::uint64_t count = length(name, 'v', 1, field.size());
      if (!good_) return;
      if (!saving_) field.resize(count);
      for (auto& item : field) (*this)("item", item);
    }
  }

  void block(std::string_view name, char type, std::uint64_t count, std::size_t size, void* data);
  void group(std::string_view name);
  std::uint64_t length(std::string_view name, char type, std::size_t size, std::uint64_t count);
  void payload(void* data, std::size_t size);

  std::vector<std::byte> output_;
  std::span<const std::byte> input_;
  std::size_t position_ = 0;
  bool saving_ = true;
  bool good_ = true;
  Error error_;
};

}  // namespace quoll
