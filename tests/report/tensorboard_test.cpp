// Event files read back by a decoder that shares nothing with the writer: the checksum is found bit
// by bit, messages are taken apart by their wire types alone.

#include "quoll/report/tensorboard.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace quoll {
namespace {

std::uint32_t crc32c(const std::string& bytes) {
  std::uint32_t remainder = 0xffffffff;
  for (const char c : bytes) {
    for (int bit = 0; bit < 8; ++bit) {
      const bool in = (static_cast<unsigned char>(c) >> bit & 1) != 0;
      const bool out = (remainder & 1) != 0;
      remainder >>= 1;
      if (in != out) remainder ^= 0x82f63b78;
    }
  }
  return remainder ^ 0xffffffff;
}

std::uint32_t masked(const std::string& bytes) {
  const std::uint32_t crc = crc32c(bytes);
  return (crc >> 15 | crc << 17) + 0xa282ead8;
}

template <class T>
T little(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

struct Field {
  std::uint64_t number = 0;
  std::string bytes;
};

std::uint64_t varint(const std::string& bytes, std::size_t& at) {
  std::uint64_t value = 0;
  for (int shift = 0;; shift += 7) {
    const auto byte = static_cast<unsigned char>(bytes.at(at++));
    value |= std::uint64_t{byte & 0x7fu} << shift;
    if (byte < 0x80) return value;
  }
}

std::map<std::uint64_t, Field> fields(const std::string& message) {
  std::map<std::uint64_t, Field> found;
  for (std::size_t at = 0; at < message.size();) {
    const std::uint64_t key = varint(message, at);
    Field field;
    std::size_t size = 0;
    switch (key & 7) {
      case 0:
        field.number = varint(message, at);
        break;
      case 1:
        size = 8;
        break;
      case 2:
        size = varint(message, at);
        break;
      case 5:
        size = 4;
        break;
      default:
        ADD_FAILURE() << "wire type " << (key & 7);
    }
    field.bytes = message.substr(at, size);
    EXPECT_EQ(field.bytes.size(), size);
    at += size;
    found[key >> 3] = field;
  }
  return found;
}

std::vector<std::string> records(const std::string& file) {
  std::vector<std::string> all;
  for (std::size_t at = 0; at < file.size();) {
    const auto length = little<std::uint64_t>(file, at);
    EXPECT_EQ(little<std::uint32_t>(file, at + 8), masked(file.substr(at, 8)));
    all.push_back(file.substr(at + 12, length));
    EXPECT_EQ(little<std::uint32_t>(file, at + 12 + length), masked(all.back()));
    at += 16 + length;
  }
  return all;
}

// RFC 3720, appendix B.4: the checksum of 32 zeros.
TEST(TensorBoard, TheTestsChecksumIsTheCastagnoliOne) {
  EXPECT_EQ(crc32c(std::string(32, '\0')), 0x8a9136aau);
  EXPECT_EQ(crc32c("123456789"), 0xe3069283u);
}

TEST(TensorBoard, EveryPointIsReadBack) {
  const std::vector<Scalar> scalars{{"charts/episodic_return", 64, 0.5, 21.25F},
                                    {"losses/td_loss", 300, 1e9 + 0.25, -0.0F},
                                    {"charts/SPS", ~std::uint64_t{0} >> 1, 2.0, INFINITY}};
  const std::vector<std::string> all = records(tensorboard_events(scalars));
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(fields(all[0])[3].bytes, "brain.Event:2");
  for (std::size_t i = 0; i < scalars.size(); ++i) {
    auto event = fields(all[i + 1]);
    EXPECT_EQ(little<double>(event[1].bytes, 0), scalars[i].wall_time);
    EXPECT_EQ(event[2].number, scalars[i].step);
    auto value = fields(fields(event[5].bytes)[1].bytes);
    EXPECT_EQ(value[1].bytes, scalars[i].tag);
    EXPECT_EQ(little<std::uint32_t>(value[2].bytes, 0),
              std::bit_cast<std::uint32_t>(scalars[i].value));
  }
}

TEST(TensorBoard, WithoutPointsThereIsStillAFile) {
  EXPECT_EQ(records(tensorboard_events({})).size(), 1u);
}

}  // namespace
}  // namespace quoll
