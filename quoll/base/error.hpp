#pragma once
// Errors are values. A reader or builder that can fail because of what a person wrote returns a
// Result<T>: the value, or one Error that says where it went wrong and what was expected.

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace quoll {

/// What a person needs to mend an input. `line` and `column` count from 1; 0 = not known.
struct Error {
  std::string file{};  ///< file name or option ("--discount"); empty = no place to name
  std::uint64_t line = 0;
  std::uint64_t column = 0;
  std::string expected{};  ///< one sentence: what was expected and what stood there
  std::string nearest{};   ///< the nearest known name, or empty
};

/// The one line every face of Quoll prints: "file:line:column: expected; did you mean 'nearest'?".
std::string message(const Error& error);

/// A value or the Error that prevented it. Access to the value of a failed Result is a programmer's
/// mistake (undefined); test it first.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}
  Result(Error error) : content_(std::move(error)) {}

  explicit operator bool() const { return content_.index() == 0; }
  T& operator*() & { return *std::get_if<0>(&content_); }
  const T& operator*() const& { return *std::get_if<0>(&content_); }
  T&& operator*() && { return std::move(*std::get_if<0>(&content_)); }
  T* operator->() { return std::get_if<0>(&content_); }
  const T* operator->() const { return std::get_if<0>(&content_); }
  const Error& error() const { return *std::get_if<1>(&content_); }

 private:
  std::variant<T, Error> content_;
};

/// Success without a value, or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)), failed_(true) {}

  explicit operator bool() const { return !failed_; }
  const Error& error() const { return error_; }

 private:
  Error error_;
  bool failed_ = false;
};

}  // namespace quoll
