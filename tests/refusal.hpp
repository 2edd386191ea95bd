#pragma once
// For tests of messages.

#include <string>

#include "quoll/base/error.hpp"

namespace quoll::tests {

/// The line that a failure prints; empty for a success.
template <class T>
std::string refusal_of(const Result<T>& result) {
  return result ? "" : message(result.error());
}

}  // namespace quoll::tests
