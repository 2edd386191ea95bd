#include "quoll/base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <thread>
#include <vector>

namespace quoll {
namespace {

TEST(Parallel, EachPartIsDoneOnce) {
  for (const unsigned threads : {0u, 1u, 2u, 7u}) {
    for (const std::size_t parts : {std::size_t{0}, std::size_t{1}, std::size_t{1000}}) {
      std::vector<int> done(parts);
      parallel_for(parts, threads, [&](std::size_t part) { ++done[part]; });
      EXPECT_EQ(done, std::vector<int>(parts, 1)) << threads << " threads";
    }
  }
}

TEST(Parallel, OneThreadWorksInOrderAndHere) {
  std::vector<std::size_t> order;
  const auto here = std::this_thread::get_id();
  parallel_for(5, 1, [&](std::size_t part) {
    EXPECT_EQ(std::this_thread::get_id(), here);
    order.push_back(part);
  });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

// Two parts that wait for each other can only end when two threads run them.
TEST(Parallel, TwoThreadsRunAtTheSameTime) {
  std::atomic<int> arrived{0};
  parallel_for(2, 2, [&](std::size_t) {
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 2);
}

TEST(Parallel, NeverMoreThreadsThanAsked) {
  std::atomic<int> running{0};
  std::atomic<int> most{0};
  parallel_for(200, 3, [&](std::size_t) {
    const int now = ++running;
    int before = most;
    while (before < now && !most.compare_exchange_weak(before, now)) {
    }
    std::this_thread::yield();
    --running;
  });
  EXPECT_LE(most, 3);
}

TEST(Parallel, CallsCanBeNested) {
  std::atomic<int> sum{0};
  parallel_for(4, 2, [&](std::size_t) { parallel_for(10, 2, [&](std::size_t) { ++sum; }); });
  EXPECT_EQ(sum, 40);
}

TEST(Parallel, CallsFromManyThreadsAllEnd) {
  std::atomic<int> sum{0};
  std::vector<std::thread> callers;
  for (int i = 0; i < 4; ++i) {
    callers.emplace_back([&] {
      for (int k = 0; k < 500; ++k) parallel_for(7, 3, [&](std::size_t) { ++sum; });
    });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(sum, 4 * 500 * 7);
}

// A running sum of both halves, which is wrong as soon as one is a step ahead.
TEST(Team, GoesStepByStep) {
  for (const unsigned threads : {0u, 1u, 2u, 5u, 1000u}) {
    std::vector<int> steps;
    unsigned most = 0;
    Team::gather(threads, [&](Team& team, unsigned member) {
      if (member == 0) steps.assign(team.size(), 0), most = team.size();
      for (int k = 0; k < 2000; ++k) {
        team.meet(member);
        ++steps[member];
        team.meet(member);
        for (const int step : steps) ASSERT_EQ(step, k + 1) << threads << " threads";
      }
    });
    EXPECT_EQ(steps, std::vector<int>(most, 2000));
    if (threads > 0) {
      EXPECT_LE(most, threads);
    }
    EXPECT_LE(most, processors());
  }
}

TEST(Team, OneOfItsMembersMayGatherAlone) {
  std::atomic<unsigned> members{0};
  Team::gather(2, [&](Team&, unsigned) {
    Team::gather(2, [&](Team& inner, unsigned) {
      EXPECT_EQ(inner.size(), 1u);
      ++members;
    });
  });
  EXPECT_GE(members, 1u);
  EXPECT_LE(members, 2u);
}

TEST(Parallel, AtLeastOneProcessor) {
  EXPECT_GE(processors(), 1u);
}

}  // namespace
}  // namespace quoll
