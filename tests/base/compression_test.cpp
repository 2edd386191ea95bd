#include "quoll/base/compression.hpp"

#include <gtest/gtest.h>

namespace quoll {
namespace {

std::string bytes(std::string_view hex) {
  std::string out;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    out += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  }
  return out;
}

// "hello hello hello\n" by `gzip -n` and by `xz`.
const std::string gzip = bytes("1f8b0800000000000003cb48cdc9c957c840905c003b7c8adf12000000");
const std::string xz = bytes(
    "fd377a585a000004e6d6b4460200210116000000742fe5a3e00011000c5d00341949ee8de94f7e21"
    "21b000001f01d9c887c143c800012812c96a628e1fb6f37d010000000004595a");

void expect_content(const std::string& compressed, const char* hint) {
  EXPECT_TRUE(is_compressed(compressed));
  const auto content = decompress(compressed, "f");
  if (!content && content.error().expected.find("reads no") != std::string::npos) {
    EXPECT_NE(content.error().expected.find(hint), std::string::npos);
    GTEST_SKIP() << "built without the library";
  }
  ASSERT_TRUE(content) << content.error().expected;
  EXPECT_EQ(*content, "hello hello hello\n");
  for (std::size_t size = 6; size < compressed.size(); ++size) {
    EXPECT_FALSE(decompress(compressed.substr(0, size), "f")) << size;
  }
  std::string altered = compressed;
  altered[compressed.size() / 2] ^= 1;
  EXPECT_FALSE(decompress(altered, "f"));
}

TEST(Compression, Gzip) {
  expect_content(gzip, "gunzip -c");
}

TEST(Compression, Xz) {
  expect_content(xz, "unxz -c");
}

TEST(Compression, MembersFollowEachOther) {
  const auto content = decompress(gzip + gzip, "f");
  if (!content) GTEST_SKIP() << content.error().expected;
  EXPECT_EQ(*content, "hello hello hello\nhello hello hello\n");
}

TEST(Compression, OtherBytesAreNotCompressed) {
  EXPECT_FALSE(is_compressed(""));
  EXPECT_FALSE(is_compressed("index.json"));
}

}  // namespace
}  // namespace quoll
