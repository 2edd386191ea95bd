// MinAtar's Space Invaders: shoot the aliens before they land. What all five games share stands in
// minatar.hpp.
//
// Channels: cannon, alien, alien_left, alien_right (the aliens again, in the channel of their
// direction), friendly_bullet, enemy_bullet. Minimal actions: stay, left, right, fire. Reward 1 for
// an alien; the end is a bullet or an alien at the cannon, or aliens that turn with one on row 9.
//
// One step, in this order:
//   fire with shot_timer 0: a bullet at the cannon, shot_timer becomes 5. left, right: the cannon
//     moves along row 9, within the grid.
//   The cannon's bullets rise by one row, the aliens' bullets fall by one; one of these at the
//     cannon, or an alien there, is the end.
//   alien_move_timer is 0: it becomes the smaller of the number of aliens and alien_interval. With
//     an alien on the edge they face the aliens turn and come down one row (with one on row 9
//     before, the end: and it comes back in row 0), else they move sideways. An alien at the
//     cannon: the end.
//   alien_shot_timer is 0: it becomes 10, and the lowest alien of the column nearest to the cannon,
//     of two the left one, puts a bullet where it is.
//   Every cell with an alien and a bullet of the cannon: reward 1, and both are gone.
//   shot_timer falls by 1 unless 0, both alien timers fall by 1.
//   No alien is left: alien_interval falls by 1 when above 6 and ramp_index rises (only with
//     ramping), and a new field of 4 x 6 aliens comes, moving on as the last one did.
//
// Draws: none besides the sticky one.
//
// State: x of the cannon; aliens, bullets, alien_bullets; alien_direction left | right;
// alien_interval, alien_move_timer, alien_shot_timer, shot_timer, ramp_index.

#include "quoll/env/worlds/minatar.hpp"

namespace quoll {
namespace {

using namespace minatar;

struct SpaceInvaders {
  static constexpr Channel channels[] = {{"cannon", 'A', Ink::agent},
                                         {"alien", 0, Ink::danger},
                                         {"alien moving left", '<', Ink::danger},
                                         {"alien moving right", '>', Ink::danger},
                                         {"bullet", '|', Ink::goal},
                                         {"alien bullet", '!', Ink::other}};
  static constexpr Move minimal[] = {stay, left, right, fire};
  static constexpr std::optional<std::pair<double, double>> reward_bounds{};
  static constexpr bool ramps = true;

  enum class Direction : std::uint8_t { left, right };
  static constexpr std::string_view direction_names[] = {"left", "right"};
  static constexpr std::uint64_t four_rows = Board::column & ~(std::uint64_t{1} << 40);
  static constexpr Board field{{four_rows * 0x0fc, 0}};  // columns 2 to 7

  struct Position : Common {
    std::int8_t x = 5;
    Board aliens = field, bullets, alien_bullets;
    Direction direction = Direction::left;
    std::int8_t alien_interval = 12, alien_move_timer = 12, alien_shot_timer = 10, shot_timer = 0;
    std::uint32_t ramp_index = 0;

    template <class Archive>
    void persist(Archive& archive) {
      persist_within(archive, "x", x, 0, 9);
      persist_board(archive, "aliens", aliens);
      persist_board(archive, "bullets", bullets);
      persist_board(archive, "alien_bullets", alien_bullets);
      persist_word(archive, "alien_direction", direction, direction_names);
      persist_within(archive, "alien_interval", alien_interval, 6, 12);
      persist_within(archive, "alien_move_timer", alien_move_timer, 0, 12);
      persist_within(archive, "alien_shot_timer", alien_shot_timer, 0, 10);
      persist_within(archive, "shot_timer", shot_timer, 0, 5);
      archive("ramp_index", ramp_index);
      persist_common(archive);
      if (!archive.saving() && !aliens.any()) archive.fail("aliens: at least one expected");
    }
  };

  static Position start(auto&) { return {}; }

  // The end when the aliens turn with one on row 9.
  static void move_aliens(Position& at) {
    const bool rightwards = at.direction == Direction::right;
    at.alien_move_timer =
        static_cast<std::int8_t>(std::min<int>(at.aliens.count(), at.alien_interval));
    if (!at.aliens.any_in_column(rightwards ? 9 : 0)) {
      at.aliens = at.aliens.moved(rightwards);
      return;
    }
    at.direction = rightwards ? Direction::left : Direction::right;
    const std::uint64_t landed = at.aliens.of_row(9);
    at.over |= landed != 0;
    at.aliens = at.aliens.lowered();
    at.aliens.half[0] |= landed;
  }

  static void shoot(Position& at) {
    const std::uint64_t columns = at.aliens.columns();
    const std::uint64_t up_to = columns & ((std::uint64_t{2} << at.x) - 1);
    const std::uint64_t beyond = columns ^ up_to;
    const int nearest_left = std::bit_width(up_to) - 1;
    const int nearest_right = std::countr_zero(beyond);
    const bool take_left =
        up_to != 0 && (beyond == 0 || at.x - nearest_left <= nearest_right - at.x);
    const int column = take_left ? nearest_left : nearest_right;
    int y = 9;
    while (!at.aliens.has(column, y)) --y;
    at.alien_bullets.add(column, y);
  }

  static double act(Position& at, Move move, bool ramping, auto&) {
    if (move == fire && at.shot_timer == 0) {
      at.bullets.add(at.x, 9);
      at.shot_timer = 5;
    }
    at.x = static_cast<std::int8_t>(std::clamp(at.x + move_x[move], 0, 9));
    at.bullets = at.bullets.raised();
    at.alien_bullets = at.alien_bullets.lowered();
    at.over |= at.alien_bullets.has(at.x, 9) || at.aliens.has(at.x, 9);
    if (at.alien_move_timer == 0) {
      move_aliens(at);
      at.over |= at.aliens.has(at.x, 9);
    }
    if (at.alien_shot_timer == 0) {
      at.alien_shot_timer = 10;
      shoot(at);
    }
    double reward = 0.0;
    if (const Board hits = at.aliens & at.bullets; hits.any()) {
      reward = hits.count();
      at.aliens = at.aliens.without(hits);
      at.bullets = at.bullets.without(hits);
    }
    at.shot_timer = static_cast<std::int8_t>(at.shot_timer - (at.shot_timer > 0));
    --at.alien_move_timer;
    --at.alien_shot_timer;
    if (!at.aliens.any()) {
      if (ramping && at.alien_interval > 6) {
        --at.alien_interval;
        ++at.ramp_index;
      }
      at.aliens = field;
    }
    return reward;
  }

  static void show(const Position& at, Flags<6> flags) {
    flags.set(0, at.x, 9);
    flags.set(1, at.aliens);
    flags.set(at.direction == Direction::left ? 2 : 3, at.aliens);
    flags.set(4, at.bullets);
    flags.set(5, at.alien_bullets);
  }
};

}  // namespace

extern const WorldEntry minatar_space_invaders_world;
const WorldEntry minatar_space_invaders_world{
    "minatar-space-invaders",
    "MinAtar/SpaceInvaders-v0 MinAtar/SpaceInvaders-v1:minimal=true",
    "MinAtar: shoot the aliens before they land",
    "Young and Tian 2019, arXiv 1903.03176; MinAtar 1.0.15",
    [](const Parameters& given) {
      return minatar::make<SpaceInvaders>("minatar-space-invaders", given);
    },
    parameters_of<minatar::SettingsOf<SpaceInvaders>>};

}  // namespace quoll
