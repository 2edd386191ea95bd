// explain --state: the exact values of one state, each sum written out, and the best way on.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "quoll/base/json.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/explain.hpp"
#include "quoll/cli/judged_run.hpp"
#include "quoll/cli/learn_report.hpp"
#include "quoll/cli/policy_file.hpp"
#include "quoll/cli/same_world.hpp"
#include "quoll/report/explain_text.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll::cli {
namespace {

constexpr std::size_t longest_way = 20;  // moves written out
constexpr std::size_t most_terms = 10;   // of a sum

struct StateAnswer {
  const Mdp* mdp = nullptr;
  State state = 0;
  double discount = 1.0;
  Solution exact;
  std::vector<double> value;   // per state: middle of the interval
  std::vector<double> q_star;  // per choice
  std::vector<Action> best;    // of the state
  std::optional<Estimates> learned;
  std::string learned_from;
};

// The moves of the returned policy from a state to an end, or until a state comes again.
struct Way {
  std::vector<std::uint64_t> choices;
  std::vector<State> states;  // one more than choices
  bool ends = false, repeats = false;
};

Way way_on(const StateAnswer& answer) {
  const Mdp& mdp = *answer.mdp;
  Way way;
  std::vector<bool> seen(mdp.states());
  State s = answer.state;
  way.states.push_back(s);
  while (!mdp.terminal(s)) {
    const Action action = answer.exact.policy[s];
    if (seen[s] || action == no_action) {
      way.repeats = true;
      return way;
    }
    seen[s] = true;
    way.choices.push_back(mdp.choice_begin(s) + action);
    s = mdp.next(mdp.outcome_begin(way.choices.back()));
    way.states.push_back(s);
  }
  way.ends = true;
  return way;
}

// "0 + 0.8 * 0 + 0.8^2 * 100", or at discount 1, where only how often counts, "13 * (-1) + 9".
std::string sum_text(const std::vector<double>& rewards, double discount) {
  std::string sum;
  if (discount == 1.0) {
    std::size_t terms = 0;
    for (std::size_t i = 0; i < rewards.size();) {
      if (++terms > most_terms) return sum + " + ...";
      std::size_t end = i;
      while (end < rewards.size() && rewards[end] == rewards[i]) ++end;
      sum += (i > 0 ? " + " : "") + (end - i > 1 ? grouped(end - i) + " * " : "") +
             factor_text(rewards[i]);
      i = end;
    }
    return sum;
  }
  for (std::size_t i = 0; i < rewards.size() && i < most_terms; ++i) {
    if (i == 0) {
      sum = number_text(rewards[0]);
    } else {
      sum += fmt::format(" + {}{} * {}", number_text(discount),
                         i > 1 ? "^" + std::to_string(i) : "", factor_text(rewards[i]));
    }
  }
  return rewards.size() > most_terms ? sum + " + ..." : sum;
}

std::string way_text(const StateAnswer& answer) {
  const Mdp& mdp = *answer.mdp;
  if (!mdp.deterministic() || mdp.terminal(answer.state)) return "";
  const Way way = way_on(answer);
  const std::size_t shown = std::min(way.choices.size(), longest_way);
  std::string path = mdp.state_name(way.states[0]);
  std::vector<double> rewards;
  double total = 0.0, weight = 1.0, side = 1.0;  // what the other player gets counts against
  for (std::size_t i = 0; i < way.choices.size(); ++i) {
    const double reward = side * mdp.reward(way.choices[i]) + 0.0;
    side = mdp.carry(side);
    rewards.push_back(reward);
    total += weight * reward;
    weight *= answer.discount;
    if (i >= shown) continue;
    path += fmt::format(" -{}-> {}", mdp.action_name(way.choices[i]),
                        mdp.state_name(way.states[i + 1]));
  }
  if (way.choices.size() > shown) {
    path += fmt::format(" ... {} more moves to {}", grouped(way.choices.size() - shown),
                        mdp.state_name(way.states.back()));
  }
  std::string text = "The way on:  " + path + (way.repeats ? ", and so on for ever" : "") + "\n";
  if (way.repeats) return text;
  return text + "which earns  " + sum_text(rewards, answer.discount) + " = " + number_text(total) +
         "\n";
}

// "0 + 0.8 * 100 [CAVE]", or the mean over the outcomes.
std::string sum_text(const StateAnswer& answer, std::uint64_t choice) {
  const Mdp& mdp = *answer.mdp;
  const std::uint64_t first = mdp.outcome_begin(choice), end = mdp.outcome_end(choice);
  std::string text;
  for (std::uint64_t o = first; o < end; ++o) {
    const double value = mdp.terminal(mdp.next(o)) ? 0.0 : answer.value[mdp.next(o)];
    const std::string one = fmt::format("{} + {} * {} [{}]", number_text(mdp.reward(choice, o)),
                                        factor_text(mdp.carry(answer.discount)), factor_text(value),
                                        mdp.state_name(mdp.next(o)));
    if (end - first == 1) return one;
    text +=
        fmt::format("{}{} * ({})", o > first ? " + " : "", number_text(mdp.probability(o)), one);
  }
  return text;
}

std::string value_text(const StateAnswer& answer) {
  const double lower = answer.exact.lower[answer.state], upper = answer.exact.upper[answer.state];
  const std::string from = number_text(lower), to = number_text(upper);
  return from == to ? from : "in [" + from + ", " + to + "]";
}

bool is_best(const StateAnswer& answer, Action action) {
  return std::find(answer.best.begin(), answer.best.end(), action) != answer.best.end();
}

std::string q_words(const Mdp& mdp) {
  const std::string sum = mdp.alternating() ? "reward - discount * V*" : "reward + discount * V*";
  std::string words =
      mdp.deterministic() ? sum + " of the next state" : "mean over its outcomes of " + sum;
  if (mdp.alternating()) words += ", where the other player is to move";
  return words;
}

std::string text_of_answer(const StateAnswer& answer, const World& world) {
  const Mdp& mdp = *answer.mdp;
  const std::string name = mdp.state_name(answer.state);
  std::string text = fmt::format("explain {}   state {}, discount {}\n\n", world.name, name,
                                 number_text(answer.discount));
  if (mdp.terminal(answer.state)) {
    return text + name + " is an end: nothing is earned after it, V* = 0.\n";
  }
  text += fmt::format("V*({}) = {}: the best of its moves; of each, Q* = {}\n", name,
                      value_text(answer), q_words(mdp));
  std::vector<TextTable::Column> columns{{"move"}, {"sum"}, {"Q*", TextTable::Align::point}, {""}};
  if (answer.learned) {
    columns.insert(columns.begin() + 3, {"learned Q", TextTable::Align::point});
    columns.insert(columns.begin() + 4, {"visits", TextTable::Align::right});
  }
  TextTable table(std::move(columns));
  for (Action a = 0; a < mdp.actions(answer.state); ++a) {
    const std::uint64_t c = mdp.choice_begin(answer.state) + a;
    std::vector<std::string> row{mdp.action_name(c), sum_text(answer, c),
                                 number_text(answer.q_star[c])};
    if (answer.learned) {
      row.push_back(number_text(answer.learned->q[c]));
      row.push_back(grouped(answer.learned->visits[c]));
    }
    row.emplace_back(!is_best(answer, a)      ? ""
                     : answer.best.size() > 1 ? "<- equally good"
                                              : "<- best");
    table.row(std::move(row));
  }
  text += table.text();
  if (answer.best.size() > 1) {
    text += "A tie: ";
    for (std::size_t i = 0; i < answer.best.size(); ++i) {
      text += (i == 0                        ? ""
               : i + 1 == answer.best.size() ? " and "
                                             : ", ") +
              mdp.action_name(mdp.choice_begin(answer.state) + answer.best[i]);
    }
    text += " are worth the same; either is optimal.\n";
  }
  const std::string way = way_text(answer);
  if (!way.empty()) text += "\n" + way;
  if (answer.learned) text += "\nLearned Q: " + answer.learned_from + ".\n";
  return text;
}

std::string json_of_answer(const StateAnswer& answer, const World& world) {
  const Mdp& mdp = *answer.mdp;
  JsonWriter json(JsonStyle::pretty);
  json.begin_object().member("world", world.name);
  json.member("state", mdp.state_name(answer.state)).member("discount", answer.discount);
  json.member("lower", answer.exact.lower[answer.state]);
  json.member("upper", answer.exact.upper[answer.state]);
  json.key("actions").begin_array();
  for (Action a = 0; !mdp.terminal(answer.state) && a < mdp.actions(answer.state); ++a) {
    const std::uint64_t c = mdp.choice_begin(answer.state) + a;
    json.begin_object().member("action", mdp.action_name(c)).member("q_star", answer.q_star[c]);
    json.member("optimal", is_best(answer, a));
    if (answer.learned) {
      json.key("q").number(answer.learned->q[c], answer.learned->single_precision);
      json.member("visits", answer.learned->visits[c]);
    }
    json.key("outcomes").begin_array();
    for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
      json.begin_object().member("next", mdp.state_name(mdp.next(o)));
      json.member("probability", mdp.probability(o)).member("reward", mdp.reward(c, o));
      json.member("value", mdp.terminal(mdp.next(o)) ? 0.0 : answer.value[mdp.next(o)]);
      json.end_object();
    }
    json.end_array().end_object();
  }
  json.end_array();
  json.key("way").begin_array();
  if (mdp.deterministic()) {
    const Way way = way_on(answer);
    for (const State s : way.states) json.value(mdp.state_name(s));
  }
  json.end_array().end_object();
  return json.text() + "\n";
}

