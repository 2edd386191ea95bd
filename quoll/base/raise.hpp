#pragma once
// The only door from an Error value to a C++ exception, for the convenience calls of the public
// API.

#include <stdexcept>

#include "quoll/base/error.hpp"

namespace quoll {

/// Thrown by the calls that promise a value, such as quoll::world(name).
class Exception : public std::runtime_error {
 public:
  explicit Exception(const Error& error) : std::runtime_error(message(error)), error_(error) {}
  const Error& error() const { return error_; }

 private:
  Error error_;
};

/// Throws Exception(error); prints the message and aborts in a build without exceptions.
[[noreturn]] void raise(const Error& error);

/// The value of a Result, or raise().
template <class T>
T value_or_raise(Result<T> result) {
  if (!result) raise(result.error());
  return std::move(*result);
}

}  // namespace quoll
