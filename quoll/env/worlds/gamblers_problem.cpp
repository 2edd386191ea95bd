// The gambler's problem: capital 1 to goal - 1; a stake is won with probability p and else lost;
// reward 1 on reaching the goal, the ends are 0 and the goal, discount 1: the value is the
// probability to reach the goal. A stake is at least 1 (the book also allows 0, which changes
// nothing) and at most what is owned or missing.
// Sutton, Barto 2018, "Reinforcement Learning", example 4.3, figure 4.3. For p below 1/2 bold play,
// staking all that helps, is optimal (Dubins, Savage 1965), and many other stakes are as good.
// Starts with any capital, uniformly. State: its name, the capital. One draw a step.

#include <algorithm>
#include <utility>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

struct Settings {
  double p = 0.4;
  std::uint64_t goal = 100;

  void describe(Describer& d) {
    d("p", p, 0, 1, "probability of winning a stake");
    d("goal", goal, 2, 2000, "capital that ends the game");
  }
};

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("gamblers-problem", given);
  if (!settings) return settings.error();
  const auto goal = static_cast<State>(settings->goal);
  const double p = settings->p;
  MdpBuilder builder(1.0);
  for (State capital = 0; capital <= goal; ++capital) builder.state(std::to_string(capital));
  for (State stake = 1; stake <= goal / 2; ++stake) {
    builder.action("stake-" + std::to_string(stake));
  }
  for (State capital = 1; capital < goal; ++capital) {
    for (State stake = 1; stake <= std::min(capital, goal - capital); ++stake) {
      const double reward = capital + stake == goal ? 1.0 : 0.0;
      if (p > 0.0) builder.move(capital, stake - 1, capital + stake, reward, p);
      if (p < 1.0) builder.move(capital, stake - 1, capital - stake, 0.0, 1.0 - p);
    }
  }
  Result<Mdp> mdp = builder.build();
  if (!mdp) return mdp.error();
  return to_world("gamblers-problem", std::move(*mdp), row_looks(std::string(goal, '.') + "G"));
}

}  // namespace

extern const WorldEntry gamblers_problem_world;
const WorldEntry gamblers_problem_world{"gamblers-problem",
                                        "gambler",
                                        "stake on heads until all is won or lost",
                                        "Sutton, Barto 2018, example 4.3",
                                        make,
                                        parameters_of<Settings>};

}  // namespace quoll
