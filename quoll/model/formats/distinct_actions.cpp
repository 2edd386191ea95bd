#include "quoll/model/formats/distinct_actions.hpp"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "quoll/base/text.hpp"

namespace quoll {
namespace {

// The names of actions, and the new ones of those met again.
class Renamer {
 public:
  explicit Renamer(Names& names) : names_(names) {}

  // The name of an action's choice number `times` in one state, from 2.
  std::uint32_t renamed(std::uint32_t action, std::uint32_t times) {
    const auto [entry, fresh] =
        made_.try_emplace({action, times}, static_cast<std::uint32_t>(names_.size()));
    if (!fresh) return entry->second;
    if (taken_.empty()) store();
    std::string name = names_[action] + "'" + std::to_string(times);
    while (!taken_.insert(name).second) name.insert(name.rfind('\''), "'");
    names_.push_back(name);
    return entry->second;
  }

 private:
  void store() {
    Names stored;
    for (std::uint64_t i = 0; i < names_.size(); ++i) {
      stored.push_back(names_[i]);
      taken_.insert(names_[i]);
    }
    names_ = std::move(stored);
  }

  Names& names_;
  std::set<std::string> taken_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> made_;
};

}  // namespace

void make_actions_distinct(MdpArrays& arrays) {
  const std::uint64_t named = arrays.action_names.size();
  Renamer renamer(arrays.action_names);
  // Per action: the last state that used it and how often there.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> last(named, {UINT64_MAX, 0});
  std::uint64_t renamed = 0;
  for (std::uint64_t s = 0; s + 1 < arrays.choice_begin.size(); ++s) {
    for (std::uint64_t c = arrays.choice_begin[s]; c < arrays.choice_begin[s + 1]; ++c) {
      auto& [state, times] = last[arrays.action[c]];
      times = state == s ? times + 1 : 1;
      state = s;
      if (times == 1) continue;
      arrays.action[c] = renamer.renamed(arrays.action[c], times);
      ++renamed;
    }
  }
  if (renamed == 0) return;
  arrays.remarks.push_back(counted(renamed, "choice") +
                           " with an action its state already has: numbered, as in " +
                           arrays.action_names[named]);
}

}  // namespace quoll
