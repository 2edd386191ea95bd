#include "quoll/base/error.hpp"

#include <gtest/gtest.h>

#include "quoll/base/raise.hpp"

namespace quoll {
namespace {

TEST(Error, OneLineNamesWhatIsKnown) {
  EXPECT_EQ(message({.file = "w.toml", .line = 3, .column = 7, .expected = "a number expected"}),
            "w.toml:3:7: a number expected");
  EXPECT_EQ(message({.file = "w.toml", .line = 3, .expected = "x"}), "w.toml:3: x");
  EXPECT_EQ(message({.file = "--seed", .column = 7, .expected = "x"}), "--seed: x");
  EXPECT_EQ(message({.expected = "x", .nearest = "HALL"}), "x; did you mean 'HALL'?");
}

TEST(Error, ResultHoldsAValueOrAnError) {
  Result<std::string> good(std::string("value"));
  ASSERT_TRUE(good);
  EXPECT_EQ(*good, "value");
  EXPECT_EQ(good->size(), 5u);
  EXPECT_EQ(*std::move(good), "value");
  const Result<std::string> bad(Error{.expected = "x"});
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().expected, "x");
  EXPECT_TRUE(Result<void>());
  EXPECT_FALSE(Result<void>(Error{.expected = "x"}));
}

TEST(Error, RaiseThrowsTheLine) {
  try {
    raise({.file = "--seed", .expected = "a number expected"});
    FAIL();
  } catch (const Exception& exception) {
    EXPECT_STREQ(exception.what(), "--seed: a number expected");
    EXPECT_EQ(exception.error().file, "--seed");
  }
  EXPECT_EQ(value_or_raise(Result<int>(3)), 3);
  EXPECT_THROW(value_or_raise(Result<int>(Error{})), Exception);
}

}  // namespace
}  // namespace quoll
