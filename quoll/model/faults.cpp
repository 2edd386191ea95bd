// Validation of an Mdp's arrays: one scan, used to refuse a model at its first fault and to report
// all.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "quoll/model/check.hpp"

namespace quoll {

namespace {

constexpr double row_tolerance = 1e-9;

struct Fault {
  const char* kind;
  std::string place;  // "state HALL, action To-CAVE", or empty
  std::string what;
  std::uint64_t line = 0;
};

std::string number(double value) {
  return fmt::format("{:.12g}", value);
}

class Scan {
 public:
  /// `report` is told each fault; the scan goes on while it returns true.
  Scan(const MdpArrays& arrays, std::function<bool(const Fault&)> report)
      : a_(arrays), report_(std::move(report)) {}

  void run() {
    shape();
    if (going_) discount();
    if (going_) rows();
    if (going_) starts();
    if (going_) names();
    for (const RewardStructure& other : a_.other_rewards) {
      if (going_) rewards(other);
    }
  }

 private:
  void fault(const char* kind, std::string place, std::string what, std::uint64_t line = 0) {
    going_ = report_({kind, std::move(place), std::move(what), line});
  }

  std::string state(std::uint64_t s) const { return "state " + a_.state_names[s]; }

  void choice_fault(const char* kind, std::uint64_t s, std::uint64_t c, std::string what) {
    fault(kind, state(s) + ", action " + a_.action_names[a_.action[c]], std::move(what),
          a_.choice_line.empty() ? 0 : a_.choice_line[c]);
  }

  void misfit(std::string what) {
    fault("shape", "", std::move(what));
    going_ = false;
  }

  void length(const char* name, std::uint64_t found, std::uint64_t expected) {
    if (going_ && found != expected) {
      misfit(fmt::format("array {}: {} entries, expected {}", name, found, expected));
    }
  }

  static bool ascends(const std::vector<std::uint64_t>& offsets) {
    if (offsets.front() != 0) return false;
    for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
      if (offsets[i] > offsets[i + 1]) return false;
    }
    return true;
  }

  // After this every index made from the arrays is within bounds.
  void shape() {
    if (a_.choice_begin.size() < 2) return misfit("a model has at least one state");
    states_ = a_.choice_begin.size() - 1;
    if (states_ > max_states) {
      return misfit(fmt::format("{} states, at most {} are possible", states_, max_states));
    }
    if (!ascends(a_.choice_begin)) return misfit("array choice_begin must ascend from 0");
    const std::uint64_t choices = a_.choice_begin.back();
    length("action", a_.action.size(), choices);
    if (!a_.outcome_begin.empty()) length("outcome_begin", a_.outcome_begin.size(), choices + 1);
    if (!going_) return;
    if (!a_.outcome_begin.empty() && !ascends(a_.outcome_begin)) {
      return misfit("array outcome_begin must ascend from 0");
    }
    const std::uint64_t outcomes = a_.outcome_begin.empty() ? choices : a_.outcome_begin.back();
    length("next", a_.next.size(), outcomes);
    if (!a_.probability.empty()) length("probability", a_.probability.size(), outcomes);
    if (!a_.outcome_reward.empty()) length("outcome_reward", a_.outcome_reward.size(), outcomes);
    if (!a_.reward.empty() || a_.outcome_reward.empty()) {
      length("reward", a_.reward.size(), choices);
    }
    if (!a_.choice_line.empty()) length("choice_line", a_.choice_line.size(), choices);
    length("state_names", a_.state_names.size(), states_);
    if (!a_.start_probability.empty()) {
      length("start_probability", a_.start_probability.size(), a_.start.size());
    }
    if (a_.layout) length("layout.cell", a_.layout->cell.size(), states_);
    for (const RewardStructure& other : a_.other_rewards) {
      const std::string name = "rewards " + other.name;
      if (!other.outcome_reward.empty()) {
        length((name + " per outcome").c_str(), other.outcome_reward.size(), outcomes);
      }
      if (!other.reward.empty() || other.outcome_reward.empty()) {
        length((name + " per choice").c_str(), other.reward.size(), choices);
      }
    }
    if (going_) indices();
  }

