#include "quoll/model/name_index.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace quoll {
namespace {

// Names of every length around the border between names in the slot and hashed ones, and names that
// differ only in length or in a zero byte.
std::vector<std::string> names() {
  std::vector<std::string> list = {"", std::string(1, '\0'), std::string(2, '\0')};
  for (std::size_t length = 1; length <= 40; ++length) {
    for (const char first : {'a', 'b'}) list.push_back(first + std::string(length - 1, 'x'));
    list.push_back(std::string(length - 1, 'x') + 'y');
  }
  for (int i = 0; i < 5000; ++i) list.push_back("state number " + std::to_string(i));
  return list;
}

TEST(NameIndex, NumbersInOrderOfFirstMention) {
  const auto list = names();
  NameIndex index;
  for (std::uint32_t i = 0; i < list.size(); ++i) EXPECT_EQ(index.insert(list[i]), i) << list[i];
  EXPECT_EQ(index.size(), list.size());
  for (std::uint32_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(index.insert(list[i]), i);
    EXPECT_EQ(index.insert(list[i], index.prefetch(list[i])), i);
    EXPECT_EQ(index.find(list[i]), i);
    EXPECT_EQ(index[i], list[i]);
  }
  EXPECT_FALSE(index.find("nobody"));
}

TEST(NameIndex, HandsOutNamesInOrderOrInAnother) {
  for (const bool reversed : {false, true}) {
    const auto list = names();
    NameIndex index;
    std::vector<std::uint32_t> order;
    for (const auto& name : list) {
      index.insert(name);
      if (reversed) order.push_back(static_cast<std::uint32_t>(list.size() - 1 - order.size()));
    }
    const Names taken = index.take(order);
    ASSERT_EQ(taken.size(), list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      EXPECT_EQ(taken[i], list[reversed ? list.size() - 1 - i : i]);
    }
    EXPECT_EQ(index.size(), 0u);
  }
}

}  // namespace
}  // namespace quoll
