#include "quoll/env/worlds/taxi.hpp"

#include <gtest/gtest.h>

#include <map>

#include "played.hpp"

namespace quoll::world_tests {
namespace {

// Value iteration over the tables of Gymnasium's program (Taxi-v4), mean over the 300 starts.
TEST(Taxi, HasTheKnownOptima) {
  EXPECT_NEAR(optimum(made("taxi"), 0.99), 6.327464314919, 6e-13);
  EXPECT_NEAR(optimum(made("taxi"), 0.9), -1.263323099040, 6e-13);
  EXPECT_NEAR(optimum_in(made("taxi"), 200), 7.93, 1e-12);
  const World rainy = made("taxi", {{"rainy", "true"}});
  EXPECT_NEAR(optimum(rainy, 0.99), 2.247629323605, 6e-13);
  EXPECT_NEAR(optimum(rainy, 0.9), -3.763146500302, 6e-13);
  EXPECT_NEAR(optimum_in(rainy, 200), 3.954575, 6e-7);
}

TEST(Taxi, NumbersItsStates) {
  for (State s = 0; s < cab_states; ++s) EXPECT_EQ(cab_number(cab_of(s)), s);
  EXPECT_EQ(cab_number({3, 1, 2, 0}), 328u);
  const World world = made("Taxi-v3");
  EXPECT_EQ(world.mdp->state_name(328), "r3c1-Y-to-R");
  EXPECT_EQ(world.mdp->state_name(cab_number({0, 0, aboard, 3})), "r0c0-aboard-to-B");
  EXPECT_EQ(world.mdp->start().size(), 300u);
  EXPECT_EQ(world.episode_steps, 200u);
}

TEST(Taxi, DrivesBetweenWalls) {
  EXPECT_EQ(drive({0, 1, 0, 1}, 2).cab.column, 1u);  // a wall right of column 1 in row 0
  EXPECT_EQ(drive({2, 1, 0, 1}, 2).cab.column, 2u);
  EXPECT_EQ(drive({3, 1, 0, 1}, 3).cab.column, 1u);  // and left of column 1 in row 3
  EXPECT_EQ(drive({0, 0, 0, 1}, 3).cab.column, 0u);
  EXPECT_EQ(drive({4, 4, 0, 1}, 0).cab.row, 4u);
  EXPECT_EQ(drive({0, 4, 0, 1}, 1).cab.row, 0u);
  EXPECT_EQ(drive({0, 0, 0, 1}, 4).cab.passenger, aboard);
  EXPECT_EQ(drive({0, 1, 0, 1}, 4).reward, -10.0);
  EXPECT_EQ(drive({2, 2, aboard, 1}, 5).reward, -10.0);
  EXPECT_EQ(drive({0, 4, aboard, 1}, 5).reward, 20.0);
  EXPECT_TRUE(has_arrived(drive({0, 4, aboard, 1}, 5).cab));
  const CabMove elsewhere = drive({4, 3, aboard, 1}, 5);
  EXPECT_EQ(elsewhere.reward, -1.0);
  EXPECT_EQ(elsewhere.cab.passenger, 3u);
}

TEST(Taxi, RainPushesToTheSidesOfAMoveThatIsMade) {
  const World world = made("taxi", {{"rainy", "true"}});
  const Mdp& mdp = *world.mdp;
  const auto outcomes = [&](const Cab& cab, Action a) {
    std::vector<State> next;
    const std::uint64_t c = mdp.choice_begin(cab_number(cab)) + a;
    for (auto o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) next.push_back(mdp.next(o));
    return next;
  };
  EXPECT_EQ(outcomes({2, 2, 0, 1}, 1),  // north; to its left west, to its right east
            (std::vector<State>{cab_number({1, 2, 0, 1}), cab_number({2, 1, 0, 1}),
                                cab_number({2, 3, 0, 1})}));
  const State here = cab_number({0, 1, 0, 1});
  EXPECT_EQ(outcomes({0, 1, 0, 1}, 2), (std::vector<State>{here, here, here}));
}

// Gymnasium 1.4 in preparation, Taxi-v4, env.reset(seed=42) with actions t % 4, and is_rainy=True
// with seed 3 and actions t % 6.
TEST(Taxi, FollowsGymnasiumForTheSameSeed) {
  const Played dry = play(made("Taxi-v4", {{"seeding", "gymnasium"}}), 42, 12,
                          [](int t) { return Action(t % 4); });
  EXPECT_EQ(dry.starts, numbers({386}));
  EXPECT_EQ(dry.observed, numbers({486, 386, 386, 366, 466, 366, 386, 366, 466, 366, 386, 366}));
  const Played wet = play(made("taxi", {{"rainy", "true"}, {"seeding", "gymnasium"}}), 3, 24,
                          [](int t) { return Action(t % 6); });
  EXPECT_EQ(wet.starts, numbers({42}));
  EXPECT_EQ(wet.observed, numbers({142, 142, 162, 142, 142, 142, 242, 142, 162, 142, 142, 142,
                                   242, 142, 242, 222, 222, 222, 322, 222, 322, 322, 322, 322}));
}

// The same version with fickle_passenger=True and seed 285: the passenger of r0c1-R-to-G is fetched
// and changes to R on the first move.
TEST(Taxi, APassengerMayChangeHisMindAsInGymnasium) {
  const std::vector<Action> actions{3, 4, 0, 1, 0, 0, 0};
  const World guest = made("taxi", {{"fickle", "true"}, {"seeding", "gymnasium"}});
  const Played played = play(guest, 285, 7, [&](int t) { return actions[t]; });
  EXPECT_EQ(played.starts, numbers({21}));
  EXPECT_EQ(played.observed, numbers({1, 17, 116, 16, 116, 216, 316}));
}

TEST(Taxi, AFickleTaxiKnowsWhetherTheFirstMoveWasMade) {
  const World world = made("taxi", {{"fickle", "true"}, {"fickle_probability", "0.6"}});
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 1000u);
  const State here = cab_number({2, 2, aboard, 1});
  std::map<State, double> to;
  const std::uint64_t south = mdp.choice_begin(here);
  for (auto o = mdp.outcome_begin(south); o < mdp.outcome_end(south); ++o) {
    to[mdp.next(o)] += mdp.probability(o);
  }
  ASSERT_EQ(to.size(), 4u);
  EXPECT_EQ(to[cab_number({3, 2, aboard, 1}) + 500], 0.4);
  EXPECT_NEAR(to[cab_number({3, 2, aboard, 0}) + 500], 0.2, 1e-15);
  EXPECT_EQ(mdp.next(mdp.outcome_begin(mdp.choice_begin(here + 500))),
            cab_number({3, 2, aboard, 1}) + 500);
  EXPECT_EQ(mdp.state_name(here + 500), "r2c2-aboard-to-G-settled");
  const auto environment = world.make({1, 1, 0, nullptr});
  EXPECT_EQ(environment->inspector()->observation(0, here + 500), Tree(std::int64_t{here}));
}

// The frequencies of the program that draws the mind at the start are those of the table.
TEST(Taxi, BothWaysOfDrawingTheMindAreAlike) {
  const Parameters guest{{"fickle", "true"}, {"seeding", "gymnasium"}};
  const auto environment = made("taxi", guest).make({1, 5, 0, nullptr});
  const State here = cab_number({2, 2, aboard, 1});
  State state = here, next = 0;
  Action south = 0;
  Feedback feedback;
  Experience now{{&state, 1}, {&south, 1}, {&feedback, 1}, {&next, 1}, {}, {}};
  std::map<State, int> count;
  for (int i = 0; i < 20'000; ++i) {
    ASSERT_TRUE(environment->set(0, here));
    environment->step(now);
    ++count[next];
  }
  EXPECT_EQ(count.size(), 4u);
  EXPECT_NEAR(count[cab_number({3, 2, aboard, 1}) + 500], 14'000, 330);  // 5 standard deviations
  EXPECT_NEAR(count[cab_number({3, 2, aboard, 3}) + 500], 2'000, 215);
}

TEST(Taxi, ShowsItsTown) {
  EXPECT_EQ(cab_text({4, 2, aboard, 3}),
            "+---------+\n|R: | : :G|\n| : | : : |\n| : : : : |\n| | : | : |\n|Y| :T|B: |\n"
            "+---------+\npassenger aboard, destination B\n");
  EXPECT_EQ(cab_drawing({1, 1, 0, 3}).width, 5.0);
}

}  // namespace
}  // namespace quoll::world_tests
