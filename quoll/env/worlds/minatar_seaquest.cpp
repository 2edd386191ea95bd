// MinAtar's Seaquest: shoot fish and submarines, bring divers to the surface before the oxygen is
// used up. What all five games share stands in minatar.hpp.
//
// Channels: sub_front, sub_back, friendly_bullet, trail, enemy_bullet, enemy_fish, enemy_sub,
// oxygen_gauge, diver_gauge (both on row 9), diver; the trail is the cell behind a fish, an enemy
// submarine or a diver. All six actions have a use. Reward 1 for a fish or submarine shot, and
// floor(oxygen / 20) for surfacing with six divers. The end is the touch of an enemy or its bullet,
// no oxygen, or surfacing without a diver.
//
// One step, in this order ("off": out of the grid and gone):
//   spawn_timer is 0: an enemy at the left edge going right or at the right edge going left, but
//     none when an enemy of that row goes the other way; the timer becomes spawn_speed.
//     diver_spawn_timer is 0: a diver in the same manner; the timer becomes 30.
//   fire with shot_timer 0: a bullet at the player in its direction, shot_timer becomes 5. left,
//     right: move within the grid and face that way. up, down: move within rows 0-8.
//   The player's bullets move: off, or hit a fish, or else a submarine: both are gone, reward 1.
//   Divers: at the player with fewer than six aboard one is taken; else a timer of 0 becomes 5 and
//     the diver moves (off, or taken in the same way); else its timer falls by 1.
//   Enemy submarines: at the player the end. A timer of 0 becomes move_speed and it moves: off, or
//     at the player the end, or into a bullet of the player: both are gone, reward 1; any other
//     timer falls by 1. Then a shot_timer of 0 becomes 10 and it fires a bullet where it is, even
//     if it has just been hit; any other falls by 1.
//   Enemy bullets: at the player the end; they move; off, or at the player the end.
//   Fish: as submarines, without bullets.
//   The three timers of the player's side fall by 1 unless 0. oxygen at 0: the end. Below row 0:
//     oxygen falls by 1 and surfaced is false. On row 0 when not surfaced: no diver is the end;
//     else surfaced is true, six divers give their reward and become none, oxygen becomes 200, and
//     divers falls by 1: so six leave -1, with which the next surfacing is no end. Then the ramp,
//     while spawn_speed is above 1 or move_speed above 2: move_speed falls by 1 (when above 2, and
//     ramp_index is odd), spawn_speed by 1 (when above 1), ramp_index rises.
// Lists are walked from the back, and what is to be removed is the first entry equal to it: when
// that is another one, the one meant stays and is taken twice.
//
// Draws of a step after the sticky one: for an enemy uniform < 1/2 from the left, uniform < 1/3 a
// submarine, below(8) its row minus 1; for a diver uniform < 1/2 from the left, below(8) its row
// minus 1. A start draws nothing.
//
// State: x, y, right (the player's direction), oxygen, divers_aboard, surfaced; bullets {x, y,
// right}, enemy_bullets; fish and divers {x, y, right, timer}, submarines {..., shot_timer};
// spawn_timer, spawn_speed, diver_spawn_timer, shot_timer, move_speed, ramp_index. A list holds at
// most 32 entries, of the player's bullets and the divers 8; play reaches 30 enemies, 3 bullets and
// 3 divers. Nothing appears where a list is full.

#include "quoll/env/worlds/minatar.hpp"

namespace quoll {
namespace {

using namespace minatar;

// Up to `capacity` things in the order of their arrival.
template <class Thing, std::size_t capacity>
struct List {
  std::array<Thing, capacity> things{};
  std::uint8_t size = 0;

  Thing& operator[](int i) { return things[static_cast<std::size_t>(i)]; }
  const Thing* begin() const { return things.data(); }
  const Thing* end() const { return things.data() + size; }

