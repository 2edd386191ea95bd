#include "quoll/env/worlds/racetrack_maps.hpp"

#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::led;
using world_tests::made;
using world_tests::probability;

TEST(Racetrack, HasTheTracksOfTheFigure) {
  EXPECT_EQ(std::size(left_track), 32u);
  EXPECT_EQ(std::size(right_track), 30u);
  for (const std::string_view row : left_track) EXPECT_EQ(row.size(), 17u);
  for (const std::string_view row : right_track) EXPECT_EQ(row.size(), 32u);
  EXPECT_EQ(made("racetrack").mdp->start().size(), 6u);
  EXPECT_EQ(made("racetrack", {{"track", "right"}}).mdp->start().size(), 23u);
}

TEST(Racetrack, DrivesWithTheNewVelocity) {
  const World world = made("racetrack", {{"failure", "0"}});
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(led(mdp, "r31c3u0r0", "u+1r0").to, "r30c3u1r0");
  EXPECT_EQ(led(mdp, "r31c3u0r0", "u+1r+1").to, "r30c4u1r1");
  EXPECT_EQ(led(mdp, "r31c3u0r0", "u0r0").to, "r31c3u0r0");
  EXPECT_EQ(led(mdp, "r30c3u1r0", "u+1r0").to, "r28c3u2r0");
  EXPECT_EQ(led(mdp, "r30c3u1r0", "u+1r0").reward, -1.0);
  EXPECT_EQ(mdp.actions(*mdp.find_state("r31c3u0r0")), 4u);  // nothing downwards or to the left
  EXPECT_EQ(mdp.actions(*mdp.find_state("r30c3u1r0")), 5u);  // and it cannot stop there
  // To the right of r30c8 is no track.
  EXPECT_DOUBLE_EQ(probability(mdp, "r30c8u1r0", "u-1r+1", "r31c5u0r0"), 1.0 / 6.0);
}

TEST(Racetrack, EndsOnTheFinishLine) {
  const World world = made("racetrack", {{"failure", "0"}});
  const Mdp& mdp = *world.mdp;
  EXPECT_TRUE(mdp.terminal(*mdp.find_state("finish")));
  EXPECT_EQ(led(mdp, "r3c15u0r1", "u0r0").to, "finish");
  EXPECT_EQ(led(mdp, "r3c13u0r3", "u0r+1").to, "finish");  // across it
  // 1 up and 4 right: r2c14, then r1c15 (a half is rounded up), then the line.
  EXPECT_EQ(led(mdp, "r2c13u1r3", "u0r+1").to, "finish");
}

TEST(Racetrack, TheAccelerationFails) {
  const World world = made("racetrack");
  const Mdp& mdp = *world.mdp;
  EXPECT_DOUBLE_EQ(probability(mdp, "r31c3u0r0", "u+1r0", "r30c3u1r0"), 0.9);
  EXPECT_DOUBLE_EQ(probability(mdp, "r31c3u0r0", "u+1r0", "r31c3u0r0"), 0.1);
  EXPECT_DOUBLE_EQ(probability(mdp, "r31c3u0r0", "u0r0", "r31c3u0r0"), 1.0);
}

}  // namespace
}  // namespace quoll
