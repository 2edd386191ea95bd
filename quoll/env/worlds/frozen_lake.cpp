// The frozen lake: cross the ice to the goal without falling into a hole.
//
// Actions left 0, down 1, right 2, up 3; a move off the map stays. On slippery ice a move goes
// where it should with probability success_rate, else to either side of it with equal probability;
// its outcomes stand in the order (a - 1), a, (a + 1) modulo 4. Reward by the cell entered: 1 at
// the goal, 0 in a hole and on ice; goal and hole end the episode. States are the cells in reading
// order. Step limit 100 on the 4x4 map, 200 on the 8x8 map; in the same proportion to rows +
// columns on others, but at least 100.
// Source: Gymnasium, FrozenLake-v1, whose random maps generated_lake() repeats.
// Draws: one uniform number a start and one a step. State for people: the cell's name, "r2c3".

#include <algorithm>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/env/worlds/lake_map.hpp"
#include "quoll/env/worlds/pictures.hpp"
#include "quoll/env/worlds/table_writer.hpp"

#include "quoll/env/world.hpp"

namespace quoll {
namespace {

struct LakeSettings {
  std::string map = "4x4";
  bool slippery = true;
  double success_rate = 1.0 / 3.0;
  double goal_reward = 1.0, hole_reward = 0.0, frozen_reward = 0.0;
  std::uint64_t size = 8;
  double p = 0.8;
  std::uint64_t seed = 1;
  Seeding seeding = Seeding::quoll;

  void describe(Describer& describe) {
    describe("map", map, "4x4, 8x8, generated, or a file with a line of letters S F H G per row.");
    describe("slippery", slippery, "whether a move may slip to a side");
    describe("success_rate", success_rate, 0.0, 1.0, "probability that a move does not slip");
    describe("goal_reward", goal_reward, -1e9, 1e9, "reward for reaching the goal");
    describe("hole_reward", hole_reward, -1e9, 1e9, "reward for falling into a hole");
    describe("frozen_reward", frozen_reward, -1e9, 1e9, "reward for every other step");
    describe("size", size, 2, 1000, "rows and columns of a generated map");
    describe("p", p, 0.0, 1.0, "probability that a cell of a generated map is frozen");
    describe("seed", seed, "seed of a generated map");
    describe.choice("seeding", seeding, seeding_names, "whose random numbers a seed gives");
  }
  std::string_view needs(std::string_view name) const {
    if (name == "success_rate" && !slippery) return "slippery=true";
    const bool of_generated = name == "size" || name == "p" || name == "seed";
    return of_generated && map != "generated" ? "map=generated" : "";
  }
};

Result<LakeMap> map_of(const LakeSettings& settings) {
  if (settings.map == "4x4") return LakeMap{"SFFF", "FHFH", "FFFH", "HFFG"};
  if (settings.map == "8x8") {
    return LakeMap{"SFFFFFFF", "FFFFFFFF", "FFFHFFFF", "FFFFFHFF",
                   "FFFHFFFF", "FHHFFFHF", "FHFFHFHF", "FFFHFFFG"};
  }
  if (settings.map == "generated") {
    return generated_lake(settings.size, settings.p, settings.seed);
  }
  if (settings.map.find_first_of("/.") != std::string::npos) return read_lake(settings.map);
  constexpr std::string_view words[] = {"4x4", "8x8", "generated"};
  return Error{"--with map", 0, 0,
               "4x4, 8x8, generated or a file expected, not '" + settings.map + "'",
               nearest(settings.map, words)};
}

class Lake {
 public:
  Lake(const LakeSettings& settings, const LakeMap& map)
      : settings_(settings),
        map_(map),
        rows_(static_cast<State>(map.size())),
        columns_(static_cast<State>(map[0].size())) {}

  Result<Mdp> model() const {
    TableWriter table(0.99);
    for (State s = 0; s < rows_ * columns_; ++s) {
      table.state();
      if (letter(s) == 'S') table.start(s);
      if (is_end(s)) continue;
      for (Action a = 0; a < 4; ++a) {
        table.choice(a);
        add_outcomes(table, s, a);
      }
    }
    for (const std::string_view name : {"left", "down", "right", "up"}) {
      table.arrays().action_names.push_back(name);
    }
    Layout layout = grid_layout(rows_, columns_, {{-1, 0}, {0, 1}, {1, 0}, {0, -1}});
    table.arrays().state_names = Names::cells(columns_, layout.cell);
    table.arrays().layout = std::move(layout);
    return table.finish();
  }

 private:
  char letter(State s) const { return map_[s / columns_][s % columns_]; }
  bool is_end(State s) const { return letter(s) == 'G' || letter(s) == 'H'; }

  void add_outcomes(TableWriter& table, State s, Action a) const {
    const auto add = [&](Action way, double probability) {
      const State next = moved(s, way);
      const double reward = letter(next) == 'G'   ? settings_.goal_reward
                            : letter(next) == 'H' ? settings_.hole_reward
                                                  : settings_.frozen_reward;
      table.outcome(probability, next, reward);
    };
    if (!settings_.slippery) return add(a, 1.0);
    const double side = (1.0 - settings_.success_rate) / 2.0;
    add((a + 3) % 4, side);
    add(a, settings_.success_rate);
    add((a + 1) % 4, side);
  }
  State moved(State s, Action way) const {
    const State row = s / columns_, column = s % columns_;
    if (way == 0) return column > 0 ? s - 1 : s;
    if (way == 1) return row + 1 < rows_ ? s + columns_ : s;
    if (way == 2) return column + 1 < columns_ ? s + 1 : s;
    return row > 0 ? s - columns_ : s;
  }

  const LakeSettings& settings_;
  const LakeMap& map_;
  State rows_, columns_;
};

Result<World> make(const Parameters& parameters) {
  const Result<LakeSettings> settings = read_parameters<LakeSettings>("frozen-lake", parameters);
  if (!settings) return settings.error();
  Result<LakeMap> map = map_of(*settings);
  if (!map) return map.error();
  Result<Mdp> mdp = Lake(*settings, *map).model();
  if (!mdp) return mdp.error();
  const std::uint64_t limit =
      std::max<std::uint64_t>(100, 25 * (map->size() + map->front().size()) / 2);
  for (std::string& row : *map) std::replace(row.begin(), row.end(), 'F', '.');
  Looks looks = grid_looks(std::move(*map), mdp->layout()->cell);
  return to_world("frozen-lake", std::move(*mdp), std::move(looks), limit, settings->seeding);
}

}  // namespace

extern const WorldEntry frozen_lake_world;
const WorldEntry frozen_lake_world{"frozen-lake",
                                   "FrozenLake-v1 FrozenLake8x8-v1:map=8x8",
                                   "cross slippery ice to the goal without falling into a hole",
                                   "Gymnasium, FrozenLake-v1",
                                   make,
                                   parameters_of<LakeSettings>};

}  // namespace quoll
