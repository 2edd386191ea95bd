#include "quoll/model/letters.hpp"

#include <gtest/gtest.h>

namespace quoll {
namespace {

// Well-formed and ill-formed sequences of The Unicode Standard, section 3.9, table 3-7.
TEST(Letters, LengthOfTheFirstCharacter) {
  EXPECT_EQ(letter_length("ab"), 1u);
  EXPECT_EQ(letter_length("\xc3\xa9x"), 2u);         // U+00E9
  EXPECT_EQ(letter_length("\xe2\x82\xac"), 3u);      // U+20AC
  EXPECT_EQ(letter_length("\xf0\x9f\x98\x80"), 4u);  // U+1F600
  for (const char* text : {"", "\x80", "\xc3", "\xc3(", "\xc0\xaf", "\xe0\x9f\xbf", "\xed\xa0\x80",
                           "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\xff"}) {
    EXPECT_EQ(letter_length(text), 0u) << text;
  }
}

TEST(Letters, WhatIsNoName) {
  EXPECT_EQ(name_fault("To CAVE, \"gr\xc3\xb6\xc3\x9f"
                       "er\""),
            "");
  EXPECT_EQ(name_fault("\xc2\xa0"), "");  // U+00A0 is a blank, no control
  EXPECT_EQ(name_fault(""), "expected a name that is not empty");
  for (const char* name : {"a\tb", "a\n", "\x1b[31m", "\x7f", "\xc2\x9b"}) {
    EXPECT_EQ(name_fault(name), "expected a name without control characters") << name;
  }
  EXPECT_EQ(name_fault("caf\xe9"), "expected a name in UTF-8");
}

}  // namespace
}  // namespace quoll
