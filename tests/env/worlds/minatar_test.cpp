// What MinAtar's five games share.

#include "quoll/env/worlds/minatar.hpp"

#include "minatar_game.hpp"

namespace quoll::minatar_tests {
namespace {

const char* const names[] = {"minatar-asterix", "minatar-breakout", "minatar-freeway",
                             "minatar-seaquest", "minatar-space-invaders"};

TEST(Minatar, SpacesAndNames) {
  const std::uint32_t channels[] = {4, 4, 7, 10, 6}, minimal[] = {5, 3, 3, 6, 4};
  const char* const ids[] = {"Asterix", "Breakout", "Freeway", "Seaquest", "SpaceInvaders"};
  for (int i = 0; i < 5; ++i) {
    for (const bool few : {false, true}) {
      const std::string id = std::string("MinAtar/") + ids[i] + (few ? "-v1" : "-v0");
      const Result<World> world = find_world(id);
      ASSERT_TRUE(world) << id;
      EXPECT_EQ(world->name, names[i]);
      EXPECT_EQ(world->discount, 0.99);
      EXPECT_EQ(world->episode_steps, 100'000u);
      const Spaces spaces = world->make({})->spaces();
      EXPECT_EQ(spaces.actions, few ? minimal[i] : 6) << id;
      EXPECT_EQ(world->action_names.size(), spaces.actions);
      EXPECT_EQ(spaces.observation, 100 * channels[i]);
      EXPECT_EQ(spaces.shape, (std::array<std::uint32_t, 3>{10, 10, channels[i]}));
      EXPECT_TRUE(spaces.whole);
    }
  }
  EXPECT_EQ(find_world("MinAtar/SpaceInvaders-v1")->action_names,
            (std::vector<std::string>{"stay", "left", "right", "fire"}));
  EXPECT_FALSE(find_world("minatar-breakout", {{"sticky", "1.5"}}));
}

// Below 0.1 the previous action comes again, and stays the previous one.
TEST(Minatar, StickyActions) {
  Game game("minatar-asterix");
  EXPECT_EQ(game.words("previous"), "stay");
  game.step_with(right, {0.0999});
  EXPECT_EQ(game.whole("x"), 5);
  EXPECT_EQ(game.words("previous"), "stay");
  game.step_with(right, {0.1});
  EXPECT_EQ(game.whole("x"), 6);
  EXPECT_EQ(game.words("previous"), "right");
  game.step_with(left, {0.0});
  EXPECT_EQ(game.whole("x"), 7);
  game.step_with(left, {0.0});
  EXPECT_EQ(game.whole("x"), 8);
  EXPECT_EQ(game.words("previous"), "right");
  EXPECT_TRUE(game.draws_left());
  game.step_with(left, {});
  EXPECT_FALSE(game.draws_left());
}

// The draw is made with sticky = 0 too; the repeated action is the one behind the number.
TEST(Minatar, TheStickyDrawIsAlwaysMade) {
  Game never("minatar-breakout", {{"sticky", "0"}, {"minimal", "true"}}, {0});
  never.step_with(2, {0.0});  // right, the third of stay, left, right
  EXPECT_EQ(never.whole("paddle"), 5);
  EXPECT_TRUE(never.draws_left());
  never.step_with(2, {});
  EXPECT_FALSE(never.draws_left());
  Game always("minatar-breakout", {{"sticky", "1"}, {"minimal", "true"}}, {0});
  always.step_with(2, {0.999});
  EXPECT_EQ(always.whole("paddle"), 4);
}

TEST(Minatar, AfterTheEndNothingHappens) {
  for (const char* const name : names) {
    Game game(name, {}, std::vector<double>(16, 0.0));
    ASSERT_EQ(game.set({{"over", Tree(true)}}), "") << name;
    const Tree before = game.state();
    const Feedback feedback = game.step_with(left, {});
    EXPECT_EQ(feedback.reward, 0.0);
    EXPECT_TRUE(feedback.terminated);
    EXPECT_EQ(game.state(), before);
    EXPECT_TRUE(game.draws_left());
  }
}

// Every state met can be given back as data, and nothing of it is lost that an observation shows.
TEST(Minatar, StatesGoThroughDataUnchanged) {
  for (const char* const name : names) {
    Rng rng = stream(3, "tape");
    const Result<World> world = find_world(name);
    const auto environment = world->make({2, 1, 0, nullptr});
    const std::size_t size = environment->spaces().observation;
    std::vector<State> state(2), next(2);
    std::vector<Action> action(2);
    std::vector<Feedback> feedback(2);
    std::vector<float> x(2 * size), y(2 * size);
    Experience now{state, action, feedback, next, x, y};
    std::vector<std::uint8_t> restart(2, 1);
    environment->restart(restart, now);
    for (int t = 0; t < 600; ++t) {
      for (Action& one : action) one = rng.below(6);
      environment->step(now);
      Inspector& inspector = *environment->inspector();
      const Tree seen = inspector.state(0, 0);
      const Result<void> done = inspector.set(1, seen, state[1]);
      ASSERT_TRUE(done) << name << ": " << done.error().expected;
      ASSERT_EQ(inspector.state(1, 0), seen);
      ASSERT_EQ(inspector.observation(1, 0), inspector.observation(0, 0));
      restart = {feedback[0].terminated, 0};
      environment->restart(restart, now);
    }
  }
}

TEST(Minatar, ImpossibleStatesAreRefused) {
  Game asterix("minatar-asterix");
  EXPECT_EQ(asterix.set({{"x", number(10)}}), "x: a whole number from 0 to 9 expected");
  EXPECT_EQ(asterix.set({{"y", number(0)}}), "y: a whole number from 1 to 8 expected");
  EXPECT_EQ(asterix.set({{"previous", word("jump")}}),
            "previous: one of stay, left, up, right, down, fire expected");
  Game breakout("minatar-breakout", {}, {0});
  EXPECT_EQ(breakout.set({{"ball_y", number(9)}}),
            "ball_y: 9 is the end, and the state is not over");
  EXPECT_EQ(breakout.set({{"bricks", board({{0, 4}})}}), "bricks: only rows 1 to 3 hold bricks");
  Tree::List rows(10, word(".........."));
  rows[3] = word("....x.....");
  EXPECT_EQ(breakout.set({{"bricks", Tree(rows)}}), "bricks[3]: ten letters '.' or '#' expected");
  Game freeway("minatar-freeway", {}, std::vector<double>(16, 0.0));
  EXPECT_EQ(freeway.set({{"car_speed", Tree(Tree::List(8, number(0)))}}),
            "car_speed: whole numbers from -5 to 5 without 0 expected");
  Game seaquest("minatar-seaquest");
  EXPECT_EQ(seaquest.set({{"x", number(9)}}), "x: the submarine's back is out of the grid");
  EXPECT_EQ(seaquest.set({{"oxygen", number(-1)}}), "oxygen: below 0, and the state is not over");
  Game invaders("minatar-space-invaders");
  EXPECT_EQ(invaders.set({{"aliens", board({})}}), "aliens: at least one expected");
}

TEST(Minatar, TextAndDrawing) {
  Game game("minatar-breakout", {}, {1});
  EXPECT_EQ(game.environment().inspector()->text(0, 0),
            "..........\n"
            "##########\n"
            "##########\n"
            "#########o\n"
            "..........\n"
            "..........\n"
            "..........\n"
            "..........\n"
            "..........\n"
            "....=.....\n"
            "= paddle, o ball, - trail, # brick\n"
            "previous action: stay");
  const Drawing drawing = game.environment().inspector()->drawing(0, 0);
  EXPECT_EQ(drawing.width, 10.0);
  // The floor, the trail, 30 bricks, the ball and the paddle, which lies on top.
  ASSERT_EQ(drawing.shapes.size(), 34u);
  EXPECT_EQ(drawing.shapes.back().points[0], (std::pair<double, double>{4.0, 9.0}));
}

TEST(Minatar, BoardsMove) {
  minatar::Board board;
  board.add(3, 4);
  board.add(9, 9);
  EXPECT_TRUE(board.lowered().has(3, 5));
  EXPECT_EQ(board.lowered().count(), 1);
  EXPECT_EQ(board.lowered().raised().count(), 1);
  EXPECT_TRUE(board.lowered().raised().has(3, 4));
  EXPECT_TRUE(board.moved(false).has(8, 9));
  EXPECT_TRUE(board.moved(false).moved(true) == board);
  EXPECT_EQ(board.columns(), 0x208u);
  EXPECT_EQ(board.of_row(9), 0x200u);
  EXPECT_TRUE(board.any_in_column(9));
  EXPECT_FALSE(board.any_in_column(0));
}

}  // namespace
}  // namespace quoll::minatar_tests
