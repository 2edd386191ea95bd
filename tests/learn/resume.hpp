#pragma once
// Going on where a learner stands, by way of what it saves.

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "worlds.hpp"

namespace quoll::learn_tests {

/// `to`, new of the same settings, goes on where `from` stands; what it then saves and tells of its
/// learning is the same.
inline void resume(Learner& from, Learner& to) {
  const std::vector<std::byte> bytes = saved(from);
  Archive archive{std::span<const std::byte>(bytes)};
  archive("learner", to);
  ASSERT_TRUE(archive.good() && archive.at_end()) << archive.error().expected;
  ASSERT_EQ(saved(to), bytes);
  const std::vector<Measure> told = from.measures(), again = to.measures();
  ASSERT_EQ(told.size(), again.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    ASSERT_EQ(told[i].sum, again[i].sum) << told[i].name;
    ASSERT_EQ(told[i].count, again[i].count) << told[i].name;
  }
}

}  // namespace quoll::learn_tests
