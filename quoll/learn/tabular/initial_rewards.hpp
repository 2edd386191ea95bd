#pragma once
// The given initial rewards rE of the rules that have them, laid out like the table.

#include <string_view>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/env/table.hpp"
#include "quoll/learn/settings.hpp"

namespace quoll {

/// One value per pair of the layout: setup.initial_rewards (per choice), or 0 where there are none.
inline std::vector<double> initial_rewards_per_pair(const LearnSetup& setup, PairLayout layout,
                                                    const std::vector<std::uint64_t>& begin) {
  std::vector<double> rewards(layout.pairs, 0.0);
  if (setup.initial_rewards.empty()) return rewards;
  for (std::size_t s = 0; s + 1 < begin.size(); ++s) {
    for (std::uint64_t choice = begin[s]; choice < begin[s + 1]; ++choice) {
      const std::uint64_t first = layout.width == 0 ? begin[s] : s * layout.width;
      rewards[first + (choice - begin[s])] = setup.initial_rewards[choice];
    }
  }
  return rewards;
}

/// One value per pair: a saved list of another length does not fit the table.
inline void persist_per_pair(Archive& archive, std::string_view name, std::vector<double>& values) {
  const std::size_t pairs = values.size();
  archive(name, values);
  if (values.size() != pairs) archive.fail("the saved table does not fit this world");
  values.resize(pairs);
}

}  // namespace quoll
