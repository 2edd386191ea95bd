#include "quoll/model/formats/distinct_actions.hpp"

#include <string>
#include <utility>
#include <vector>

#include "quoll/model/letters.hpp"
#include "quoll/model/name_index.hpp"

namespace quoll {
namespace {

bool all_proper(const Names& names) {
  for (std::uint64_t i = 0; i < names.size(); ++i) {
    if (!name_fault(names[i]).empty()) return false;
  }
  return true;
}

bool all_distinct(const MdpArrays& a, std::uint64_t actions) {
  std::vector<std::uint64_t> last_state(actions, 0);  // from 1
  for (std::uint64_t s = 0; s + 1 < a.choice_begin.size(); ++s) {
    for (std::uint64_t c = a.choice_begin[s]; c < a.choice_begin[s + 1]; ++c) {
      if (std::exchange(last_state[a.action[c]], s + 1) == s + 1) return false;
    }
  }
  return true;
}

}  // namespace

void name_actions(MdpArrays& arrays, Names given) {
  if (all_proper(given) && all_distinct(arrays, given.size())) {
    arrays.action_names = std::move(given);
    return;
  }
  NameIndex names;
  std::vector<std::uint64_t> last_state;  // per name: the last state that has it, from 1
  const auto find = [&](const std::string& name) {
    const std::uint32_t number = names.insert(name);
    if (number >= last_state.size()) last_state.resize(std::size_t{number} + 1, 0);
    return number;
  };
  for (std::uint64_t i = 0; i < given.size(); ++i) {
    if (name_fault(given[i]).empty()) find(given[i]);
  }
  std::string renamed;
  for (std::uint64_t s = 0; s + 1 < arrays.choice_begin.size(); ++s) {
    for (std::uint64_t c = arrays.choice_begin[s]; c < arrays.choice_begin[s + 1]; ++c) {
      const std::string number = std::to_string(c - arrays.choice_begin[s]);
      std::string name = given[arrays.action[c]];
      if (!name_fault(name).empty()) name = number;
      std::uint32_t action = find(name);
      if (last_state[action] == s + 1) {
        std::string longer = name + "." + number;
        if (renamed.empty()) {
          renamed = "state " + std::to_string(s) + " has two choices called " + name +
                    ": the second is " + longer + ", and so wherever names are not different";
        }
        while (last_state[action = find(longer)] == s + 1) longer += "." + number;
      }
      last_state[action] = s + 1;
      arrays.action[c] = action;
    }
  }
  arrays.action_names = names.take({});
  if (!renamed.empty()) arrays.remarks.push_back(std::move(renamed));
}

}  // namespace quoll
