#include "quoll/learn/deep/name_letters.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <unordered_map>

#include "quoll/base/utf8.hpp"
#include "quoll/env/listed.hpp"

namespace quoll {
namespace {

std::u32string letters_of(const std::string& name) {
  std::u32string letters;
  for (std::string_view rest = name; !rest.empty();) {
    const CodePoint letter = decode(rest);
    letters.push_back(letter.value);
    rest.remove_prefix(letter.length);
  }
  return letters;
}

}  // namespace

Result<std::shared_ptr<const NameLetters>> NameLetters::make(const World& world,
                                                             const Spaces& spaces) {
  if (spaces.observation > 0) {
    return Error{"--inputs", 0, 0,
                 world.name + " shows numbers; letters are for worlds whose states have names",
                 "auto"};
  }
  const Result<std::shared_ptr<const Mdp>> states = listed(world);
  if (!states) return Error{"--inputs", 0, 0, states.error().expected, "auto"};
  const Mdp& mdp = **states;
  // Which letters stand at each place of what somebody acts in, then the input of each.
  constexpr std::uint32_t none = ~std::uint32_t{0};
  std::vector<std::map<char32_t, std::uint32_t>> inputs;
  std::vector<std::size_t> long_enough;  // names that reach the place
  std::size_t names = 0;
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    ++names;
    const std::u32string name = letters_of(mdp.state_name(s));
    inputs.resize(std::max(inputs.size(), name.size()));
    long_enough.resize(inputs.size());
    for (std::size_t i = 0; i < name.size(); ++i) {
      ++long_enough[i];
      inputs[i].emplace(name[i], none);
    }
  }
  auto letters = std::make_shared<NameLetters>();
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const bool tells = inputs[i].size() > 1 || long_enough[i] < names;
    for (auto& [letter, input] : inputs[i]) {
      if (!tells) continue;
      input = static_cast<std::uint32_t>(letters->letters_.size());
      letters->letters_.push_back({letter, i});
    }
  }
  for (State s = 0; s < mdp.states(); ++s) {
    const std::u32string name = letters_of(mdp.state_name(s));
    letters->begin_.push_back(letters->spots_.size());
    for (std::size_t i = 0; i < std::min(name.size(), inputs.size()); ++i) {
      const auto found = inputs[i].find(name[i]);
      if (found == inputs[i].end() || found->second == none) continue;
      letters->spots_.push_back(found->second);
    }
  }
  letters->begin_.push_back(letters->spots_.size());
  if (letters->letters_.empty()) {
    return Error{"--inputs", 0, 0, world.name + " has one state to act in: its name tells nothing",
                 "auto"};
  }
  letters->name_outputs(mdp);
  return std::shared_ptr<const NameLetters>(std::move(letters));
}

// In the order in which they are met.
void NameLetters::name_outputs(const Mdp& mdp) {
  std::unordered_map<std::string, Action> outputs;
  std::size_t most = 0;
  for (State s = 0; s < mdp.states(); ++s) {
    row_begin_.push_back(output_.size());
    most = std::max<std::size_t>(most, mdp.actions(s));
    for (Action a = 0; a < mdp.actions(s); ++a) {
      const std::string name = mdp.action_name(mdp.choice_begin(s) + a);
      const auto [known, is_new] = outputs.emplace(name, static_cast<Action>(outputs.size()));
      if (is_new) output_names_.push_back(name);
      output_.push_back(known->second);
    }
  }
  row_begin_.push_back(output_.size());
  output_names_.resize(std::max(output_names_.size(), most));
}

}  // namespace quoll