  void add(const Thing& thing) {
    if (size < capacity) things[size++] = thing;
  }
  void erase(int i) {
    std::copy(begin() + i + 1, end(), things.begin() + i);
    things[--size] = {};
  }
  /// Removes the first entry equal to the i-th; where the i-th now stands, -1 when it is gone.
  int drop(int i) {
    const int first = static_cast<int>(std::find(begin(), end(), things[i]) - begin());
    erase(first);
    return first == i ? -1 : i - 1;
  }
  /// The first entry at a cell, or -1.
  int at(int x, int y) const {
    for (int i = 0; i < size; ++i) {
      if (things[i].x == x && things[i].y == y) return i;
    }
    return -1;
  }
};

template <class Thing, std::size_t capacity>
void persist_list(auto& archive, std::string_view name, List<Thing, capacity>& list) {
  std::vector<Thing> things(list.begin(), list.end());
  archive(name, things);
  if (archive.saving()) return;
  if (things.size() > capacity) {
    archive.fail(std::string(name) + ": at most " + std::to_string(capacity) + " entries expected");
    return;
  }
  list = {};
  for (const Thing& thing : things) list.add(thing);
}

struct Bullet {
  std::int8_t x = 0, y = 0;
  bool rightwards = false;

  void move() { x = static_cast<std::int8_t>(x + (rightwards ? 1 : -1)); }
  bool operator==(const Bullet&) const = default;
  template <class Archive>
  void persist(Archive& archive) {
    persist_within(archive, "x", x, 0, 9);
    persist_within(archive, "y", y, 0, 8);
    archive("right", rightwards);
  }
};

// Fish and divers.
struct Swimmer : Bullet {
  std::int8_t timer = 0;

  bool operator==(const Swimmer&) const = default;
  template <class Archive>
  void persist(Archive& archive) {
    Bullet::persist(archive);
    persist_within(archive, "timer", timer, 0, 5);
  }
};

struct Submarine : Swimmer {
  std::int8_t shot_timer = 0;

  bool operator==(const Submarine&) const = default;
  template <class Archive>
  void persist(Archive& archive) {
    Swimmer::persist(archive);
    persist_within(archive, "shot_timer", shot_timer, 0, 10);
  }
};

struct Seaquest {
  static constexpr Channel channels[] = {
      {"front", 'S', Ink::agent},         {"back", 's', Ink::agent},
      {"bullet", '*', Ink::goal},         {"trail", '-', Ink::faint},
      {"enemy bullet", '!', Ink::danger}, {"fish", 'F', Ink::danger},
      {"submarine", 'U', Ink::danger},    {"oxygen", 'o', Ink::other},
      {"aboard", 'd', Ink::reward},       {"diver", 'D', Ink::reward}};
  static constexpr Move minimal[] = {stay, left, up, right, down, fire};
  static constexpr std::optional<std::pair<double, double>> reward_bounds{};
  static constexpr bool ramps = true;
  static constexpr int full_oxygen = 200;

  struct Position : Common {
    std::int8_t x = 5, y = 0;
    bool rightwards = false, surfaced = true;
    std::int16_t oxygen = full_oxygen;
    std::int32_t aboard = 0;
    List<Bullet, 8> bullets;
    List<Bullet, 32> enemy_bullets;
    List<Swimmer, 32> fish;
    List<Submarine, 32> submarines;
    List<Swimmer, 8> divers;
    std::int8_t spawn_timer = 20, spawn_speed = 20, diver_spawn_timer = 30, shot_timer = 0;
    std::int8_t move_speed = 5;
    std::uint32_t ramp_index = 0;

    template <class Archive>
    void persist(Archive& archive) {
      persist_within(archive, "x", x, 0, 9);
      persist_within(archive, "y", y, 0, 8);
      archive("right", rightwards);
      persist_within(archive, "oxygen", oxygen, -1, full_oxygen);
      persist_within(archive, "divers_aboard", aboard, -1'000'000'000, 6);
      archive("surfaced", surfaced);
      persist_list(archive, "bullets", bullets);
      persist_list(archive, "enemy_bullets", enemy_bullets);
      persist_list(archive, "fish", fish);
      persist_list(archive, "submarines", submarines);
      persist_list(archive, "divers", divers);
      persist_within(archive, "spawn_timer", spawn_timer, 0, 20);
      persist_within(archive, "spawn_speed", spawn_speed, 1, 20);
      persist_within(archive, "diver_spawn_timer", diver_spawn_timer, 0, 30);
      persist_within(archive, "shot_timer", shot_timer, 0, 5);
      persist_within(archive, "move_speed", move_speed, 2, 5);
      archive("ramp_index", ramp_index);
      persist_common(archive);
      if (archive.saving()) return;
      if (x == (rightwards ? 0 : 9)) archive.fail("x: the submarine's back is out of the grid");
      if (oxygen < 0 && !over) archive.fail("oxygen: below 0, and the state is not over");
    }

    bool meets(const Bullet& thing) const { return thing.x == x && thing.y == y; }
  };

