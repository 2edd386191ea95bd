#include "quoll/experiment/heat_log.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdio>
#include <set>

#include "quoll/base/file.hpp"
#include "quoll/experiment/race_suite.hpp"

namespace quoll {
namespace {

class HeatLogFile : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = ::testing::TempDir() + "heats" + std::to_string(getpid()) + ".csv";
    std::remove(path_.c_str());
  }
  void TearDown() override { std::remove(path_.c_str()); }

  std::string path_;
  const HeatPlace place_{"garnet --with seed=3", RaceMode::all, 1000, 0.5};
  const Heat heat_{7, HeatEnd::steps, 1000, 0.125, 96};
};

TEST_F(HeatLogFile, RemembersHeatsByAllTheyDependOn) {
  {
    HeatLog log = *HeatLog::open(path_);
    EXPECT_EQ(log.find(place_, "q-learning", 7), nullptr);
    ASSERT_TRUE(log.add(place_, "q-learning", heat_));
    ASSERT_TRUE(log.add(place_, "q-learning:explore=greedy", {7, HeatEnd::reached, 12, 1e-7, 96}));
  }
  EXPECT_EQ(*read_file(path_),
            "world,mode,entrant,seed,cap_steps,cap_seconds,end,steps,seconds,bytes\n"
            "garnet --with seed=3,all,q-learning,7,1000,0.5,steps,1000,0.125,96\n"
            "garnet --with seed=3,all,q-learning:explore=greedy,7,1000,0.5,reached,12,1e-07,96\n");
  const HeatLog log = *HeatLog::open(path_);
  const Heat* const heat = log.find(place_, "q-learning", 7);
  ASSERT_NE(heat, nullptr);
  EXPECT_EQ(heat->end, HeatEnd::steps);
  EXPECT_EQ(heat->steps, 1000u);
  EXPECT_EQ(heat->seconds, 0.125);
  EXPECT_EQ(heat->bytes, 96u);
  EXPECT_EQ(log.find(place_, "q-learning", 8), nullptr);
  HeatPlace other = place_;
  other.mode = RaceMode::start;
  EXPECT_EQ(log.find(other, "q-learning", 7), nullptr);
  other = place_;
  other.cap_steps = 2000;
  EXPECT_EQ(log.find(other, "q-learning", 7), nullptr);
}

TEST_F(HeatLogFile, DropsALastLineThatWasCut) {
  ASSERT_TRUE(HeatLog::open(path_)->add(place_, "q-learning", heat_));
  const std::string whole = *read_file(path_);
  ASSERT_TRUE(write_file(path_, whole + "garnet --with seed=3,all,q-learning,8,1000,0.5,rea"));
  HeatLog log = *HeatLog::open(path_);
  EXPECT_NE(log.find(place_, "q-learning", 7), nullptr);
  EXPECT_EQ(log.find(place_, "q-learning", 8), nullptr);
  EXPECT_EQ(*read_file(path_), whole);
}

TEST_F(HeatLogFile, RefusesWhatIsNoLog) {
  ASSERT_TRUE(write_file(path_, "# notes\n"));
  ASSERT_FALSE(HeatLog::open(path_));
  EXPECT_EQ(HeatLog::open(path_).error().line, 1u);
  ASSERT_TRUE(write_file(path_, ""));
  ASSERT_TRUE(HeatLog::open(path_));
  ASSERT_TRUE(write_file(path_, *read_file(path_) + "adventure,all,q-learning,1\n"));
  EXPECT_EQ(HeatLog::open(path_).error().line, 2u);
}

TEST(Suites, EveryWorldOpensAndIsNamedOnce) {
  std::set<std::string_view> names;
  for (const Suite& suite : suites()) {
    EXPECT_EQ(find_suite(suite.name), &suite);
    for (const SuiteWorld& row : suite.worlds) {
      EXPECT_TRUE(names.insert(row.name).second) << row.name;
      if (row.most_seeds < 30) continue;  // large: they take long to make
      const Result<World> world = open_world(row);
      ASSERT_TRUE(world) << row.name << ": " << message(world.error());
      EXPECT_TRUE(world->mdp && world->traits.settable) << row.name;
    }
  }
  EXPECT_EQ(find_suite("other"), nullptr);
}

TEST(Suites, ARowSaysHowToRunItAlone) {
  const SuiteWorld row{"x", "garnet", "states=9 seed=2", "s3", "s1", 0.5, 30, ""};
  EXPECT_EQ(command_of(row),
            "garnet --with states=9 --with seed=2 --goal s3 --from s1 --discount 0.5");
}

}  // namespace
}  // namespace quoll
