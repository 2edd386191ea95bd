// Worlds from files that take parameters.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "quoll/env/world.hpp"

namespace quoll {
namespace {

class MapWorld : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = testing::TempDir() + "map_world_test-" + std::to_string(getpid()) + "/";
    std::filesystem::create_directory(folder_);
    path_ = folder_ + "map_world_test.map";
    std::ofstream(path_) << "type octile\nheight 1\nwidth 3\nmap\n...\n";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string folder_, path_;
};

TEST_F(MapWorld, TakesParametersAndKeepsThem) {
  const Parameters given{{"goal", "2,0"}, {"start", "0,0"}};
  const auto world = find_world(path_, given);
  ASSERT_TRUE(world) << message(world.error());
  EXPECT_EQ(world->name, "map_world_test");
  EXPECT_EQ(world->parameters, given);
  EXPECT_EQ(world->discount, 1.0);
  EXPECT_EQ(world->traits.states, 3u);
  EXPECT_TRUE(world->traits.deterministic);
  ASSERT_TRUE(world->mdp);
  EXPECT_EQ(world->mdp->reward_bounds(), (std::pair{-1.0, -1.0}));
}

TEST_F(MapWorld, RefusesOthers) {
  const auto world = find_world(path_, {{"goal", "2,0"}, {"size", "4"}});
  ASSERT_FALSE(world);
  EXPECT_EQ(world.error().file, "--with");
  const auto without = find_world(path_);
  ASSERT_FALSE(without);
  EXPECT_EQ(message(without.error()), "--with goal: the place to go expected: --with goal=x,y");
}

}  // namespace
}  // namespace quoll
