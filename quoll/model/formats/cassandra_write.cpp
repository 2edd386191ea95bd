// Models in Cassandra's format: one line per outcome. Every state has every action there: one that
// is none of the state's does what its first one does. Ends stay where they are, and names of
// another kind than the format's become numbers. A .pomdp observes the state itself.

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

// A letter first, then letters, digits, '_' and '-'; and no word of the format's own.
bool plain(std::string_view name) {
  constexpr std::string_view own[] = {"include",      "exclude",  "uniform", "identity", "reward",
                                      "cost",         "discount", "values",  "states",   "actions",
                                      "observations", "start",    "T",       "O",        "R"};
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto fits = [&](char c) {
    return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !name.empty() && letter(name.front()) && std::all_of(name.begin(), name.end(), fits) &&
         std::find(std::begin(own), std::end(own), name) == std::end(own);
}

// What a list of names is written as: the names, or their number.
std::vector<std::string> written_names(const Names& names, std::string& list) {
  std::vector<std::string> written;
  bool all = true;
  for (std::uint64_t i = 0; all && i < names.size(); ++i) {
    written.push_back(names[i]);
    all = plain(written.back());
  }
  list.clear();
  if (all) {
    for (const std::string& name : written) list += " " + name;
    return written;
  }
  written.clear();
  for (std::uint64_t i = 0; i < names.size(); ++i) written.push_back(std::to_string(i));
  list = " " + std::to_string(names.size());
  return written;
}

struct Outcome {
  State next;
  double probability, reward;
};

// The outcomes of a choice, those with one successor as one.
std::vector<Outcome> joined(const Mdp& mdp, std::uint64_t c) {
  std::vector<Outcome> all;
  for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
    all.push_back({mdp.next(o), mdp.probability(o), mdp.reward(c, o)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Outcome& a, const Outcome& b) { return a.next < b.next; });
  std::vector<Outcome> out;
  for (const Outcome& outcome : all) {
    if (out.empty() || out.back().next != outcome.next) {
      out.push_back(outcome);
      continue;
    }
    Outcome& sum = out.back();
    const double probability = sum.probability + outcome.probability;
    if (sum.reward != outcome.reward) {
      sum.reward =
          (sum.probability * sum.reward + outcome.probability * outcome.reward) / probability;
    }
    sum.probability = probability;
  }
  return out;
}

void write_start(std::string& out, const Mdp& mdp, const std::vector<std::string>& states) {
  const MdpArrays& a = mdp.arrays();
  if (a.start.size() == 1) {
    out += "start: " + states[a.start[0]] + "\n";
  } else if (a.start_probability.empty()) {
    out += "start include:";
    for (const State s : a.start) out += " " + states[s];
    out += "\n";
  } else {
    std::vector<double> chance(mdp.states(), 0.0);
    for (std::size_t i = 0; i < a.start.size(); ++i) chance[a.start[i]] = a.start_probability[i];
    out += "start:";
    for (const double value : chance) out += " " + shortest(value);
    out += "\n";
  }
}

void write_choice(std::string& out, const Mdp& mdp, std::uint64_t c, const std::string& action,
                  const std::vector<std::string>& states, std::uint64_t s, bool observed) {
  const std::vector<Outcome> outcomes = joined(mdp, c);
  const std::string place = action + " : " + states[s] + " : ";
  const char* const end = observed ? " : * " : " ";
  const auto differs = [&](const Outcome& o) { return o.reward != outcomes.front().reward; };
  const bool varies = std::any_of(outcomes.begin(), outcomes.end(), differs);
  if (!varies && outcomes.front().reward != 0.0) {
    out += "R: " + place + "*" + end + shortest(outcomes.front().reward) + "\n";
  }
  for (const Outcome& outcome : outcomes) {
    out += "T: " + place + states[outcome.next] + " " + shortest(outcome.probability) + "\n";
    if (varies) out += "R: " + place + states[outcome.next] + end + shortest(outcome.reward) + "\n";
  }
}

// The choice of a state by an action; its first one if it has none such.
std::uint64_t choice_by(const Mdp& mdp, State s, std::uint64_t action) {
  for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
    if (mdp.arrays().action[c] == action) return c;
  }
  return mdp.choice_begin(s);
}

Result<std::string> write(const Mdp& mdp, bool observed) {
  if (mdp.alternating()) return Error{"", 0, 0, "this format holds no model of two players", ""};
  std::string list;
  const std::vector<std::string> actions = written_names(mdp.arrays().action_names, list);
  std::string out = "discount: " + shortest(mdp.discount()) + "\nvalues: reward\nactions:" + list;
  const std::vector<std::string> states = written_names(mdp.arrays().state_names, list);
  out += "\nstates:" + list + "\n";
  if (observed) out += "observations:" + list + "\n";
  write_start(out, mdp, states);
  for (std::uint64_t i = 0; i < mdp.states(); ++i) {
    const auto s = static_cast<State>(i);
    if (mdp.terminal(s)) out += "T: * : " + states[i] + " : " + states[i] + " 1\n";
    for (std::uint64_t a = 0; !mdp.terminal(s) && a < actions.size(); ++a) {
      write_choice(out, mdp, choice_by(mdp, s, a), actions[a], states, i, observed);
    }
    if (observed) out += "O: * : " + states[i] + " : " + states[i] + " 1\n";
  }
  return out;
}

}  // namespace

Result<std::string> write_cassandra_mdp(const Mdp& mdp) {
  return write(mdp, false);
}

Result<std::string> write_cassandra_pomdp(const Mdp& mdp) {
  return write(mdp, true);
}

}  // namespace quoll
