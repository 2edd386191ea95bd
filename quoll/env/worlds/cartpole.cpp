// CartPole: a pole hinged on a cart that is pushed left or right at every step; keep it up. Barto,
// Sutton, Anderson 1983, "Neuronlike adaptive elements that can solve difficult learning control
// problems", with the constants and the explicit Euler step of Gymnasium's CartPole.
//
// State, as JSON: [x (m), x' (m/s), angle (rad, 0 = upright, to the right positive), angle'
// (rad/s)], float64. Observation: the same as float32. Actions: left, right (-10 N, +10 N); steps
// of 0.02 s. The episode ends when |x| > 2.4 or |angle| > 12 degrees, and is cut off after `limit`
// steps. Reward 1 for every step, the last included; with sutton_barto_reward 0, and -1 at the end.
//
// Draws: a start takes four, x, x', angle, angle', each uniform in [-0.05, 0.05); a step none.
// Bins (--with bins=6,6,12,12) lie between: x +-2.4, x' +-3, angle +-12 degrees, angle' +-3.5.

#include "quoll/env/worlds/cartpole.hpp"
#include <algorithm>

#include <bit>

namespace quoll {
namespace {

enum class Numbers : std::uint8_t { twofold, single };
constexpr std::string_view numbers_names[] = {"double", "float"};

struct Settings {
  bool sutton_barto_reward = false;
  std::uint64_t limit = 500;
  Numbers precision = Numbers::twofold;
  std::string bins;
  Seeding seeding = Seeding::quoll;

  void describe(Describer& describe) {
    describe("sutton_barto_reward", sutton_barto_reward,
             "reward 0 for a step and -1 for the fall, instead of 1 for every step");
    describe("limit", limit, 1.0, 1e15, "steps after which an episode is cut off");
    describe.choice("precision", precision, numbers_names, "the numbers of the state");
    describe("bins", bins,
             "numbers of bins for position, velocity, angle and turning rate, such as 6,6,12,12: "
             "states become numbers");
    describe.choice("seeding", seeding, seeding_names,
                    "whose random numbers and whose sine: this program's own or Gymnasium's");
  }
};

// Many lanes go as columns where no bins and no other dice are asked for.
template <class Real>
Result<World> world_of(const Settings& settings, const WorldFacts& facts) {
  const CartPole<Real> dynamics{settings.sutton_barto_reward};
  Result<World> world = to_world("cartpole", dynamics, facts, settings.bins);
  const bool own = settings.bins.empty() && settings.seeding == Seeding::quoll;
  if (!world || !own || std::endian::native != std::endian::little) return world;
  world->make = [dynamics, limit = facts.episode_steps, one = world->make](Lanes lanes) {
    if (lanes.episode_steps == 0) lanes.episode_steps = limit;
    constexpr std::uint32_t few = 8;
    const bool many = lanes.count >= few && !lanes.draws && lanes.episode_steps >> 31 == 0;
    return many ? cartpole_lanes(dynamics, lanes) : one(lanes);
  };
  return world;
}

Result<World> make(const Parameters& parameters) {
  const Result<Settings> settings = read_parameters<Settings>("cartpole", parameters);
  if (!settings) return settings.error();
  const double end = settings->sutton_barto_reward ? -1.0 : 1.0;
  WorldFacts facts =
      control_facts(settings->limit, settings->seeding, {std::min(end, 0.0), std::max(end, 0.0)});
  // Gymnasium's reward_threshold of CartPole-v1 and CartPole-v0.
  if (!settings->sutton_barto_reward && settings->limit == 500) facts.traits.solved = 475.0;
  if (!settings->sutton_barto_reward && settings->limit == 200) facts.traits.solved = 195.0;
  if (settings->precision == Numbers::twofold) return world_of<double>(*settings, facts);
  if (settings->seeding == Seeding::gymnasium) {
    return Error{"--with precision", 0, 0, "double expected: Gymnasium's state is double", ""};
  }
  return world_of<float>(*settings, facts);
}

}  // namespace

extern const WorldEntry cartpole_world;
const WorldEntry cartpole_world{"cartpole",
                                "CartPole-v1 CartPole-v0:limit=200",
                                "a cart is pushed left or right to keep its pole upright",
                                "Barto, Sutton, Anderson 1983; Gymnasium CartPole-v1",
                                make,
                                parameters_of<Settings>};

}  // namespace quoll
