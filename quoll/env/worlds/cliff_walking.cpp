// The cliff: walk along its edge from one end to the other.
//
// 4 rows of 12 cells, start bottom left, goal bottom right, the cliff between them. Actions up 0,
// right 1, down 2, left 3; a move off the grid stays. Each move earns -1, also the last; a step off
// the edge earns -100 and leads back to the start without ending the episode. With slippery=true a
// move goes where it should or to either side of it with probability 1/3 each; its outcomes stand
// in the order (a - 1), a, (a + 1) modulo 4. States are the cells in reading order; those of the
// cliff are never entered. No step limit.
// Source: Sutton and Barto 2018, example 6.6; Gymnasium, CliffWalking-v1.
// Draws: one uniform number a start and one a step. State for people: the cell's name, "r3c0".

#include <utility>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/env/worlds/table_writer.hpp"

#include "quoll/env/world.hpp"

namespace quoll {
namespace {

struct CliffSettings {
  bool slippery = false;
  Seeding seeding = Seeding::quoll;

  void describe(Describer& describe) {
    describe("slippery", slippery, "whether a move may slip to a side");
    describe.choice("seeding", seeding, seeding_names, "whose random numbers a seed gives");
  }
};

constexpr State columns = 12, rows = 4, start = 36, goal = 47;

State moved(State s, Action way) {
  const State row = s / columns, column = s % columns;
  if (way == 0) return row > 0 ? s - columns : s;
  if (way == 1) return column + 1 < columns ? s + 1 : s;
  if (way == 2) return row + 1 < rows ? s + columns : s;
  return column > 0 ? s - 1 : s;
}

void add_outcome(TableWriter& table, State s, Action way, double probability) {
  const State next = moved(s, way);
  const bool falls = next > start && next < goal;
  table.outcome(probability, falls ? start : next, falls ? -100.0 : -1.0);
}

Result<Mdp> cliff_model(bool slippery) {
  TableWriter table(0.99);
  for (State s = 0; s < rows * columns; ++s) {
    table.state();
    if (s == goal) continue;
    for (Action a = 0; a < 4; ++a) {
      table.choice(a);
      if (!slippery) {
        add_outcome(table, s, a, 1.0);
        continue;
      }
      for (const Action turn : {3u, 0u, 1u}) add_outcome(table, s, (a + turn) % 4, 1.0 / 3.0);
    }
  }
  table.start(start);
  for (const std::string_view name : {"up", "right", "down", "left"}) {
    table.arrays().action_names.push_back(name);
  }
  Layout layout = grid_layout(rows, columns, {{0, -1}, {1, 0}, {0, 1}, {-1, 0}});
  table.arrays().state_names = Names::cells(columns, layout.cell);
  table.arrays().layout = std::move(layout);
  return table.finish();
}

Result<World> make(const Parameters& parameters) {
  const Result<CliffSettings> settings =
      read_parameters<CliffSettings>("cliff-walking", parameters);
  if (!settings) return settings.error();
  Result<Mdp> mdp = cliff_model(settings->slippery);
  if (!mdp) return mdp.error();
  Looks looks = grid_looks({"............", "............", "............", "SCCCCCCCCCCG"},
                           mdp->layout()->cell);
  return to_world("cliff-walking", std::move(*mdp), std::move(looks), 0, settings->seeding);
}

}  // namespace

extern const WorldEntry cliff_walking_world;
const WorldEntry cliff_walking_world{
    "cliff-walking",
    "CliffWalking-v0 CliffWalking-v1 CliffWalkingSlippery-v1:slippery=true",
    "walk along a cliff; a step off the edge costs 100 and begins anew",
    "Sutton and Barto 2018, example 6.6; Gymnasium, CliffWalking-v1",
    make,
    parameters_of<CliffSettings>};

}  // namespace quoll
