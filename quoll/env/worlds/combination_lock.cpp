// Combination lock: the right button of each place leads on, every other one back to the start; the
// last right one opens the lock: reward 1, the end. Discount 0.99, so V = 0.99^(length - 1) at the
// start. Without a memory of what was tried it takes about buttons^length presses to find out.
// Whitehead 1991, "Complexity and cooperation in Q-learning"; Koenig, Simmons 1993, "Complexity
// analysis of real-time reinforcement learning", whose reset worlds these are.
// The right buttons are drawn by `seed`. State: its name, "0-right", "1-right", ... or "open". No
// draws.

#include <utility>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

struct Settings {
  std::uint64_t length = 20;
  std::uint64_t buttons = 2;
  std::uint64_t seed = 1;

  void describe(Describer& d) {
    d("length", length, 1, 1'000'000, "presses that open the lock");
    d("buttons", buttons, 2, 100, "buttons to choose from");
    d("seed", seed, "which combination");
  }
};

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("combination-lock", given);
  if (!settings) return settings.error();
  const auto length = static_cast<State>(settings->length);
  const auto buttons = static_cast<std::uint32_t>(settings->buttons);
  MdpBuilder builder(0.99);
  for (State s = 0; s < length; ++s) builder.state(std::to_string(s) + "-right");
  builder.state("open");
  for (std::uint32_t b = 0; b < buttons; ++b) builder.action("press-" + std::to_string(b));
  Rng dice = stream(settings->seed, "combination-lock");
  for (State s = 0; s < length; ++s) {
    const std::uint32_t right = dice.below(buttons);
    for (std::uint32_t b = 0; b < buttons; ++b) {
      const bool opens = b == right && s + 1 == length;
      builder.move(s, b, b == right ? s + 1 : 0, opens ? 1.0 : 0.0, 1.0);
    }
  }
  builder.start("0-right");
  Result<Mdp> mdp = builder.build();
  if (!mdp) return mdp.error();
  return to_world("combination-lock", std::move(*mdp), row_looks(std::string(length, '.') + "G"));
}

}  // namespace

extern const WorldEntry combination_lock_world;
const WorldEntry combination_lock_world{"combination-lock",
                                        "",
                                        "one wrong button and the lock starts again",
                                        "Whitehead 1991; Koenig, Simmons 1993",
                                        make,
                                        parameters_of<Settings>};

}  // namespace quoll
