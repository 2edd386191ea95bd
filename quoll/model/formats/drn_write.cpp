// Models as DRN files, which read_drn() takes back.

#include <algorithm>
#include <string>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/numbered.hpp"
#include "quoll/model/formats/words.hpp"

namespace quoll {
namespace {

std::string label_word(const std::string& name) {
  for (const char letter : name) {
    const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                       (letter >= '0' && letter <= '9') || letter == '_';
    if (!plain) return " \"" + name + "\"";
  }
  return " " + name;
}

std::string name_comment(const std::string& name) {
  const auto pairs = valuation(name);
  if (pairs.empty()) return "// " + name + "\n";
  std::string text;
  for (const auto& [variable, value] : pairs) {
    text += (text.empty() ? "//[" : "\t& ") + std::string(variable) + "=" + std::string(value);
  }
  return text + "]\n";
}

std::vector<std::string> labels_of_states(const Mdp& mdp) {
  std::vector<std::string> words(mdp.states());
  for (const State s : mdp.start()) words[s] = " init";
  for (const Label& label : mdp.arrays().labels) {
    const std::string word = label_word(label.name);
    for (const State s : label.states) words[s] += word;
  }
  return words;
}

}  // namespace

Result<std::string> write_drn(const Mdp& mdp) {
  if (const Result<void> one = one_player(mdp); !one) return one.error();
  const Result<void> proper = proper_names(mdp);
  if (!proper) return proper.error();
  const Result<void> quotable = quotable_names(mdp);
  if (!quotable) return quotable.error();
  const MdpArrays& a = mdp.arrays();
  std::vector<const std::vector<double>*> rewards{&a.reward};
  const bool none = a.reward_name.empty() && a.other_rewards.empty() &&
                    std::all_of(a.reward.begin(), a.reward.end(), [](double r) { return r == 0; });
  if (none) rewards.clear();
  std::string text = "@type: MDP\n@value_type: double\n@parameters\n\n@reward_models\n";
  if (!none) text += a.reward_name.empty() ? "reward" : as_word(a.reward_name);
  for (const RewardStructure& other : a.other_rewards) {
    text += " " + as_word(other.name);
    rewards.push_back(&other.reward);
  }
  text += "\n@nr_states\n" + std::to_string(mdp.states()) + "\n@nr_choices\n" +
          std::to_string(std::max<std::uint64_t>(written_sizes(mdp).choices, 1)) + "\n@model\n";
  const std::vector<std::string> words = labels_of_states(mdp);
  const bool named = !states_are_numbered(mdp);
  for (State s = 0; s < mdp.states(); ++s) {
    text += "state " + std::to_string(s) + words[s] + "\n";
    if (named) text += name_comment(mdp.state_name(s));
    if (mdp.terminal(s)) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      text += "\taction " + as_word(mdp.action_name(c));
      for (std::size_t i = 0; i < rewards.size(); ++i) {
        text += (i == 0 ? " [" : ",") + shortest((*rewards[i])[c]);
      }
      text += rewards.empty() ? "\n" : "]\n";
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        text += "\t\t" + std::to_string(mdp.next(o)) + " : " + shortest(mdp.probability(o)) + "\n";
      }
    }
  }
  return text;
}

}  // namespace quoll