  static Position start(auto&) { return {}; }

  static void spawn_enemy(Position& at, auto& dice) {
    const bool rightwards = chance(dice, 1.0 / 2.0);
    const bool submarine = chance(dice, 1.0 / 3.0);
    const auto y = static_cast<std::int8_t>(1 + dice.below(8));
    const auto against = [&](const Bullet& z) { return z.y == y && z.rightwards != rightwards; };
    if (std::any_of(at.submarines.begin(), at.submarines.end(), against) ||
        std::any_of(at.fish.begin(), at.fish.end(), against)) {
      return;
    }
    const Bullet place{static_cast<std::int8_t>(rightwards ? 0 : 9), y, rightwards};
    if (submarine) {
      at.submarines.add({{place, at.move_speed}, 10});
    } else {
      at.fish.add({place, at.move_speed});
    }
  }

  static void spawn_diver(Position& at, auto& dice) {
    const bool rightwards = chance(dice, 1.0 / 2.0);
    const auto y = static_cast<std::int8_t>(1 + dice.below(8));
    at.divers.add({{static_cast<std::int8_t>(rightwards ? 0 : 9), y, rightwards}, 5});
  }

  static void steer(Position& at, Move move) {
    if (move == fire && at.shot_timer == 0) {
      at.bullets.add({at.x, at.y, at.rightwards});
      at.shot_timer = 5;
    }
    at.x = static_cast<std::int8_t>(std::clamp(at.x + move_x[move], 0, 9));
    at.y = static_cast<std::int8_t>(std::clamp(at.y + move_y[move], 0, 8));
    at.rightwards = move == right || (at.rightwards && move != left);
  }

  static double move_bullets(Position& at) {
    double reward = 0.0;
    for (int i = at.bullets.size - 1; i >= 0; --i) {
      Bullet& bullet = at.bullets[i];
      bullet.move();
      if (outside(bullet.x)) {
        at.bullets.drop(i);
      } else if (const int fish = at.fish.at(bullet.x, bullet.y); fish >= 0) {
        at.fish.erase(fish);
        at.bullets.drop(i);
        reward += 1.0;
      } else if (const int hit = at.submarines.at(bullet.x, bullet.y); hit >= 0) {
        at.submarines.erase(hit);
        at.bullets.drop(i);
        reward += 1.0;
      }
    }
    return reward;
  }

  static void move_divers(Position& at) {
    for (int i = at.divers.size - 1; i >= 0; --i) {
      Swimmer& diver = at.divers[i];
      bool taken = at.meets(diver) && at.aboard < 6;
      if (!taken && diver.timer > 0) {
        --diver.timer;
        continue;
      }
      if (!taken) {
        diver.timer = 5;
        diver.move();
        taken = at.meets(diver) && at.aboard < 6;
      }
      if (taken || outside(diver.x)) at.divers.drop(i);
      at.aboard += taken;
    }
  }

  // Moves the i-th of the enemies. Returns where it now stands in the list, -1 when it is gone.
  static int swim(Position& at, auto& enemies, int i, double& reward) {
    auto& enemy = enemies[i];
    at.over |= at.meets(enemy);
    if (enemy.timer > 0) {
      --enemy.timer;
      return i;
    }
    enemy.timer = at.move_speed;
    enemy.move();
    if (outside(enemy.x)) return enemies.drop(i);
    if (at.meets(enemy)) {
      at.over = true;
      return i;
    }
    const int bullet = at.bullets.at(enemy.x, enemy.y);
    if (bullet < 0) return i;
    at.bullets.erase(bullet);
    reward += 1.0;
    return enemies.drop(i);
  }

