#pragma once
// The wire format of protocol buffers: a message is its fields one after the other, each a key and
// a content, in any order. A message within a message is a field of bytes.

#include <cstdint>
#include <string>
#include <string_view>

#include "quoll/base/bytes.hpp"

namespace quoll::protobuf {

enum class Wire : std::uint8_t { varint = 0, fixed64 = 1, bytes = 2, fixed32 = 5 };

inline void add_varint(std::string& out, std::uint64_t number) {
  for (; number >= 0x80; number >>= 7) out += static_cast<char>((number & 0x7f) | 0x80);
  out += static_cast<char>(number);
}

inline void add_key(std::string& out, std::uint32_t field, Wire wire) {
  add_varint(out, field << 3 | static_cast<std::uint32_t>(wire));
}

/// A whole number; negative ones as two's complement of 64 bits.
inline void add_number(std::string& out, std::uint32_t field, std::uint64_t number) {
  add_key(out, field, Wire::varint);
  add_varint(out, number);
}

/// A number of 4 or 8 bytes, such as the bits of a float or a double.
template <std::unsigned_integral T>
void add_fixed(std::string& out, std::uint32_t field, T bits) {
  static_assert(sizeof(T) == 4 || sizeof(T) == 8);
  add_key(out, field, sizeof(T) == 4 ? Wire::fixed32 : Wire::fixed64);
  append_little(out, bits);
}

/// Text, bytes or a message.
inline void add_bytes(std::string& out, std::uint32_t field, std::string_view bytes) {
  add_key(out, field, Wire::bytes);
  add_varint(out, bytes.size());
  out += bytes;
}

}  // namespace quoll::protobuf
