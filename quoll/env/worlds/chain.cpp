// The chain: forward earns nothing until the last state, where it stays and earns `large`; back
// returns to the first state and earns `small`. With probability `slip` the other action happens.
// No ends; episodes are cut after 1000 steps. Discount 0.99.
// Dearden, Friedman, Russell 1998, "Bayesian Q-learning"; Strens 2000, "A Bayesian framework for
// reinforcement learning": five states, slip 0.2. Always forward is optimal and earns 3677 in 1000
// steps (Poupart et al. 2006). Later called NChain.
// State: its name, "s0" to "s4". One draw a step.

#include <utility>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

struct Settings {
  std::uint64_t states = 5;
  double slip = 0.2;
  double small = 2.0;
  double large = 10.0;

  void describe(Describer& d) {
    d("states", states, 2, 1'000'000, "length of the chain");
    d("slip", slip, 0, 1, "probability that the other action happens");
    d("small", small, -1e9, 1e9, "reward of going back");
    d("large", large, -1e9, 1e9, "reward of forward in the last state");
  }
};

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("chain", given);
  if (!settings) return settings.error();
  const auto states = static_cast<State>(settings->states);
  MdpBuilder builder(0.99);
  for (State s = 0; s < states; ++s) builder.state("s" + std::to_string(s));
  const std::uint32_t actions[] = {builder.action("forward"), builder.action("back")};
  for (State s = 0; s < states; ++s) {
    const bool last = s + 1 == states;
    for (const std::uint32_t action : actions) {
      const double forward = action == actions[0] ? 1.0 - settings->slip : settings->slip;
      if (forward > 0.0) {
        builder.move(s, action, last ? s : s + 1, last ? settings->large : 0.0, forward);
      }
      if (forward < 1.0) builder.move(s, action, 0, settings->small, 1.0 - forward);
    }
  }
  builder.start("s0");
  builder.layout(row_layout(states, {{1, 0}, {-1, 0}}));
  Result<Mdp> mdp = builder.build();
  if (!mdp) return mdp.error();
  std::string row(states, '.');
  row.back() = 'G';
  return to_world("chain", std::move(*mdp), row_looks(std::move(row)), 1000);
}

}  // namespace

extern const WorldEntry chain_world;
const WorldEntry chain_world{"chain",
                             "NChain-v0 nchain",
                             "patience pays: small rewards at one end, a large one at the other",
                             "Dearden, Friedman, Russell 1998; Strens 2000",
                             make,
                             parameters_of<Settings>};

}  // namespace quoll
