// Forest management: each year the forest is left to wait, or cut. Waiting ages it by one class, up
// to the last, unless a fire (probability fire) burns it down to the first; cutting always takes it
// back to the first. Waiting in the last class earns wait_reward, cutting in it cut_reward, cutting
// in a class between 1. No ends, discount 0.9.
// The example of MDPtoolbox (Chades et al. 2014, "MDPtoolbox: a multi-platform toolbox to solve
// stochastic dynamic programming problems", Ecography 37) and pymdptoolbox's forest(S, r1, r2, p),
// outcomes in its order.
// State: its name, "age-0" to "age-2". One draw a step.

#include <algorithm>
#include <utility>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

struct Settings {
  std::uint64_t states = 3;
  double wait_reward = 4.0;
  double cut_reward = 2.0;
  double fire = 0.1;

  void describe(Describer& d) {
    d("states", states, 2, 1'000'000, "classes of age");
    d("wait_reward", wait_reward, -1e9, 1e9, "reward of waiting in the last class, r1");
    d("cut_reward", cut_reward, -1e9, 1e9, "reward of cutting in the last class, r2");
    d("fire", fire, 0, 1, "probability that a year of waiting ends in a fire, p");
  }
};

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("forest", given);
  if (!settings) return settings.error();
  const auto states = static_cast<State>(settings->states);
  MdpBuilder builder(0.9);
  for (State s = 0; s < states; ++s) builder.state("age-" + std::to_string(s));
  const std::uint32_t wait = builder.action("wait");
  const std::uint32_t cut = builder.action("cut");
  for (State s = 0; s < states; ++s) {
    const bool last = s + 1 == states;
    const double reward = last ? settings->wait_reward : 0.0;
    if (settings->fire > 0.0) builder.move(s, wait, 0, reward, settings->fire);
    if (settings->fire < 1.0) {
      builder.move(s, wait, last ? s : s + 1, reward, 1.0 - settings->fire);
    }
    builder.move(s, cut, 0, last ? settings->cut_reward : s == 0 ? 0.0 : 1.0, 1.0);
  }
  builder.layout(row_layout(states, {{1, 0}, {-1, 0}}));
  Result<Mdp> mdp = builder.build();
  if (!mdp) return mdp.error();
  return to_world("forest", std::move(*mdp), row_looks(std::string(states, '.')));
}

}  // namespace

extern const WorldEntry forest_world;
const WorldEntry forest_world{"forest",
                              "",
                              "cut a forest now, or let it grow in spite of fires",
                              "MDPtoolbox (Chades et al. 2014); pymdptoolbox, example.forest",
                              make,
                              parameters_of<Settings>};

}  // namespace quoll
