// Models as JSON that read_gymnasium() takes back with every index and every
// bit.

#include <cstdint>

#include "quoll/base/json.hpp"
#include "quoll/base/text.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/numbered.hpp"

namespace quoll {
namespace {

// The names of a list of states, as a JSON list or, with weights, as an object.
void write_states(std::string& out, const Mdp& mdp, const std::vector<State>& states,
                  const std::vector<double>& weights = {}) {
  out += weights.empty() ? '[' : '{';
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (i > 0) out += ',';
    out += json_string(mdp.state_name(states[i]));
    if (!weights.empty()) out += ":" + shortest(weights[i]);
  }
  out += weights.empty() ? ']' : '}';
}

void write_frame(std::string& out, const Mdp& mdp) {
  const MdpArrays& a = mdp.arrays();
  out += "{\"discount\":" + shortest(mdp.discount());
  if (mdp.alternating()) out += ",\n\"alternating\":true";
  if (!a.reward_name.empty()) out += ",\n\"reward\":" + json_string(a.reward_name);
  out += ",\n\"actions\":[";
  for (std::uint64_t i = 0; i < a.action_names.size(); ++i) {
    out += (i > 0 ? "," : "") + json_string(a.action_names[i]);
  }
  out += "],\n\"start\":";
  write_states(out, mdp, a.start, a.start_probability);
  out += ",\n\"terminal\":";
  write_states(out, mdp, a.terminal);
  if (!a.labels.empty()) {
    out += ",\n\"labels\":{";
    for (const Label& label : a.labels) {
      out += (&label == &a.labels.front() ? "" : ",\n") + json_string(label.name) + ":";
      write_states(out, mdp, label.states);
    }
    out += '}';
  }
  out += ",\n\"P\":";
}

}  // namespace

Result<std::string> write_gymnasium(const Mdp& mdp) {
  const Result<void> proper = proper_names(mdp);
  if (!proper) return proper.error();
  std::string out;
  write_frame(out, mdp);
  // Numbers as Gymnasium has them, if that is what the states are called.
  const bool plain = states_are_numbered(mdp);
  for (std::uint64_t i = 0; i < mdp.states(); ++i) {
    const auto s = static_cast<State>(i);
    out += (i == 0 ? "{\n" : ",\n") + json_string(mdp.state_name(s)) + ":{";
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      out += (c == mdp.choice_begin(s) ? "" : ",") + json_string(mdp.action_name(c)) + ":[";
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        const State next = mdp.next(o);
        out += (o == mdp.outcome_begin(c) ? "[" : ",[") + shortest(mdp.probability(o)) + "," +
               (plain ? std::to_string(next) : json_string(mdp.state_name(next))) + "," +
               shortest(mdp.reward(c, o)) + (mdp.terminal(next) ? ",true]" : ",false]");
      }
      out += ']';
    }
    out += '}';
  }
  return out + "\n}}\n";
}

}  // namespace quoll
