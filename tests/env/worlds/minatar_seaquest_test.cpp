#include "minatar_game.hpp"

namespace quoll::minatar_tests {
namespace {

Fields bullet_fields(int x, int y, bool rightwards) {
  return {{"x", number(x)}, {"y", number(y)}, {"right", Tree(rightwards)}};
}
Tree bullet(int x, int y, bool rightwards) {
  return object(bullet_fields(x, y, rightwards));
}
Tree swimmer(int x, int y, bool rightwards, int timer) {
  Fields fields = bullet_fields(x, y, rightwards);
  fields.emplace_back("timer", number(timer));
  return object(fields);
}
Tree submarine(int x, int y, bool rightwards, int timer, int shot_timer) {
  Fields fields = bullet_fields(x, y, rightwards);
  fields.emplace_back("timer", number(timer));
  fields.emplace_back("shot_timer", number(shot_timer));
  return object(fields);
}
Tree list(std::vector<Tree> entries) {
  return Tree(Tree::List(std::move(entries)));
}

TEST(Seaquest, Start) {
  Game game("minatar-seaquest");
  game.step(stay);
  EXPECT_EQ(game.cells(0), (Cells{{5, 0}}));
  EXPECT_EQ(game.cells(1), (Cells{{6, 0}}));  // it faces left
  EXPECT_EQ(game.cells(7).size(), 10u);
  EXPECT_EQ(game.cells(8), Cells{});
  EXPECT_EQ(game.whole("oxygen"), 200);  // none is used on row 0
  EXPECT_TRUE(game.flag("surfaced"));
}

TEST(Seaquest, EnemiesAndDiversAppear) {
  Game game("minatar-seaquest");
  for (int t = 0; t < 20; ++t) game.step(stay);
  game.step(stay, {0.4, 0.3, 6});  // from the left, a submarine, row 7
  EXPECT_EQ(game.at("submarines"), list({submarine(0, 7, true, 4, 9)}));
  EXPECT_EQ(game.whole("spawn_timer"), 19);
  for (int t = 21; t < 30; ++t) game.step(stay);
  game.step(stay, {0.6, 0});
  EXPECT_EQ(game.at("divers"), list({swimmer(9, 1, false, 4)}));
  EXPECT_EQ(game.whole("diver_spawn_timer"), 29);
  // None against an enemy of the same row; the draws are made and the timer restarts.
  game.set({{"spawn_timer", number(0)}});
  game.step(stay, {0.6, 0.5, 6});
  EXPECT_EQ(game.size("fish"), 0u);
  EXPECT_EQ(game.whole("spawn_timer"), 19);
  game.set({{"spawn_timer", number(0)}, {"diver_spawn_timer", number(0)}});
  game.step(stay, {0.2, 0.5, 6, 0.1, 3});  // the enemy's draws first
  EXPECT_EQ(game.at("fish"), list({swimmer(0, 7, true, 4)}));
  EXPECT_EQ(game.size("divers"), 2u);
  EXPECT_TRUE(game.draws_left());
}

TEST(Seaquest, TheSubmarineSteersAndFires) {
  Game game("minatar-seaquest");
  game.set({{"y", number(8)}, {"surfaced", Tree(false)}});
  game.step(right);
  EXPECT_EQ(game.cells(1), (Cells{{5, 8}}));
  game.step(down);
  EXPECT_EQ(game.whole("y"), 8);
  game.step(fire);
  EXPECT_EQ(game.at("bullets"), list({bullet(7, 8, true)}));
  EXPECT_EQ(game.whole("shot_timer"), 4);
  game.step(fire);
  EXPECT_EQ(game.at("bullets"), list({bullet(8, 8, true)}));
  game.step(left);
  EXPECT_FALSE(game.flag("right"));
  game.step(stay);
  EXPECT_EQ(game.size("bullets"), 0u);  // off
}

TEST(Seaquest, BulletsHitFishBeforeSubmarines) {
  Game game("minatar-seaquest");
  game.set({{"bullets", list({bullet(2, 4, true)})},
            {"fish", list({swimmer(3, 4, true, 5)})},
            {"submarines", list({submarine(3, 4, true, 5, 5)})}});
  EXPECT_EQ(game.step(stay).reward, 1.0);
  EXPECT_EQ(game.size("fish"), 0u);
  EXPECT_EQ(game.size("submarines"), 1u);
  EXPECT_EQ(game.size("bullets"), 0u);
  game.set({{"bullets", list({bullet(2, 4, true)})}});
  EXPECT_EQ(game.step(stay).reward, 1.0);
  EXPECT_EQ(game.size("submarines"), 0u);
}

// Two bullets in a row: when the rear one hits a fish beside the front one's old place, it equals
// that one, which goes in its stead; the rear one is taken again and moves twice.
TEST(Seaquest, TheFirstEqualEntryGoes) {
  Game game("minatar-seaquest");
  game.set({{"bullets", list({bullet(5, 4, true), bullet(4, 4, true)})},
            {"fish", list({swimmer(5, 4, false, 5)})}});
  EXPECT_EQ(game.step(stay).reward, 1.0);
  EXPECT_EQ(game.at("bullets"), list({bullet(6, 4, true)}));
}

// A submarine that moves into a bullet fires all the same, from where it is.
TEST(Seaquest, AHitSubmarineStillFires) {
  Game game("minatar-seaquest");
  game.set({{"bullets", list({bullet(6, 4, false)})},
            {"submarines", list({submarine(4, 4, true, 0, 0)})}});
  EXPECT_EQ(game.step(stay).reward, 1.0);
  EXPECT_EQ(game.size("submarines"), 0u);
  EXPECT_EQ(game.size("bullets"), 0u);
  EXPECT_EQ(game.at("enemy_bullets"), list({bullet(6, 4, true)}));  // and its bullet has moved
}

TEST(Seaquest, EnemiesMoveAndShoot) {
  Game game("minatar-seaquest");
  game.set({{"submarines", list({submarine(9, 3, true, 0, 0), submarine(2, 5, false, 1, 0)})},
            {"fish", list({swimmer(0, 8, false, 0), swimmer(5, 7, true, 0)})},
            {"enemy_bullets", list({bullet(0, 2, false), bullet(4, 2, true)})}});
  game.step(stay);
  EXPECT_EQ(game.at("submarines"), list({submarine(2, 5, false, 0, 10)}));
  EXPECT_EQ(game.at("fish"), list({swimmer(6, 7, true, 5)}));
  EXPECT_EQ(game.at("enemy_bullets"), list({bullet(5, 2, true), bullet(1, 5, false)}));
  EXPECT_EQ(game.cells(3), (Cells{{3, 5}, {5, 7}}));
}

TEST(Seaquest, EnemiesAndTheirBulletsEnd) {
  const auto ends = [](const Fields& fields) {
    Game game("minatar-seaquest");
    game.set({{"x", number(4)}, {"y", number(4)}, {"surfaced", Tree(false)}});
    EXPECT_EQ(game.set(fields), "");
    return game.step(stay).terminated;
  };
  EXPECT_FALSE(ends({{"fish", list({swimmer(3, 4, true, 1)})}}));
  EXPECT_TRUE(ends({{"fish", list({swimmer(3, 4, true, 0)})}}));
  EXPECT_TRUE(ends({{"fish", list({swimmer(4, 4, true, 0)})}}));  // before it swims on
  EXPECT_TRUE(ends({{"submarines", list({submarine(5, 4, false, 0, 5)})}}));
  EXPECT_TRUE(ends({{"enemy_bullets", list({bullet(3, 4, true)})}}));
  EXPECT_TRUE(ends({{"enemy_bullets", list({bullet(4, 4, true)})}}));
  EXPECT_FALSE(ends({{"enemy_bullets", list({bullet(5, 4, true)})}}));
}

TEST(Seaquest, DiversComeAboard) {
  Game game("minatar-seaquest");
  game.set({{"y", number(4)},
            {"surfaced", Tree(false)},
            {"divers_aboard", number(4)},
            {"divers", list({swimmer(5, 4, true, 3), swimmer(4, 4, true, 0),
                             swimmer(6, 4, false, 0), swimmer(9, 6, true, 0)})}});
  game.step(stay);  // from the back: one leaves the grid, two come aboard, then six are aboard
  EXPECT_EQ(game.whole("divers_aboard"), 6);
  EXPECT_EQ(game.at("divers"), list({swimmer(5, 4, true, 2)}));
  EXPECT_EQ(game.cells(8), (Cells{{3, 9}, {4, 9}, {5, 9}, {6, 9}, {7, 9}, {8, 9}}));
}

// Below the surface each step takes 1; the step that begins with 0 is the last.
TEST(Seaquest, Oxygen) {
  Game game("minatar-seaquest");
  game.set({{"y", number(4)}, {"oxygen", number(1)}});
  EXPECT_FALSE(game.step(stay).terminated);
  EXPECT_FALSE(game.flag("surfaced"));
  EXPECT_EQ(game.whole("oxygen"), 0);
  EXPECT_TRUE(game.step(stay).terminated);
  EXPECT_EQ(game.whole("oxygen"), -1);
  game.set({{"over", Tree(false)}, {"oxygen", number(60)}});
  game.step(stay);
  EXPECT_EQ(game.cells(7), (Cells{{0, 9}, {1, 9}}));  // floor(59 / 20)
}

TEST(Seaquest, Surfacing) {
  Game game("minatar-seaquest", {{"ramping", "false"}});
  const auto surface = [&](int aboard, int oxygen) {
    game.set({{"y", number(1)},
              {"surfaced", Tree(false)},
              {"over", Tree(false)},
              {"oxygen", number(oxygen)},
              {"divers_aboard", number(aboard)}});
    return game.step(up);
  };
  EXPECT_TRUE(surface(0, 100).terminated);
  EXPECT_EQ(game.whole("oxygen"), 100);
  EXPECT_EQ(surface(1, 100).reward, 0.0);
  EXPECT_EQ(game.whole("divers_aboard"), 0);
  EXPECT_EQ(game.whole("oxygen"), 200);
  EXPECT_TRUE(game.flag("surfaced"));
  EXPECT_FALSE(game.step(stay).terminated);  // staying there is no surfacing
  EXPECT_EQ(surface(5, 199).reward, 0.0);
  EXPECT_EQ(game.whole("divers_aboard"), 4);
  EXPECT_EQ(surface(6, 199).reward, 9.0);  // floor(199 / 20)
  EXPECT_EQ(game.whole("divers_aboard"), -1);
  EXPECT_EQ(surface(6, 19).reward, 0.0);
  EXPECT_FALSE(surface(-1, 100).terminated);  // not 0, so no end
  EXPECT_EQ(game.whole("divers_aboard"), -2);
  EXPECT_EQ(game.cells(8), Cells{});
  EXPECT_EQ(game.whole("ramp_index"), 0);
  EXPECT_EQ(game.whole("spawn_speed"), 20);
}

TEST(Seaquest, EachSurfacingRamps) {
  Game game("minatar-seaquest");
  const auto surface = [&] {
    game.set({{"y", number(1)}, {"surfaced", Tree(false)}, {"divers_aboard", number(3)}});
    game.set({{"spawn_timer", number(5)}, {"diver_spawn_timer", number(5)}});
    game.step(up);
  };
  surface();
  EXPECT_EQ(game.whole("spawn_speed"), 19);
  EXPECT_EQ(game.whole("move_speed"), 5);  // index 0 is even
  surface();
  EXPECT_EQ(game.whole("spawn_speed"), 18);
  EXPECT_EQ(game.whole("move_speed"), 4);
  for (int i = 0; i < 30; ++i) surface();
  EXPECT_EQ(game.whole("spawn_speed"), 1);
  EXPECT_EQ(game.whole("move_speed"), 2);
  EXPECT_EQ(game.whole("ramp_index"), 19);
}

// At the fastest an enemy crosses in 29 steps and one appears in each: the lists never fill.
TEST(Seaquest, TwentyNineEnemiesAtMost) {
  Game game("minatar-seaquest", {{"sticky", "0"}});
  std::size_t most = 0;
  for (int t = 0; t < 200; ++t) {
    game.set({{"spawn_speed", number(1)},
              {"move_speed", number(2)},
              {"spawn_timer", number(0)},
              {"diver_spawn_timer", number(9)}});
    game.step(stay, {0.1, t % 2 == 0 ? 0.1 : 0.9, double(t % 8)});
    most = std::max(most, game.size("fish") + game.size("submarines"));
  }
  EXPECT_TRUE(game.draws_left());
  EXPECT_EQ(most, 29u);
}

TEST(Seaquest, TooLongListsAreRefused) {
  Game game("minatar-seaquest");
  EXPECT_EQ(game.set({{"fish", list(std::vector<Tree>(33, swimmer(1, 1, true, 1)))}}),
            "fish: at most 32 entries expected");
  EXPECT_EQ(game.set({{"fish", list(std::vector<Tree>(32, swimmer(1, 1, true, 1)))}}), "");
  game.set({{"spawn_timer", number(0)}});
  game.step(stay, {0.1, 0.9, 4});
  EXPECT_EQ(game.size("fish"), 32u);
}

}  // namespace
}  // namespace quoll::minatar_tests
