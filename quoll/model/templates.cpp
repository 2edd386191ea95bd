#include "quoll/model/templates.hpp"

namespace quoll {

namespace {

constexpr std::string_view world_program =
    R"(// The world @name@: a walker on a street of ten places; wind may hold it up. Change it.
// Build:  c++ -std=c++20 -O2 @name@.cpp -lquoll -pthread
// (or with CMake: find_package(Quoll) and link Quoll::Quoll).
#include <cstdio>
#include <quoll/quoll.hpp>

struct @type@ {
  static constexpr int places = 10;
  using Position = int;  // any copyable type: everything the future depends on

  quoll::Spaces spaces() const { return {.actions = 2, .states = places}; }

  // Where an episode begins. dice.uniform() is a number in [0, 1), dice.below(n) one of 0 .. n-1.
  Position start(auto& dice) const { return static_cast<int>(dice.below(places - 1)); }

  // What an action does: 0 = left, 1 = right. Gives {reward, terminated, truncated}.
  quoll::Feedback step(Position& at, quoll::Action action, auto& dice) const {
    const bool wind = dice.uniform() < 0.1;
    if (!wind) at += action == 1 ? 1 : -1;
    if (at < 0) at = 0;
    if (at == places - 1) return {10.0, true, false};
    return {-1.0, false, false};
  }

  // The number of a position, below spaces().states: the row of the Q table.
  quoll::State number(const Position& at) const { return static_cast<quoll::State>(at); }
};

int main() {
  quoll::RunSettings settings;
  settings.steps = 200'000;
  settings.learn.explore = "epsilon-greedy";
  const quoll::World world = quoll::to_world("@name@", @type@{}, 0.95);
  const quoll::Learned learned = quoll::learn(world, settings);
  const auto& played = learned.result().seeds.front().played;
  std::printf("greedy episodes: return %.2f on average in %.1f steps\n", played.mean,
              played.mean_steps);
  for (int at = 0; at < @type@::places - 1; ++at) {
    const quoll::Action action = learned.policy()(static_cast<quoll::State>(at));
    std::printf("place %d: %s\n", at, action == 1 ? "right" : action == 0 ? "left" : "never been");
  }
}
)";

// "mars-rover" as the name of a type: "MarsRover".
std::string type_name(std::string_view name) {
  std::string type;
  bool upper = true;
  for (const char letter : name) {
    if (letter == '-') {
      upper = true;
      continue;
    }
    type +=
        upper && letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
    upper = false;
  }
  return type;
}

}  // namespace

std::string_view toml_template() {
  return R"(# A machine that wears out: change names, numbers and states, then
#   quoll check FILE      what is wrong or suspicious
#   quoll solve FILE      the best decision in every state, with proof
# Comments begin with '#'. docs/worlds.md has the whole format.

discount = 0.95            # what a reward one step later counts; above 0, at most 1
start = "GOOD"             # or "uniform", or { GOOD = 0.9, WORN = 0.1 }

[states.GOOD]              # a state; the lines below are its actions
run = { to = { GOOD = 0.8, WORN = 0.2 }, reward = 10 }       # by chance; one reward

[states.WORN]
run = [                                                      # by chance; a reward for each outcome
  { to = "WORN",   probability = 0.6, reward = 7 },
  { to = "BROKEN", probability = 0.4, reward = 2 },
]
service = { to = "GOOD", reward = -3 }                       # certain

[states.BROKEN]
replace = { to = "GOOD", reward = -20 }
sell = { to = "SOLD", reward = 5 }

[states.SOLD]              # no actions: an end, nothing is earned after it
)";
}

std::string_view csv_template() {
  return R"(# A machine that wears out: change names and numbers, add rows.
# One row per outcome; the probabilities of a state and action sum to 1.
# A state without rows of its own is an end. docs/worlds.md has the whole format.
# discount = 0.95
# start = GOOD
state,action,next_state,probability,reward
GOOD,run,GOOD,0.8,10
GOOD,run,WORN,0.2,10
WORN,run,WORN,0.6,7
WORN,run,BROKEN,0.4,2
WORN,service,GOOD,1,-3
BROKEN,replace,GOOD,1,-20
BROKEN,sell,SOLD,1,5
)";
}

std::string world_template(std::string_view name) {
  const std::string type = type_name(name);
  std::string text;
  for (std::string_view rest = world_program; !rest.empty();) {
    if (rest.starts_with("@name@")) {
      text += name;
      rest.remove_prefix(6);
    } else if (rest.starts_with("@type@")) {
      text += type;
      rest.remove_prefix(6);
    } else {
      text += rest.front();
      rest.remove_prefix(1);
    }
  }
  return text;
}

}  // namespace quoll
