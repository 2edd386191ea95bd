// A model as the explicit files of PRISM, which read_prism_path() takes back.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/numbered.hpp"
#include "quoll/model/formats/prism.hpp"
#include "quoll/model/formats/words.hpp"

namespace quoll {
namespace {

std::string transitions(const Mdp& mdp) {
  const WrittenSizes sizes = written_sizes(mdp);
  std::string text = std::to_string(mdp.states()) + " " + std::to_string(sizes.choices) + " " +
                     std::to_string(sizes.outcomes) + "\n";
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      const std::string front =
          std::to_string(s) + " " + std::to_string(c - mdp.choice_begin(s)) + " ";
      const std::string name = given_name(mdp, s, c);
      const std::string back = (name.empty() ? "" : " " + as_word(name)) + "\n";
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        text += front + std::to_string(mdp.next(o)) + " " + shortest(mdp.probability(o)) + back;
      }
    }
  }
  return text;
}

std::string states(const Mdp& mdp) {
  const StateNames form = StateNames::of(mdp);
  std::string text;
  for (const std::string& variable : form.variables()) {
    text += (text.empty() ? "(" : ",") + variable;
  }
  text += ")\n";
  for (State s = 0; s < mdp.states(); ++s) {
    text += std::to_string(s) + ":(" + form.values_of(mdp.state_name(s)) + ")\n";
  }
  return text;
}

std::string labels(const Mdp& mdp) {
  std::string text = "0=\"init\"";
  std::vector<std::string> of_state(mdp.states());
  for (const State s : mdp.start()) of_state[s] = " 0";
  std::size_t number = 0;
  for (const Label& label : mdp.arrays().labels) {
    ++number;
    text += " " + std::to_string(number) + "=\"" + label.name + "\"";
    for (const State s : label.states) of_state[s] += " " + std::to_string(number);
  }
  text += "\n";
  for (State s = 0; s < mdp.states(); ++s) {
    if (!of_state[s].empty()) text += std::to_string(s) + ":" + of_state[s] + "\n";
  }
  return text;
}

/// A structure as the files have it: per choice, and per outcome where outcomes differ.
struct Structure {
  std::string name;
  const std::vector<double>& reward;
  const std::vector<double>& outcome;
};

class RewardWriter {
 public:
  RewardWriter(const Mdp& mdp, const Structure& rewards) : mdp_(mdp), rewards_(rewards) {}

  bool any() const {
    for (const double reward : rewards_.reward) {
      if (reward != 0.0) return true;
    }
    for (const double reward : rewards_.outcome) {
      if (reward != 0.0) return true;
    }
    return false;
  }

  // Whether each state has one reward, whatever is chosen and follows.
  bool of_states() const {
    if (!rewards_.outcome.empty()) return false;
    for (State s = 0; s < mdp_.states(); ++s) {
      if (mdp_.terminal(s)) continue;
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        if (rewards_.reward[c] != rewards_.reward[mdp_.choice_begin(s)]) return false;
      }
    }
    return true;
  }

  std::string text() {
    const bool named = !rewards_.name.empty();
    const std::string header = "# Reward structure" + (named ? ": \"" + rewards_.name + "\"" : "");
    std::string rows;
    std::uint64_t count = 0;
    const bool states = of_states();
    for (State s = 0; s < mdp_.states(); ++s) {
      if (mdp_.terminal(s)) continue;
      if (states)
        add_state(s, rows, count);
      else
        add_transitions(s, rows, count);
    }
    return header + (states ? "\n# State rewards\n" : "\n# Transition rewards\n") +
           std::to_string(mdp_.states()) +
           (states ? "" : " " + std::to_string(written_sizes(mdp_).choices)) + " " +
           std::to_string(count) + "\n" + rows;
  }

 private:
  void add_state(State s, std::string& rows, std::uint64_t& count) const {
    const double reward = rewards_.reward[mdp_.choice_begin(s)];
    if (reward == 0.0) return;
    rows += std::to_string(s) + " " + shortest(reward) + "\n";
    ++count;
  }

  void add_transitions(State s, std::string& rows, std::uint64_t& count) {
    if (met_.empty()) met_.resize(mdp_.states());
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      const bool varied = !rewards_.outcome.empty() && distinct(c);
      ++walk_;
      for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
        const double reward = varied ? rewards_.outcome[o] : rewards_.reward[c];
        Met& met = met_[mdp_.next(o)];
        const bool again = met.walk == walk_;
        met.walk = walk_;
        if (reward == 0.0 || again) continue;
        rows += std::to_string(s) + " " + std::to_string(c - mdp_.choice_begin(s)) + " " +
                std::to_string(mdp_.next(o)) + " " + shortest(reward) + "\n";
        ++count;
      }
    }
  }

  // Whether outcomes of a choice with one successor have one reward; the files tell no more apart.
  bool distinct(std::uint64_t c) {
    ++walk_;
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
      Met& met = met_[mdp_.next(o)];
      if (met.walk == walk_ && met.reward != rewards_.outcome[o]) return false;
      met = {walk_, rewards_.outcome[o]};
    }
    return true;
  }

  // The last walk over the outcomes of a choice that met a successor, and its reward there.
  struct Met {
    std::uint64_t walk = 0;
    double reward = 0.0;
  };
  std::vector<Met> met_;
  std::uint64_t walk_ = 0;
  const Mdp& mdp_;
  const Structure& rewards_;
};

// A single structure goes to MODEL.srew or .trew; of several the named ones to MODEL1.srew, ...
void add_rewards(const Mdp& mdp, const std::string& stem, std::vector<WrittenFile>& files) {
  const MdpArrays& a = mdp.arrays();
  std::vector<Structure> all{{a.reward_name, a.reward, a.outcome_reward}};
  for (const RewardStructure& other : a.other_rewards) {
    all.push_back({other.name, other.reward, other.outcome_reward});
  }
  std::size_t number = 0;
  for (const Structure& rewards : all) {
    RewardWriter writer(mdp, rewards);
    if (rewards.name.empty() && all.size() == 1 && !writer.any()) return;
    const bool numbered = all.size() > 1 && !rewards.name.empty();
    files.push_back({stem + (numbered ? std::to_string(++number) : "") +
                         (writer.of_states() ? ".srew" : ".trew"),
                     writer.text()});
  }
}

}  // namespace

Result<std::vector<WrittenFile>> write_prism(const Mdp& mdp, const std::string& path) {
  if (const Result<void> one = one_player(mdp); !one) return one.error();
  const Result<void> proper = proper_names(mdp);
  if (!proper) return proper.error();
  const Result<void> fit = quotable_names(mdp);
  if (!fit) return fit.error();
  const std::string stem = path.substr(0, path.size() - std::string_view(".tra").size());
  std::vector<WrittenFile> files{{path, transitions(mdp)}};
  if (!states_are_numbered(mdp)) files.push_back({stem + ".sta", states(mdp)});
  files.push_back({stem + ".lab", labels(mdp)});
  add_rewards(mdp, stem, files);
  const Result<void> alone = no_strangers_beside(path, files);
  if (!alone) return alone.error();
  return files;
}

}  // namespace quoll
