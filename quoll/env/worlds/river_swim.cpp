// River swim: states in a row, a current to the left. Left always goes one state left and earns a
// little in the first state; right is a swim against the current that earns much in the last one.
// No ends, discount 0.95.
//   variant=strehl  right: first 0.7 stay, 0.3 forward; middle 0.1 back, 0.6 stay, 0.3 forward;
//   last
//                   0.7 back, 0.3 stay. Rewards 5, and 10000 when the last state's right stays.
//                   Starts in the second or third state. Strehl, Littman 2008, "An analysis of
//                   model-based interval estimation for Markov decision processes", section 5.
//   variant=osband  right: first 0.4 stay, 0.6 forward; middle 0.05 back, 0.6 stay, 0.35 forward;
//                   last 0.4 back, 0.6 stay. Rewards 0.005, and 1 for the last state's right.
//                   Starts in the first. Osband, Russo, Van Roy 2013, "(More) efficient
//                   reinforcement learning via posterior sampling", figure 2.
// State: its name, "s0" to "s5". One draw a step, and one a start of strehl.

#include <algorithm>
#include <utility>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

enum class Variant : std::uint8_t { strehl, osband };
constexpr std::string_view variant_names[] = {"strehl", "osband"};

struct Settings {
  std::uint64_t states = 6;
  Variant variant = Variant::strehl;

  void describe(Describer& d) {
    d("states", states, 3, 1'000'000, "states from bank to bank");
    d.choice("variant", variant, variant_names, "whose probabilities and rewards");
  }
};

struct Current {
  double first_forward, back, stay, forward, last_stay;
  double little, much;
  bool only_staying_pays;
};
constexpr Current currents[] = {{0.3, 0.1, 0.6, 0.3, 0.3, 5.0, 10000.0, true},
                                {0.6, 0.05, 0.6, 0.35, 0.6, 0.005, 1.0, false}};

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("river-swim", given);
  if (!settings) return settings.error();
  const auto states = static_cast<State>(settings->states);
  const Current& current = currents[static_cast<std::size_t>(settings->variant)];
  MdpBuilder builder(0.95);
  for (State s = 0; s < states; ++s) builder.state("s" + std::to_string(s));
  const std::uint32_t left = builder.action("left");
  const std::uint32_t right = builder.action("right");
  for (State s = 0; s < states; ++s) {
    builder.move(s, left, s == 0 ? 0 : s - 1, s == 0 ? current.little : 0.0, 1.0);
    if (s == 0) {
      builder.move(s, right, s, 0.0, 1.0 - current.first_forward);
      builder.move(s, right, s + 1, 0.0, current.first_forward);
    } else if (s + 1 < states) {
      builder.move(s, right, s - 1, 0.0, current.back);
      builder.move(s, right, s, 0.0, current.stay);
      builder.move(s, right, s + 1, 0.0, current.forward);
    } else {
      const double washed = current.only_staying_pays ? 0.0 : current.much;
      builder.move(s, right, s - 1, washed, 1.0 - current.last_stay);
      builder.move(s, right, s, current.much, current.last_stay);
    }
  }
  if (settings->variant == Variant::strehl) {
    builder.start("s1").start("s2");
  } else {
    builder.start("s0");
  }
  builder.layout(row_layout(states, {{-1, 0}, {1, 0}}));
  Result<Mdp> mdp = builder.build();
  if (!mdp) return mdp.error();
  std::string row(states, '.');
  row.back() = 'G';
  return to_world("river-swim", std::move(*mdp), row_looks(std::move(row)));
}

}  // namespace

extern const WorldEntry river_swim_world;
const WorldEntry river_swim_world{"river-swim",
                                  "RiverSwim",
                                  "a small reward down the river, a large one up against it",
                                  "Strehl, Littman 2008; Osband, Russo, Van Roy 2013",
                                  make,
                                  parameters_of<Settings>};

}  // namespace quoll
