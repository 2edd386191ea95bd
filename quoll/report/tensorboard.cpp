#include "quoll/report/tensorboard.hpp"

#include <array>
#include <bit>

#include "quoll/report/protobuf.hpp"

namespace quoll {
namespace {

using namespace protobuf;

// CRC-32C (Castagnoli), reflected: RFC 3720, appendix B.4.
constexpr std::array<std::uint32_t, 256> crc_table = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0x82f63b78U : crc >> 1;
    table[byte] = crc;
  }
  return table;
}();

// As TFRecord stores it: a checksum of data that holds checksums should not look like one.
std::uint32_t masked_crc(std::string_view bytes) {
  std::uint32_t crc = ~std::uint32_t{0};
  for (const char byte : bytes) {
    crc = crc_table[(crc ^ static_cast<unsigned char>(byte)) & 0xff] ^ crc >> 8;
  }
  return std::rotr(~crc, 15) + 0xa282ead8U;
}

// Event: wall_time = 1, step = 2, and what it says (file_version = 3 or summary = 5).
std::string event(double wall_time, std::uint64_t step, std::uint32_t field,
                  std::string_view content) {
  std::string out;
  add_fixed(out, 1, std::bit_cast<std::uint64_t>(wall_time));
  add_number(out, 2, step);
  add_bytes(out, field, content);
  return out;
}

// Summary: value = 1, repeated; Summary.Value: tag = 1, simple_value = 2.
std::string summary(const Scalar& scalar) {
  std::string value, out;
  add_bytes(value, 1, scalar.tag);
  add_fixed(value, 2, std::bit_cast<std::uint32_t>(scalar.value));
  add_bytes(out, 1, value);
  return out;
}

void add_record(std::string& out, std::string_view data) {
  std::string length;
  append_little(length, std::uint64_t{data.size()});
  out += length;
  append_little(out, masked_crc(length));
  out += data;
  append_little(out, masked_crc(data));
}

}  // namespace

std::string tensorboard_events(std::span<const Scalar> scalars) {
  std::string out;
  add_record(out, event(scalars.empty() ? 0.0 : scalars.front().wall_time, 0, 3, "brain.Event:2"));
  for (const Scalar& scalar : scalars) {
    add_record(out, event(scalar.wall_time, scalar.step, 5, summary(scalar)));
  }
  return out;
}

}  // namespace quoll
