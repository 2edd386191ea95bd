// Models as CSV worlds that read_csv() takes back with every index and every bit.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/fields.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/mentions.hpp"

namespace quoll {
namespace {

// The actions in order of first use, as a reader meets them.
bool actions_in_order(const Mdp& mdp) {
  std::uint64_t met = 0;
  for (const std::uint32_t action : mdp.arrays().action) {
    if (action > met) return false;
    if (action == met) ++met;
  }
  return met == mdp.arrays().action_names.size();
}

// Uniform over all states that are not ends: what a file without a start line means.
bool start_as_default(const Mdp& mdp) {
  if (!mdp.arrays().start_probability.empty()) return false;
  std::size_t at = 0;
  for (std::uint64_t s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(static_cast<State>(s))) continue;
    if (at == mdp.start().size() || mdp.start()[at] != s) return false;
    ++at;
  }
  return at == mdp.start().size();
}

void write_properties(const Mdp& mdp, std::string& out) {
  out += "# discount = " + shortest(mdp.discount()) + "\n";
  if (mdp.alternating()) out += "# alternating = true\n";
  if (!start_as_default(mdp)) {
    MentionWriter start(out, "start");
    const bool weighted = !mdp.arrays().start_probability.empty();
    for (std::size_t i = 0; i < mdp.start().size(); ++i) {
      const std::string name = mdp.state_name(mdp.start()[i]);
      if (weighted) {
        start.add(name, mdp.start_probability(i));
      } else {
        start.add(name);
      }
    }
    start.end();
  }
  MentionWriter terminal(out, "terminal");
  for (const State s : mdp.arrays().terminal) terminal.add(mdp.state_name(s));
  terminal.end();
  if (!actions_in_order(mdp)) {
    MentionWriter actions(out, "actions");
    for (std::uint64_t i = 0; i < mdp.arrays().action_names.size(); ++i) {
      actions.add(mdp.arrays().action_names[i]);
    }
    actions.end();
  }
}

}  // namespace

Result<std::string> write_csv(const Mdp& mdp) {
  const Result<void> proper = proper_names(mdp);
  if (!proper) return proper.error();
  std::string out;
  write_properties(mdp, out);
  out += "state,action,next_state,probability,reward\n";
  std::vector<std::string> actions;
  for (std::uint64_t i = 0; i < mdp.arrays().action_names.size(); ++i) {
    actions.push_back(as_field(mdp.arrays().action_names[i]));
  }
  for (std::uint64_t i = 0; i < mdp.states(); ++i) {
    const auto s = static_cast<State>(i);
    const std::string name = as_field(mdp.state_name(s));
    if (mdp.actions(s) == 0) out += name + ",,,,\n";
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      const std::string choice = name + "," + actions[mdp.arrays().action[c]] + ",";
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        out += choice;
        out += as_field(mdp.state_name(mdp.next(o)));
        out += ',';
        out += shortest(mdp.probability(o));
        out += ',';
        out += shortest(mdp.reward(c, o));
        out += '\n';
      }
    }
  }
  return out;
}

}  // namespace quoll
