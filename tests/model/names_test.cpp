#include "quoll/model/names.hpp"

#include <gtest/gtest.h>

namespace quoll {
namespace {

TEST(Names, StoredGrowsAndFinds) {
  Names names;
  EXPECT_EQ(names.size(), 0u);
  names.push_back("GATE");
  names.push_back("");
  names.push_back("HALL");
  ASSERT_EQ(names.size(), 3u);
  EXPECT_EQ(names[0], "GATE");
  EXPECT_EQ(names[1], "");
  EXPECT_EQ(names[2], "HALL");
  EXPECT_EQ(names.find("HALL"), 2u);
  EXPECT_EQ(names.find(""), 1u);
  EXPECT_FALSE(names.find("HAL"));
  EXPECT_FALSE(names.find("GATEHALL"));
  EXPECT_TRUE(names.is_stored());
}

TEST(Names, StoredFromOneBlock) {
  const Names names = Names::stored("abc", {0, 1, 1, 3});
  ASSERT_EQ(names.size(), 3u);
  EXPECT_EQ(names[2], "bc");
  EXPECT_EQ(names.find("bc"), 2u);
}

TEST(Names, Numbered) {
  const Names names = Names::numbered("s", 12);
  EXPECT_EQ(names.size(), 12u);
  EXPECT_EQ(names[11], "s11");
  EXPECT_EQ(names.find("s11"), 11u);
  // Each number has one name only.
  for (const char* wrong : {"s12", "11", "s", "s011", "s1x", "s-1", "s99999999999999999999"}) {
    EXPECT_FALSE(names.find(wrong)) << wrong;
  }
  EXPECT_FALSE(names.is_stored());
}

TEST(Names, Cells) {
  // A grid of 4 columns; cells (0,1), (1,3), (2,0) = 1, 7, 8.
  const Names names = Names::cells(4, {1, 7, 8});
  EXPECT_EQ(names.size(), 3u);
  EXPECT_EQ(names[0], "r0c1");
  EXPECT_EQ(names[1], "r1c3");
  EXPECT_EQ(names[2], "r2c0");
  EXPECT_EQ(names.find("r2c0"), 2u);
  // r0c7 would be the same number as r1c3 if columns were not checked.
  for (const char* wrong : {"r0c7", "r0c0", "r1", "c3", "r1c3x", "r01c3", ""}) {
    EXPECT_FALSE(names.find(wrong)) << wrong;
  }
}

TEST(Names, NearestForgivesASlip) {
  Names names;
  for (const char* name : {"GATE", "CAVE", "POOL"}) names.push_back(name);
  EXPECT_EQ(names.nearest("CAEV"), "CAVE");
  EXPECT_EQ(names.nearest("xyz"), "");
  EXPECT_EQ(Names::numbered("state", 100'001).nearest("stat5"), "");  // too many to compare
}

}  // namespace
}  // namespace quoll
