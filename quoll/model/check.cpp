#include "quoll/model/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "quoll/base/text.hpp"
#include "quoll/model/graph.hpp"

namespace quoll {

namespace {

constexpr std::size_t most_names = 10;

// Adds one finding about `states`: "3 states cannot be reached from the start: A, B, C"; the two
// endings are for one state and for several.
void about_states(std::vector<Finding>& findings, Finding::Severity severity, const char* kind,
                  const Mdp& mdp, const std::vector<State>& states, const char* one,
                  const char* several) {
  if (states.empty()) return;
  Finding finding{severity, kind, "", states.size(), {}, 0};
  for (std::size_t i = 0; i < std::min(states.size(), most_names); ++i) {
    finding.names.push_back(mdp.state_name(states[i]));
  }
  if (states.size() == 1) {
    finding.sentence = "state " + finding.names[0] + " " + one;
  } else {
    finding.sentence = fmt::format("{} states {}: {}", grouped(states.size()), several,
                                   fmt::join(finding.names, ", "));
    if (states.size() > most_names) {
      finding.sentence += fmt::format(" and {} more", grouped(states.size() - most_names));
    }
  }
  findings.push_back(std::move(finding));
}

void undiscounted(std::vector<Finding>& findings, const Mdp& mdp) {
  const UndiscountedFault fault = undiscounted_fault(mdp);
  if (fault.kind == UndiscountedFault::Kind::no_end) {
    about_states(findings, Finding::Severity::error, "no-end", mdp, fault.states,
                 "cannot reach an end, so with discount 1 its value is not defined",
                 "cannot reach an end, so with discount 1 their values are not defined");
  }
  if (fault.kind == UndiscountedFault::Kind::gaining_cycle) {
    about_states(findings, Finding::Severity::error, "gaining-cycle", mdp, fault.states,
                 "can earn for ever, so with discount 1 its value is not defined",
                 "form a cycle that earns for ever, so with discount 1 values are not defined");
  }
  if (fault.kind == UndiscountedFault::Kind::returning) {
    about_states(findings, Finding::Severity::error, "returning", mdp, fault.states,
                 "can come again in this game of two, so with discount 1 its value is not defined",
                 "can come again in this game of two, so with discount 1 their values are not "
                 "defined");
  }
}

// The number of moves to the nearest end from the state farthest from one; without ends, from the
// start to the farthest state.
std::uint32_t longest_path(const Mdp& mdp, const std::vector<std::uint32_t>& from_start,
                           const std::vector<std::uint32_t>& to_end) {
  std::uint32_t longest = 0;
  bool any_end = false;
  for (State s = 0; s < mdp.states(); ++s) any_end = any_end || mdp.terminal(s);
  const std::vector<std::uint32_t>& moves = any_end ? to_end : from_start;
  for (State s = 0; s < mdp.states(); ++s) {
    if (from_start[s] != unreached && moves[s] != unreached) longest = std::max(longest, moves[s]);
  }
  return longest;
}

// A learned table holds floats: below the smallest normal one, digits are lost, and then
// everything.
void underflow(std::vector<Finding>& findings, const Mdp& mdp, std::uint32_t longest) {
  const auto [low, high] = mdp.reward_bounds();
  const double largest = std::max(std::fabs(low), std::fabs(high));
  if (longest < 2 || largest == 0.0) return;
  double left = largest;  // what the reward of the last move counts at the first state
  double power = mdp.discount();
  for (std::uint32_t exponent = longest - 1; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) left *= power;
    power *= power;
  }
  constexpr double smallest = std::numeric_limits<float>::min();
  if (left >= smallest) return;
  findings.push_back(
      {Finding::Severity::warning,
       "underflow",
       fmt::format("discount {} underflows: over the longest of the shortest paths, {} "
                   "moves, a reward of {} counts {:.3g}, below {:.3g}, the smallest "
                   "normal float of a learned table",
                   shortest(mdp.discount()), grouped(longest), shortest(largest), left, smallest),
       1,
       {},
       0});
}

// What readers noticed: outcomes written twice, and whatever else a file says that the model says
// in another way.
void remarks(std::vector<Finding>& findings, const std::vector<std::string>& list) {
  Finding duplicates{Finding::Severity::warning, "duplicate", "", 0, {}, 0};
  Finding others{Finding::Severity::warning, "remark", "", 0, {}, 0};
  for (const std::string& sentence : list) {
    Finding& finding = sentence.ends_with("stands twice") ? duplicates : others;
    if (++finding.count > most_names) continue;
    finding.names.push_back(sentence);
    finding.sentence += (finding.count > 1 ? "; " : "") + sentence;
  }
  for (Finding* finding : {&duplicates, &others}) {
    if (finding->count == 0) continue;
    if (finding->count > most_names) {
      finding->sentence += fmt::format(" and {} more", grouped(finding->count - most_names));
    }
    findings.push_back(std::move(*finding));
  }
}

}  // namespace

std::vector<Finding> check(const Mdp& mdp) {
  std::vector<Finding> findings;
  const std::vector<std::uint32_t> from_start = moves_from(mdp, mdp.start());
  const std::vector<std::uint32_t> to_end = moves_to_end(mdp);

  std::vector<State> not_reached;
  std::vector<State> dead;
  bool any_end = false;
  for (State s = 0; s < mdp.states(); ++s) {
    any_end = any_end || mdp.terminal(s);
    if (from_start[s] == unreached) not_reached.push_back(s);
    if (from_start[s] != unreached && to_end[s] == unreached) dead.push_back(s);
  }
  if (mdp.discount() == 1.0) undiscounted(findings, mdp);
  about_states(findings, Finding::Severity::warning, "unreachable", mdp, not_reached,
               "cannot be reached from the start", "cannot be reached from the start");
  // A world without any end is meant to go on; at discount 1 the same states are an error already.
  if (any_end && mdp.discount() < 1.0) {
    about_states(findings, Finding::Severity::warning, "dead-end", mdp, dead,
                 "is a dead end: no end can be reached from it",
                 "are dead ends: no end can be reached from them");
  }
  remarks(findings, mdp.arrays().remarks);
  underflow(findings, mdp, longest_path(mdp, from_start, to_end));
  return findings;
}

}  // namespace quoll
