#pragma once
// Numbers as bytes of a file, in either order.

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>

namespace quoll {

namespace detail {
template <std::unsigned_integral T>
constexpr T reversed(T value) {
  T result = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i, value = static_cast<T>(value >> 8)) {
    result = static_cast<T>(result << 8 | (value & 0xff));
  }
  return result;
}
}  // namespace detail

/// The number whose sizeof(T) bytes begin at `from`, aligned or not.
template <std::unsigned_integral T>
T load_little(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return std::endian::native == std::endian::little ? value : detail::reversed(value);
}
template <std::unsigned_integral T>
T load_big(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return std::endian::native == std::endian::big ? value : detail::reversed(value);
}

template <std::unsigned_integral T>
void append_little(std::string& to, T value) {
  if constexpr (std::endian::native != std::endian::little) value = detail::reversed(value);
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  to.append(bytes, sizeof bytes);
}

}  // namespace quoll
