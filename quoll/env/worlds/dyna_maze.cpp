// The mazes of Sutton, Barto 2018, "Reinforcement Learning", chapter 8, 6 rows and 9 columns,
// reward 1 on entering the goal and else 0, discount 0.95:
//   dyna      figure 8.2; the shortest path has 14 moves
//   blocking  figure 8.4; the wall's gap is on the right before (10 moves), on the left after (16)
//   shortcut  figure 8.5; a gap on the left before (16 moves), and one more on the right after (10)
// In the book the last two change while an agent learns; here each stage is a world of its own.
// State: its name, "r<row>c<column>" from the top left. No draws.

#include <utility>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/model/grid.hpp"

namespace quoll {
namespace {

enum class Map : std::uint8_t { dyna, blocking, shortcut };
constexpr std::string_view map_names[] = {"dyna", "blocking", "shortcut"};
enum class Stage : std::uint8_t { before, after };
constexpr std::string_view stage_names[] = {"before", "after"};

struct Settings {
  Map map = Map::dyna;
  Stage stage = Stage::before;

  void describe(Describer& d) {
    d.choice("map", map, map_names, "which of the book's mazes");
    d.choice("stage", stage, stage_names, "blocking and shortcut: before or after the change");
  }
  std::string_view needs(std::string_view name) const {
    return name == "stage" && map == Map::dyna ? "map=blocking or map=shortcut" : "";
  }
};

std::vector<std::string> picture_of(const Settings& settings) {
  if (settings.map == Map::dyna) {
    return {".......#G", "..#....#.", "S.#....#.", "..#......", ".....#...", "........."};
  }
  const bool blocking = settings.map == Map::blocking;
  const bool before = settings.stage == Stage::before;
  const char* const wall =
      blocking ? (before ? "########." : ".########") : (before ? ".########" : ".#######.");
  return {"........G", ".........", ".........", wall, ".........", "...S....."};
}

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("dyna-maze", given);
  if (!settings) return settings.error();
  Grid grid;
  grid.rows = picture_of(*settings);
  grid.move_reward = 0.0;
  grid.discount = 0.95;
  grid.reward['G'] = 1.0;
  Result<Mdp> mdp = to_mdp(grid);
  if (!mdp) return mdp.error();
  std::vector<std::uint32_t> cells = mdp->layout()->cell;
  return to_world("dyna-maze", std::move(*mdp), grid_looks(grid.rows, std::move(cells)));
}

}  // namespace

extern const WorldEntry dyna_maze_world;
const WorldEntry dyna_maze_world{"dyna-maze",
                                 "blocking-maze:map=blocking shortcut-maze:map=shortcut",
                                 "the mazes of the Dyna chapter, before and after their change",
                                 "Sutton, Barto 2018, figures 8.2, 8.4 and 8.5",
                                 make,
                                 parameters_of<Settings>};

}  // namespace quoll
