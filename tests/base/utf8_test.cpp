#include "quoll/base/utf8.hpp"

#include <gtest/gtest.h>

namespace quoll {
namespace {

// Ill-formed bytes of The Unicode Standard, table 3-8 (section 3.9): each maximal subpart becomes
// one U+FFFD: 61 F1 80 80 E1 80 C2 62 80 63 80 BF 64 -> a FFFD FFFD FFFD b FFFD c FFFD FFFD d.
TEST(Utf8, ReplacesMaximalSubparts) {
  const std::string bad = "\x61\xF1\x80\x80\xE1\x80\xC2\x62\x80\x63\x80\xBF\x64";
  const std::string mark = "\xEF\xBF\xBD";
  EXPECT_EQ(valid_utf8(bad), "a" + mark + mark + mark + "b" + mark + "c" + mark + mark + "d");
}

TEST(Utf8, RefusesSurrogatesOverlongAndTooLarge) {
  EXPECT_FALSE(decode("\xED\xA0\x80").valid);      // U+D800
  EXPECT_FALSE(decode("\xC0\x80").valid);          // U+0000 in two bytes
  EXPECT_FALSE(decode("\xF4\x90\x80\x80").valid);  // U+110000
}

TEST(Utf8, DecodesAndEncodesEachLength) {
  for (const char32_t c : {U'A', U'é', U'→', U'😀', char32_t{0x10FFFF}}) {
    std::string bytes;
    encode(c, bytes);
    const CodePoint point = decode(bytes + "x");
    EXPECT_TRUE(point.valid);
    EXPECT_EQ(point.value, c);
    EXPECT_EQ(point.length, bytes.size());
  }
}

TEST(Utf8, CountsColumns) {
  EXPECT_EQ(display_width("CAVE"), 4U);
  EXPECT_EQ(display_width("Höhle"), 5U);
  EXPECT_EQ(display_width("洞窟"), 4U);
  EXPECT_EQ(display_width("e\u0301"), 1U);  // combining acute
  EXPECT_EQ(display_width("\x1b[38;5;16;48;5;230m→\x1b[0m"), 1U);
}

TEST(Utf8, CutsToColumns) {
  EXPECT_EQ(fit_width("adventure", 9), "adventure");
  EXPECT_EQ(fit_width("adventure", 5), "adve…");
  EXPECT_EQ(fit_width("洞窟洞窟", 4), "洞…");  // the second would need columns 3 and 4
  EXPECT_EQ(fit_width("adventure", 3, ""), "adv");
}

}  // namespace
}  // namespace quoll
