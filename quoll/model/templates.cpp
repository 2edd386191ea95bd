#include "quoll/model/templates.hpp"

namespace quoll {

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

}  // namespace quoll
