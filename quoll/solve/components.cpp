#include "quoll/solve/components.hpp"

#include <algorithm>
#include <numeric>

#include "quoll/model/graph.hpp"

namespace quoll {

Components::Components(const Mdp& mdp, const std::vector<std::uint8_t>& live) {
  const std::vector<std::uint32_t> component = strongly_connected(mdp);
  std::uint32_t last = 0;
  for (const std::uint32_t k : component) last = std::max(last, k);
  std::vector<std::uint64_t> size(std::size_t{last} + 1, 0);
  for (State s = 0; s < mdp.states(); ++s) size[component[s]] += live[s];
  // The place of each component's next state; components without live states are left out.
  std::uint64_t total = 0;
  for (std::uint64_t& n : size) {
    if (n > 0) begin_.push_back(total);
    total += n;
    n = total - n;
  }
  begin_.push_back(total);
  states_.resize(total);
  for (State s = 0; s < mdp.states(); ++s) {
    if (live[s] != 0) states_[size[component[s]]++] = s;
  }
}

bool Components::many(const Mdp& mdp) {
  return mdp.states() >= 512 && !strongly_connected(mdp, mdp.states() / 8).empty();
}

}  // namespace quoll