  void indices() {
    for (std::uint64_t s = 0; s < states_; ++s) {
      if (a_.choice_begin[s + 1] - a_.choice_begin[s] >= no_action) {
        return misfit(state(s) + ": too many actions");
      }
    }
    for (const std::uint32_t action : a_.action) {
      if (action >= a_.action_names.size()) {
        return misfit(fmt::format("action number {} of {}", action, a_.action_names.size()));
      }
    }
    ascending("array start", a_.start);
    ascending("array terminal", a_.terminal);
    for (const Label& label : a_.labels) ascending("label " + label.name, label.states);
    if (!going_ || !a_.layout) return;
    const std::uint64_t cells = std::uint64_t{a_.layout->rows} * a_.layout->columns;
    for (const std::uint32_t cell : a_.layout->cell) {
      if (cell >= cells) return misfit(fmt::format("layout: cell {} of {}", cell, cells));
    }
  }

  void ascending(const std::string& name, const std::vector<State>& list) {
    for (std::size_t i = 0; i < list.size() && going_; ++i) {
      if (list[i] >= states_) {
        return misfit(fmt::format("{}: state number {} of {}", name, list[i], states_));
      }
      if (i > 0 && list[i - 1] >= list[i]) misfit(name + ": states must ascend");
    }
  }

  void discount() {
    if (!(a_.discount > 0.0 && a_.discount <= 1.0)) {
      fault("discount", "", "discount " + number(a_.discount) + " is outside (0, 1]");
    }
  }

  void rows() {
    constexpr State nobody = no_action;
    std::vector<State> last_user(a_.action_names.size(), nobody);
    for (State s = 0; s < states_; ++s) {
      for (std::uint64_t c = a_.choice_begin[s]; c < a_.choice_begin[s + 1]; ++c) {
        if (last_user[a_.action[c]] == s) choice_fault("action", s, c, "the action stands twice");
        last_user[a_.action[c]] = s;
        if (going_) row(s, c);
        if (!going_) return;
      }
    }
  }

  void row(State s, std::uint64_t c) {
    const std::uint64_t begin = a_.outcome_begin.empty() ? c : a_.outcome_begin[c];
    const std::uint64_t end = a_.outcome_begin.empty() ? c + 1 : a_.outcome_begin[c + 1];
    if (begin == end) return choice_fault("row-sum", s, c, "no outcome");
    double sum = 0.0;
    bool valid = true;
    for (std::uint64_t o = begin; o < end && going_; ++o) {
      if (a_.next[o] >= states_) {
        choice_fault("successor", s, c,
                     fmt::format("successor number {} of {} states", a_.next[o], states_));
      }
      const double p = a_.probability.empty() ? 1.0 : a_.probability[o];
      if (!(p >= 0.0 && p <= 1.0) && going_) {
        valid = false;
        choice_fault("probability", s, c, "probability " + number(p) + " is outside [0, 1]");
      }
      sum += p;
      if (!a_.outcome_reward.empty() && going_) finite(s, c, a_.outcome_reward[o]);
    }
    if (valid && going_ && !(std::fabs(sum - 1.0) <= row_tolerance)) {
      choice_fault("row-sum", s, c, "probabilities sum to " + number(sum) + ", expected 1");
    }
    if (a_.outcome_reward.empty() && going_) finite(s, c, a_.reward[c]);
  }

  void finite(State s, std::uint64_t c, double reward) {
    if (!std::isfinite(reward)) {
      choice_fault("reward", s, c, "reward " + number(reward) + ", expected a finite number");
    }
  }

