#include "quoll/cli/infinite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "quoll/solve/methods.hpp"

namespace quoll::cli {
namespace {

/// States and why their value is not finite.
using Reason = std::pair<const std::vector<State>*, std::string>;

std::array<Reason, 2> reasons(const DefinedPart& outside, bool minimise) {
  return {{{&outside.endless, "no policy gets there with probability 1"},
           {&outside.boundless,
            fmt::format("one {} {} reward for ever without getting there",
                        outside.certain ? "can" : "may", minimise ? "lose" : "gain")}}};
}

}  // namespace

std::vector<State> infinite_states(const DefinedPart& outside) {
  std::vector<State> states;
  std::merge(outside.endless.begin(), outside.endless.end(), outside.boundless.begin(),
             outside.boundless.end(), std::back_inserter(states));
  return states;
}

std::string infinite_text(const Mdp& mdp, const DefinedPart& outside, bool minimise) {
  std::string text;
  for (const auto& [states, reason] : reasons(outside, minimise)) {
    if (states->empty()) continue;
    text += fmt::format("the reward until the goal is infinite from {}: {}\n",
                        some_names(mdp, *states), reason);
  }
  return text;
}

std::optional<Error> infinite_start(const Mdp& mdp, const DefinedPart& outside, bool minimise) {
  for (const auto& [states, reason] : reasons(outside, minimise)) {
    std::vector<State> among;
    std::set_intersection(states->begin(), states->end(), mdp.start().begin(), mdp.start().end(),
                          std::back_inserter(among));
    if (among.empty()) continue;
    return Error{"--goal", 0, 0,
                 fmt::format("the {} reward until the goal is infinite from the start {}: {}",
                             minimise ? "least" : "largest", some_names(mdp, among), reason),
                 ""};
  }
  return std::nullopt;
}

}  // namespace quoll::cli
