#include "quoll/model/formats/numbered.hpp"

#include <algorithm>
#include <utility>

namespace quoll {
NumberedModel::NumberedModel(std::uint64_t expected_outcomes) {
  a_.next.reserve(expected_outcomes);
  a_.probability.reserve(expected_outcomes);
}

std::uint32_t NumberedModel::action_of(std::string_view name) {
  const std::uint32_t action = actions_.insert(name);
  if (action >= last_state_.size()) last_state_.resize(std::size_t{action} + 1, 0);
  return action;
}

bool NumberedModel::taken(std::uint32_t action) const {
  return last_state_[action] == states();
}

void NumberedModel::open_choice(std::string_view name, std::uint64_t line) {
  const std::string number = std::to_string(choices_of_state());
  std::uint32_t action = action_of(name.empty() ? number : name);
  if (taken(action)) {
    std::string unique = std::string(name.empty() ? number : name) + "." + number;
    if (renamed_.empty()) {
      renamed_ = "state " + std::to_string(states() - 1) + " has two choices called " +
                 std::string(name.empty() ? number : name) + ": the second is " + unique +
                 ", and so wherever names are not different";
    }
    while (taken(action = action_of(unique))) unique += "." + number;
  }
  last_state_[action] = states();
  a_.action.push_back(action);
  a_.outcome_begin.push_back(a_.next.size());
  a_.choice_line.push_back(static_cast<std::uint32_t>(std::min<std::uint64_t>(line, 0xffffffff)));
}

MdpArrays NumberedModel::finish() {
  a_.choice_begin.push_back(a_.action.size());
  a_.outcome_begin.push_back(a_.next.size());
  a_.reward.assign(a_.action.size(), 0.0);
  a_.action_names = actions_.take({});
  a_.discount = 1.0;
  if (!renamed_.empty()) a_.remarks.push_back(std::move(renamed_));
  return std::move(a_);
}

std::vector<std::pair<std::string_view, std::string_view>> valuation(std::string_view name) {
  std::vector<std::pair<std::string_view, std::string_view>> pairs;
  if (name.size() < 2 || name.front() != '(' || name.back() != ')') return {};
  std::string_view rest = name.substr(1, name.size() - 2);
  while (true) {
    const std::size_t comma = rest.find(',');
    const std::string_view pair = rest.substr(0, comma);
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos || equals == 0 || equals + 1 == pair.size()) return {};
    // Whatever a reader would not take back letter by letter is no valuation.
    if (pair.find_first_of("()&\" \t") != std::string_view::npos) return {};
    if (pair.find('=', equals + 1) != std::string_view::npos) return {};
    pairs.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
    if (comma == std::string_view::npos) return pairs;
    rest.remove_prefix(comma + 1);
  }
}

std::string StateNames::name_of(const std::vector<std::string_view>& values) const {
  if (plain()) return std::string(values[0]);
  std::string name = "(";
  for (std::size_t i = 0; i < values.size(); ++i) {
    name += (i > 0 ? "," : "") + variables_[i] + "=" + std::string(values[i]);
  }
  return name + ")";
}

StateNames StateNames::of(const Mdp& mdp) {
  std::vector<std::string> variables;
  for (State s = 0; s < mdp.states(); ++s) {
    const std::string name = mdp.state_name(s);
    const auto pairs = valuation(name);
    bool same = !pairs.empty() && (s == 0 || pairs.size() == variables.size());
    for (std::size_t i = 0; i < pairs.size() && same; ++i) {
      if (s == 0) variables.emplace_back(pairs[i].first);
      same = variables[i] == pairs[i].first;
    }
    if (!same || variables == std::vector<std::string>{"name"}) return StateNames({"name"});
  }
  return StateNames(std::move(variables));
}

std::string StateNames::values_of(const std::string& name) const {
  if (plain()) return name;
  std::string text;
  for (const auto& [variable, value] : valuation(name)) {
    text += (text.empty() ? "" : ",") + std::string(value);
  }
  return text;
}

bool states_are_numbered(const Mdp& mdp) {
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.state_name(s) != std::to_string(s)) return false;
  }
  return true;
}

WrittenSizes written_sizes(const Mdp& mdp) {
  WrittenSizes sizes;
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    sizes.choices += mdp.actions(s);
    sizes.outcomes += mdp.outcome_begin(mdp.choice_end(s)) - mdp.outcome_begin(mdp.choice_begin(s));
  }
  return sizes;
}

std::string given_name(const Mdp& mdp, State state, std::uint64_t choice) {
  std::string name = mdp.action_name(choice);
  if (name == std::to_string(choice - mdp.choice_begin(state))) return "";
  return name;
}

}  // namespace quoll