  static double move_submarines(Position& at) {
    double reward = 0.0;
    for (int i = at.submarines.size - 1; i >= 0; --i) {
      Bullet shot = at.submarines[i];
      if (at.submarines[i].timer == 0) shot.move();
      const bool fires = at.submarines[i].shot_timer == 0;
      const int now = swim(at, at.submarines, i, reward);
      if (fires && !outside(shot.x)) at.enemy_bullets.add(shot);  // from outside it never enters
      if (now < 0) continue;
      std::int8_t& timer = at.submarines[now].shot_timer;
      timer = static_cast<std::int8_t>(fires ? 10 : timer - 1);
    }
    return reward;
  }

  static void move_enemy_bullets(Position& at) {
    for (int i = at.enemy_bullets.size - 1; i >= 0; --i) {
      Bullet& bullet = at.enemy_bullets[i];
      at.over |= at.meets(bullet);
      bullet.move();
      at.over |= at.meets(bullet);
      if (outside(bullet.x)) at.enemy_bullets.drop(i);
    }
  }

  static double surface(Position& at, bool ramping) {
    int reward = 0;
    at.surfaced = true;
    if (at.aboard == 6) {
      at.aboard = 0;
      reward = at.oxygen * 10 / full_oxygen;
    }
    at.oxygen = full_oxygen;
    --at.aboard;
    if (ramping && (at.spawn_speed > 1 || at.move_speed > 2)) {
      if (at.move_speed > 2 && at.ramp_index % 2 == 1) --at.move_speed;
      if (at.spawn_speed > 1) --at.spawn_speed;
      ++at.ramp_index;
    }
    return reward;
  }

  static double act(Position& at, Move move, bool ramping, auto& dice) {
    if (at.spawn_timer == 0) {
      spawn_enemy(at, dice);
      at.spawn_timer = at.spawn_speed;
    }
    if (at.diver_spawn_timer == 0) {
      spawn_diver(at, dice);
      at.diver_spawn_timer = 30;
    }
    steer(at, move);
    double reward = move_bullets(at);
    move_divers(at);
    reward += move_submarines(at);
    move_enemy_bullets(at);
    for (int i = at.fish.size - 1; i >= 0; --i) swim(at, at.fish, i, reward);

    for (std::int8_t* timer : {&at.spawn_timer, &at.diver_spawn_timer, &at.shot_timer}) {
      *timer = static_cast<std::int8_t>(*timer - (*timer > 0));
    }
    if (at.oxygen <= 0) at.over = true;
    if (at.y > 0) {
      --at.oxygen;
      at.surfaced = false;
    } else if (!at.surfaced && at.aboard == 0) {
      at.over = true;
    } else if (!at.surfaced) {
      reward += surface(at, ramping);
    }
    return reward;
  }

  static void show(const Position& at, Flags<10> flags) {
    const auto trail = [&](const Bullet& thing) {
      const int behind = thing.x + (thing.rightwards ? -1 : 1);
      if (!outside(behind)) flags.set(3, behind, thing.y);
    };
    flags.set(0, at.x, at.y);
    flags.set(1, at.x + (at.rightwards ? -1 : 1), at.y);
    for (int x = 0; x < at.oxygen * 10 / full_oxygen; ++x) flags.set(7, x, 9);
    for (int x = 9 - at.aboard; x < 9; ++x) flags.set(8, x, 9);
    for (const Bullet& bullet : at.bullets) flags.set(2, bullet.x, bullet.y);
    for (const Bullet& bullet : at.enemy_bullets) flags.set(4, bullet.x, bullet.y);
    for (const Swimmer& fish : at.fish) flags.set(5, fish.x, fish.y), trail(fish);
    for (const Submarine& one : at.submarines) flags.set(6, one.x, one.y), trail(one);
    for (const Swimmer& diver : at.divers) flags.set(9, diver.x, diver.y), trail(diver);
  }
};

}  // namespace

extern const WorldEntry minatar_seaquest_world;
const WorldEntry minatar_seaquest_world{
    "minatar-seaquest",
    "MinAtar/Seaquest-v0 MinAtar/Seaquest-v1:minimal=true",
    "MinAtar: shoot fish and submarines, bring divers to the surface",
    "Young and Tian 2019, arXiv 1903.03176; MinAtar 1.0.15",
    [](const Parameters& given) { return minatar::make<Seaquest>("minatar-seaquest", given); },
    parameters_of<minatar::SettingsOf<Seaquest>>};

}  // namespace quoll