  void starts() {
    double sum = 0.0;
    bool valid = true;
    for (std::size_t i = 0; i < a_.start_probability.size() && going_; ++i) {
      const double p = a_.start_probability[i];
      sum += p;
      if (p >= 0.0 && p <= 1.0) continue;
      valid = false;
      fault("start", state(a_.start[i]), "start probability " + number(p) + " is outside [0, 1]");
    }
    if (!a_.start_probability.empty() && valid && !(std::fabs(sum - 1.0) <= row_tolerance)) {
      fault("start", "", "start probabilities sum to " + number(sum) + ", expected 1");
    }
    if (!a_.start.empty() || !going_) return;
    std::uint64_t declared = 0;  // declared terminal although it has moves
    std::uint64_t with_moves = 0;
    for (State s = 0; s < states_; ++s) with_moves += a_.choice_begin[s] < a_.choice_begin[s + 1];
    for (const State s : a_.terminal) declared += a_.choice_begin[s] < a_.choice_begin[s + 1];
    if (with_moves == declared) fault("start", "", "no start: every state is an end");
  }

  // Whatever is chosen by name stands under it once.
  void names() {
    std::vector<std::string> labels, structures;
    if (!a_.reward_name.empty()) structures.push_back(a_.reward_name);
    for (const Label& label : a_.labels) labels.push_back(label.name);
    for (const RewardStructure& other : a_.other_rewards) structures.push_back(other.name);
    once("label", std::move(labels));
    once("reward structure", std::move(structures));
  }

  void once(const char* what, std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    for (std::size_t i = 0; i < names.size() && going_; ++i) {
      if (names[i].empty()) fault("name", "", fmt::format("a {} without a name", what));
      if (i == 0 || names[i] != names[i - 1] || !going_) continue;
      fault("name", "", fmt::format("the {} {} stands twice", what, names[i]));
    }
  }

  void rewards(const RewardStructure& other) {
    const std::vector<double>& list =
        other.outcome_reward.empty() ? other.reward : other.outcome_reward;
    const bool per_outcome = !other.outcome_reward.empty();
    for (State s = 0; s < states_; ++s) {
      for (std::uint64_t c = a_.choice_begin[s]; c < a_.choice_begin[s + 1]; ++c) {
        const std::uint64_t begin =
            per_outcome && !a_.outcome_begin.empty() ? a_.outcome_begin[c] : c;
        const std::uint64_t end =
            per_outcome && !a_.outcome_begin.empty() ? a_.outcome_begin[c + 1] : c + 1;
        for (std::uint64_t i = begin; i < end; ++i) {
          if (going_) finite(s, c, list[i]);
        }
      }
    }
  }

  const MdpArrays& a_;
  std::function<bool(const Fault&)> report_;
  std::uint64_t states_ = 0;
  bool going_ = true;
};

std::string sentence(const Fault& fault) {
  return fault.place.empty() ? fault.what : fault.place + ": " + fault.what;
}

}  // namespace

bool first_fault(const MdpArrays& arrays, Error& error) {
  bool found = false;
  Scan(arrays, [&](const Fault& fault) {
    found = true;
    error = Error{"", fault.line, 0, sentence(fault), ""};
    return false;
  }).run();
  return found;
}

std::vector<Finding> check_arrays(const MdpArrays& arrays) {
  std::vector<Finding> findings;
  Scan(arrays, [&](const Fault& fault) {
    for (Finding& finding : findings) {
      if (finding.kind != fault.kind) continue;
      if (finding.names.size() < 10) finding.names.push_back(fault.place);
      ++finding.count;
      return true;
    }
    findings.push_back({Finding::Severity::error, fault.kind, sentence(fault), 1, {}, fault.line});
    if (!fault.place.empty()) findings.back().names.push_back(fault.place);
    return true;
  }).run();
  for (Finding& finding : findings) {
    if (finding.count == 1) continue;
    finding.sentence += fmt::format("; also {}", finding.names.size() > 1 ? "at " : "");
    for (std::size_t i = 1; i < finding.names.size(); ++i) {
      finding.sentence += (i > 1 ? "; " : "") + finding.names[i];
    }
    const std::uint64_t more = finding.count - finding.names.size();
    if (more > 0) finding.sentence += fmt::format(" and {} more", more);
  }
  return findings;
}

}  // namespace quoll
