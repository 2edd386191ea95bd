#include "quoll/experiment/return_watch.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace quoll {
namespace {

// 99 episodes of 0 and then of 10: the mean of the last 100 is k / 10 after k of them, 5 after 50.
TEST(ReturnWatch, TheMeanOfTheLastHundredDecides) {
  ReturnWatch watch;
  watch.look_for(5.0, 0, 0.0);
  for (std::uint64_t i = 1; i <= 99; ++i) watch.add({3 * i, 0.0, 3}, 0.0);
  EXPECT_FALSE(watch.full());
  for (std::uint64_t i = 100; !watch.reached() && i < 1000; ++i) watch.add({3 * i, 10.0, 3}, 0.25);
  ASSERT_TRUE(watch.reached());
  EXPECT_EQ(watch.reached()->episodes, 149u);
  EXPECT_EQ(watch.reached()->steps, 447u);
  EXPECT_EQ(watch.reached()->mean, 5.0);
  EXPECT_EQ(watch.reached()->processor_seconds, 0.25);
}

TEST(ReturnWatch, FewerThanAHundredEpisodesAreNotEnough) {
  ReturnWatch watch;
  watch.look_for(1.0, 0, 0.0);
  for (std::uint64_t i = 1; i <= 99; ++i) watch.add({i, 500.0, 1}, 0.0);
  EXPECT_FALSE(watch.reached());
  watch.add({100, 500.0, 1}, 0.0);
  EXPECT_TRUE(watch.reached());
}

// The steps of a log are put together to episodes, however the log is cut.
TEST(ReturnWatch, ALogTellsItsEpisodes) {
  ReturnWatch watch;
  watch.look_for(3.0, 0, 0.0);
  std::vector<Update> log(3);
  for (std::uint64_t i = 0; i < 300; ++i) {
    Update& update = log[i % 3];
    update.step = i + 1;
    update.reward = 1.0;
    update.terminated = i % 3 == 2 && i % 2 == 0;
    update.truncated = i % 3 == 2 && i % 2 == 1;
    if (i % 2 == 1) watch.add(std::span(log).subspan((i - 1) % 3, 1), 0.0);
    if (i % 2 == 1) watch.add(std::span(log).subspan(i % 3, 1), 0.0);
  }
  ASSERT_TRUE(watch.reached());
  EXPECT_EQ(watch.reached()->steps, 300u);
  EXPECT_EQ(watch.reached()->episodes, 100u);
}

TEST(ReturnWatch, AnotherGoalBeginsAnotherSearch) {
  ReturnWatch watch;
  watch.look_for(1.0, 0, 0.0);
  for (std::uint64_t i = 1; i <= 120; ++i) watch.add({i, 2.0, 1}, 0.0);
  EXPECT_EQ(watch.reached()->steps, 100u);
  watch.look_for(1.0, 120, 0.0);  // the same: nothing new
  EXPECT_EQ(watch.reached()->steps, 100u);
  watch.look_for(2.0, 120, 0.0);  // met already
  EXPECT_EQ(watch.reached()->steps, 120u);
  watch.look_for(3.0, 120, 0.0);
  EXPECT_FALSE(watch.reached());
}

TEST(ReturnWatch, IsReadBackWhole) {
  ReturnWatch watch, other;
  watch.look_for(1.0, 0, 0.0);
  for (std::uint64_t i = 1; i <= 150; ++i) watch.add({i, 2.0 - 1.0 / double(i), 1}, 0.5);
  Archive out;
  out("watch", watch);
  Archive in{std::span<const std::byte>(out.bytes())};
  in("watch", other);
  ASSERT_TRUE(in.good() && in.at_end());
  EXPECT_EQ(other.mean(), watch.mean());
  EXPECT_EQ(other.reached()->steps, watch.reached()->steps);
}

}  // namespace
}  // namespace quoll
