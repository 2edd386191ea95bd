// MinAtar's Asterix: collect gold, avoid enemies; both cross the screen, one of them per row. What
// all five games share stands in minatar.hpp.
//
// Channels: player, enemy, trail, gold; a trail is the cell behind an enemy or a piece of gold.
// Minimal actions: all but fire. Reward 1 for a piece of gold; the end is the touch of an enemy.
//
// One step, in this order:
//   spawn_timer is 0: something appears in a free row, at the left edge going right or at the right
//     edge going left (nothing when all eight rows are taken); the timer becomes spawn_speed.
//   The player moves, within columns 0-9 and rows 1-8, and touches what stands there.
//   move_timer is 0: it becomes move_speed, everything moves one cell, what leaves the grid is
//   gone,
//     and the player touches what has come.
//   Both timers fall by 1.
//   Ramp, while a speed is above 1: ramp_timer falls by 1; once below 0 it becomes 100, move_speed
//     falls by 1 (when above 1, and ramp_index is odd), spawn_speed falls by 1 (when above 1), and
//     ramp_index rises.
//
// Draws of a step after the sticky one, only when something may appear: uniform < 1/2 from the
// left; uniform < 1/3 gold; below(free rows) which of them, from the top, if there is one. A start
// draws nothing.
//
// State: x, y of the player; rows, of rows 1-8, each {kind none | enemy | gold, x, right: it moves
// to the right}; spawn_timer, spawn_speed, move_timer, move_speed, ramp_timer, ramp_index.

#include "quoll/env/worlds/minatar.hpp"

namespace quoll {
namespace {

using namespace minatar;

struct Asterix {
  static constexpr Channel channels[] = {{"player", 'P', Ink::agent},
                                         {"enemy", 'E', Ink::danger},
                                         {"trail", '-', Ink::faint},
                                         {"gold", 'G', Ink::reward}};
  static constexpr Move minimal[] = {stay, left, up, right, down};
  static constexpr std::pair<double, double> reward_bounds{0.0, 1.0};
  static constexpr bool ramps = true;

  enum class Kind : std::uint8_t { none, enemy, gold };
  static constexpr std::string_view kind_names[] = {"none", "enemy", "gold"};

  struct Crosser {
    Kind kind = Kind::none;
    std::int8_t x = 0;
    bool rightwards = false;

    template <class Archive>
    void persist(Archive& archive) {
      persist_word(archive, "kind", kind, kind_names);
      persist_within(archive, "x", x, 0, 9);
      archive("right", rightwards);
      if (!archive.saving() && kind == Kind::none) *this = {};
    }
  };

  struct Position : Common {
    std::int8_t x = 5, y = 5;
    std::array<Crosser, 8> rows;
    std::int8_t spawn_timer = 10, spawn_speed = 10, move_timer = 5, move_speed = 5;
    std::int8_t ramp_timer = 100;
    std::uint32_t ramp_index = 0;

    template <class Archive>
    void persist(Archive& archive) {
      persist_within(archive, "x", x, 0, 9);
      persist_within(archive, "y", y, 1, 8);
      archive("rows", rows);
      persist_within(archive, "spawn_timer", spawn_timer, 0, 10);
      persist_within(archive, "spawn_speed", spawn_speed, 1, 10);
      persist_within(archive, "move_timer", move_timer, 0, 5);
      persist_within(archive, "move_speed", move_speed, 1, 5);
      persist_within(archive, "ramp_timer", ramp_timer, -1, 100);
      archive("ramp_index", ramp_index);
      persist_common(archive);
    }
  };

  static Position start(auto&) { return {}; }

  static void spawn(Position& at, auto& dice) {
    const bool rightwards = chance(dice, 1.0 / 2.0);
    const bool gold = chance(dice, 1.0 / 3.0);
    std::uint32_t free = 0;
    for (const Crosser& row : at.rows) free += row.kind == Kind::none;
    if (free == 0) return;
    std::uint32_t which = dice.below(free);
    for (Crosser& row : at.rows) {
      if (row.kind != Kind::none || which-- > 0) continue;
      row = {gold ? Kind::gold : Kind::enemy, static_cast<std::int8_t>(rightwards ? 0 : 9),
             rightwards};
      return;
    }
  }

  // What stands in the player's row is all that the player can touch.
  static double touch(Position& at) {
    Crosser& row = at.rows[at.y - 1];
    if (row.kind == Kind::none || row.x != at.x) return 0.0;
    if (row.kind == Kind::enemy) {
      at.over = true;
      return 0.0;
    }
    row = {};
    return 1.0;
  }

  static void ramp(Position& at) {
    if (at.spawn_speed <= 1 && at.move_speed <= 1) return;
    if (at.ramp_timer >= 0) {
      --at.ramp_timer;
      return;
    }
    if (at.move_speed > 1 && at.ramp_index % 2 == 1) --at.move_speed;
    if (at.spawn_speed > 1) --at.spawn_speed;
    ++at.ramp_index;
    at.ramp_timer = 100;
  }

  static double act(Position& at, Move move, bool ramping, auto& dice) {
    if (at.spawn_timer == 0) {
      spawn(at, dice);
      at.spawn_timer = at.spawn_speed;
    }
    at.x = static_cast<std::int8_t>(std::clamp(at.x + move_x[move], 0, 9));
    at.y = static_cast<std::int8_t>(std::clamp(at.y + move_y[move], 1, 8));
    double reward = touch(at);
    if (at.move_timer == 0) {
      at.move_timer = at.move_speed;
      for (Crosser& row : at.rows) {
        if (row.kind == Kind::none) continue;
        row.x = static_cast<std::int8_t>(row.x + (row.rightwards ? 1 : -1));
        if (outside(row.x)) row = {};
      }
      reward += touch(at);
    }
    --at.spawn_timer;
    --at.move_timer;
    if (ramping) ramp(at);
    return reward;
  }

  static void show(const Position& at, Flags<4> flags) {
    flags.set(0, at.x, at.y);
    for (int i = 0; i < 8; ++i) {
      const Crosser& row = at.rows[i];
      if (row.kind == Kind::none) continue;
      flags.set(row.kind == Kind::gold ? 3 : 1, row.x, i + 1);
      const int behind = row.x + (row.rightwards ? -1 : 1);
      if (!outside(behind)) flags.set(2, behind, i + 1);
    }
  }
};

}  // namespace

extern const WorldEntry minatar_asterix_world;
const WorldEntry minatar_asterix_world{
    "minatar-asterix",
    "MinAtar/Asterix-v0 MinAtar/Asterix-v1:minimal=true",
    "MinAtar: collect gold and avoid enemies that cross the screen",
    "Young and Tian 2019, arXiv 1903.03176; MinAtar 1.0.15",
    [](const Parameters& given) { return minatar::make<Asterix>("minatar-asterix", given); },
    parameters_of<minatar::SettingsOf<Asterix>>};

}  // namespace quoll