Result<void> add_run(StateAnswer& answer, const World& world, const std::string& file,
                     double discount_asked) {
  const Result<Run> run = Run::load(run_file(file));
  if (!run) return run.error();
  const Result<void> same = check_same_world(*run, file, world);
  if (!same) return same.error();
  if (discount_asked > 0.0 && discount_asked != run->discount()) {
    return Error{
        "--discount", 0, 0,
        "the saved run has " + shortest(run->discount()) + ", not " + shortest(discount_asked), ""};
  }
  const Training& first = run->trainings().front();
  answer.learned = first.learner().estimates();
  answer.discount = run->discount();
  answer.learned_from = fmt::format("{}, seed {}, after {} steps", rule_words(run->entry()),
                                    first.seed(), grouped(first.learner().progress().steps));
  return {};
}

}  // namespace

Exit explain_state(const World& world, const StateQuestion& question, const OutputOption& output) {
  const Mdp& mdp = *world.mdp;
  StateAnswer answer;
  answer.mdp = &mdp;
  const Result<State> state = parse_state(world, question.state, "--state");
  if (!state) return fail(state.error());
  answer.state = *state;
  answer.discount = question.discount > 0.0 ? question.discount : world.discount;
  if (!question.run.empty()) {
    const Result<void> added = add_run(answer, world, question.run, question.discount);
    if (!added) return fail(added.error());
  }
  SolveSettings settings;
  settings.discount = answer.discount;
  settings.width = 1e-9;
  Result<Solution> exact = solve(mdp, settings);
  if (!exact) return fail(exact.error());
  answer.exact = std::move(*exact);
  answer.value.resize(mdp.states());
  for (State s = 0; s < mdp.states(); ++s) {
    const double lower = answer.exact.lower[s], upper = answer.exact.upper[s];
    answer.value[s] = lower == upper ? lower : 0.5 * (lower + upper);
  }
  answer.q_star = q_star_all(mdp, answer.exact, answer.discount);
  answer.best = optimal_actions(mdp, answer.exact, answer.state);
  const std::string text =
      output.json ? json_of_answer(answer, world) : text_of_answer(answer, world);
  return print(text) ? done : user_error;
}

}  // namespace quoll::cli
