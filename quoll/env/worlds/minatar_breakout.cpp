// MinAtar's Breakout: keep the ball in play and break three rows of bricks, which return when all
// are broken. What all five games share stands in minatar.hpp.
//
// Channels: paddle, ball, trail, brick; the trail is the ball's previous cell. Minimal actions:
// stay, left, right. Reward 1 for a brick; the end is a ball that reaches row 9 beside the paddle.
// There is no ramp.
//
// One step, in this order:
//   The paddle moves along row 9, within the grid.
//   The ball's next cell is one diagonal step on. Beyond a side wall: the column stays in the grid
//     and the ball turns sideways. Then the first that holds:
//   - above the grid: row 0, and the ball turns downwards;
//   - a brick there: without a strike pending the brick breaks, the ball keeps its row (in the new
//     column) and turns; a strike is then pending. With one pending the ball enters the brick;
//   - row 9: without any brick left rows 1-3 are filled again. The paddle under the ball's old
//     column: the ball keeps its row and turns upwards; under its new column: it keeps its row and
//     goes back the way it came; elsewhere: the end.
//   A step without a brick at the ball's next cell ends a pending strike.
//
// Draws: a start one below(2), 0 the ball at the left going right, 1 at the right going left; a
// step none after the sticky one.
//
// State: paddle; ball_x, ball_y; direction up-left | up-right | down-right | down-left; last_x,
// last_y, the trail; strike: one is pending; bricks.

#include "quoll/env/worlds/minatar.hpp"

namespace quoll {
namespace {

using namespace minatar;

struct Breakout {
  static constexpr Channel channels[] = {{"paddle", '=', Ink::agent},
                                         {"ball", 'o', Ink::goal},
                                         {"trail", '-', Ink::faint},
                                         {"brick", '#', Ink::wall}};
  static constexpr Move minimal[] = {stay, left, right};
  static constexpr std::pair<double, double> reward_bounds{0.0, 1.0};
  static constexpr bool ramps = false;

  // Sideways turn: code ^ 1; upside down: code ^ 3; both: code ^ 2.
  static constexpr std::string_view direction_names[] = {"up-left", "up-right", "down-right",
                                                         "down-left"};
  static constexpr int direction_x[] = {-1, 1, 1, -1};
  static constexpr int direction_y[] = {-1, -1, 1, 1};
  static constexpr Board all_bricks{{((std::uint64_t{1} << 30) - 1) << 10, 0}};

  struct Position : Common {
    std::int8_t paddle = 4, ball_x = 0, ball_y = 3;
    std::uint8_t direction = 2;
    std::int8_t last_x = 0, last_y = 3;
    bool strike = false;
    Board bricks = all_bricks;

    template <class Archive>
    void persist(Archive& archive) {
      persist_within(archive, "paddle", paddle, 0, 9);
      persist_within(archive, "ball_x", ball_x, 0, 9);
      persist_within(archive, "ball_y", ball_y, 0, 9);
      persist_word(archive, "direction", direction, direction_names);
      persist_within(archive, "last_x", last_x, 0, 9);
      persist_within(archive, "last_y", last_y, 0, 8);
      archive("strike", strike);
      persist_board(archive, "bricks", bricks);
      persist_common(archive);
      if (archive.saving()) return;
      if (bricks.without(all_bricks).any()) archive.fail("bricks: only rows 1 to 3 hold bricks");
      if (ball_y == 9 && !over) archive.fail("ball_y: 9 is the end, and the state is not over");
    }
  };

  static Position start(auto& dice) {
    Position at;
    if (dice.below(2) == 1) {
      at.ball_x = at.last_x = 9;
      at.direction = 3;
    }
    return at;
  }

  static double act(Position& at, Move move, bool, auto&) {
    double reward = 0.0;
    at.paddle = static_cast<std::int8_t>(std::clamp(at.paddle + move_x[move], 0, 9));
    at.last_x = at.ball_x;
    at.last_y = at.ball_y;
    int x = at.ball_x + direction_x[at.direction];
    int y = at.ball_y + direction_y[at.direction];
    if (outside(x)) {
      x = std::clamp(x, 0, 9);
      at.direction ^= 1;
    }
    bool brick = false;
    if (y < 0) {
      y = 0;
      at.direction ^= 3;
    } else if (at.bricks.has(x, y)) {
      brick = true;
      if (!at.strike) {
        at.strike = true;
        reward = 1.0;
        at.bricks.remove(x, y);
        y = at.last_y;
        at.direction ^= 3;
      }
    } else if (y == 9) {
      if (!at.bricks.any()) at.bricks = all_bricks;
      if (at.ball_x == at.paddle) {
        at.direction ^= 3;
        y = at.last_y;
      } else if (x == at.paddle) {
        at.direction ^= 2;
        y = at.last_y;
      } else {
        at.over = true;
      }
    }
    if (!brick) at.strike = false;
    at.ball_x = static_cast<std::int8_t>(x);
    at.ball_y = static_cast<std::int8_t>(y);
    return reward;
  }

  static void show(const Position& at, Flags<4> flags) {
    flags.set(0, at.paddle, 9);
    flags.set(1, at.ball_x, at.ball_y);
    flags.set(2, at.last_x, at.last_y);
    flags.set(3, at.bricks);
  }
};

}  // namespace

extern const WorldEntry minatar_breakout_world;
const WorldEntry minatar_breakout_world{
    "minatar-breakout",
    "MinAtar/Breakout-v0 MinAtar/Breakout-v1:minimal=true",
    "MinAtar: keep the ball in play and break the bricks",
    "Young and Tian 2019, arXiv 1903.03176; MinAtar 1.0.15",
    [](const Parameters& given) { return minatar::make<Breakout>("minatar-breakout", given); },
    parameters_of<minatar::SettingsOf<Breakout>>};

}  // namespace quoll
