// What learn --from-data prints: for people, and as JSON (docs/json.md).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "quoll/base/json.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/learn_log.hpp"
#include "quoll/cli/learn_report.hpp"
#include "quoll/report/bounds_report.hpp"
#include "quoll/report/explain_text.hpp"
#include "quoll/report/table.hpp"

namespace quoll::cli {
namespace {

// What the planner's width leaves of 0 is 0.
std::string value_text(double value) {
  return number_text(std::fabs(value) < Planning().width ? 0.0 : value);
}

const ExperienceCertificate* bounds_of(const LogLearning& learned) {
  return learned.certifier ? &learned.certifier->certificate() : nullptr;
}

std::optional<BoundsReport> report_of(const LogLearning& learned) {
  if (!learned.certifier) return std::nullopt;
  BoundsReport report = bounds_report(*learned.certifier);
  if (learned.named_by_logs) {
    report.assumptions.push_back("these are the states and actions that the log names");
  }
  return report;
}

std::vector<double> q_star_of(const LogLearning& learned) {
  if (!learned.exact) return {};
  return q_star_all(*learned.names, *learned.exact, learned.discount);
}

// The actions of a state, a line each, and its bounds.
void add_state(TextTable& table, const LogLearning& learned, const std::vector<double>& q_star,
               State s) {
  const Mdp& names = *learned.names;
  const ExperienceCertificate* const bounds = bounds_of(learned);
  for (Action a = 0; a < names.actions(s); ++a) {
    const std::uint64_t pair = names.choice_begin(s) + a;
    const std::uint32_t visits = learned.model.tried(pair);
    std::vector<std::string> row{a == 0 ? names.state_name(s) : "", names.action_name(pair)};
    row.push_back(visits > 0 ? value_text(learned.plan.pair_value[pair]) : "");
    row.push_back(q_star.empty() ? "" : number_text(q_star[pair]));
    row.push_back(visits > 0 ? grouped(visits) : "never");
    row.push_back(learned.plan.policy[s] == a ? "<- best" : "");
    if (a == 0 && bounds != nullptr) {
      row.push_back("[" + number_text(bounds->lower[s]) + ", " + number_text(bounds->upper[s]) +
                    "]");
    }
    table.row(std::move(row));
  }
}

std::string table_text(const LogLearning& learned, bool all) {
  constexpr std::uint64_t few_states = 20;
  const Mdp& names = *learned.names;
  const std::vector<double> q_star = q_star_of(learned);
  using Align = TextTable::Align;
  TextTable table({{"state"},
                   {"action"},
                   {"Q", Align::point},
                   {q_star.empty() ? "" : "true Q*", Align::point},
                   {"visits", Align::right},
                   {""},
                   {bounds_of(learned) != nullptr ? "V* of the state in" : ""}});
  std::uint64_t shown = 0, left = 0;
  for (State s = 0; s < names.states(); ++s) {
    if (names.terminal(s) || (learned.named_by_logs && learned.unknown(s))) continue;
    if (!all && shown == few_states) {
      ++left;
      continue;
    }
    ++shown;
    add_state(table, learned, q_star, s);
  }
  std::string text = table.text();
  if (left > 0) {
    text += fmt::format("... and {} more states (use --all or --json --all)\n", grouped(left));
  }
  return text + "\n";
}

std::string counts_text(const LogLearning& learned) {
  const LogCounts counts = counts_of(learned);
  std::string text;
  if (counts.untried > 0) {
    text += fmt::format("Never tried: {} of {} pairs; the policy does not take them.\n",
                        grouped(counts.untried), grouped(counts.pairs));
  } else if (!learned.named_by_logs) {
    text += fmt::format("Each of the {} was tried.\n", counted(counts.pairs, "pair"));
  }
  if (counts.unknown > 0) {
    text += fmt::format("Nothing was tried in {}: worth {} here, the least that is possible.\n",
                        counted(counts.unknown, "state"), number_text(learned.stuck));
  }
  for (const TriedPair& pair : counts.least) {
    text += (text.ends_with(" time") || text.ends_with(" times") ? ", " : "Least tried: ") +
            pair_text(*learned.names, pair.state, pair.action) + " " + counted(pair.visits, "time");
  }
  text += "\n";
  if (learned.misfits > 0) {
    text += fmt::format(
        "{} of {} cannot happen in {}: is this the world of the log? The counts are taken as they "
        "are.\n",
        grouped(learned.misfits), counted(learned.steps, "step"), learned.world.name);
  }
  return text;
}

// As the first word of a sentence; other letters than a to z stay.
std::string capitalised(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') {
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  }
  return text;
}

std::string bounds_text(const LogLearning& learned) {
  if (!learned.rewards) {
    const RewardRange& seen = learned.seen;
    return fmt::format(
        "No bounds on values: {} declares none, and what the log shows, {} to {}, is no proof that "
        "there is nothing beyond; --reward-range LOW,HIGH says so.\n",
        learned.named_by_logs ? "a log" : learned.world.name, number_text(seen.low()),
        number_text(seen.high()));
  }
  const std::optional<BoundsReport> report = report_of(learned);
  if (!report) return "No bounds on values: " + learned.no_bounds + ".\n";
  const State widest = learned.certifier->certificate().widest;
  const std::string certainty =
      capitalised(certainty_text(*report)) + (report->confidence ? "" : ",");
  return fmt::format("{} the optimal value of {} lies in [{}, {}].\n", certainty,
                     learned.names->state_name(widest), number_text(report->lower),
                     number_text(report->upper)) +
         assumed_text(*report);
}

std::string verdict_text(const LogLearning& learned) {
  if (!learned.optimality) {
    return learned.named_by_logs ? "" : "No verdict: " + learned.no_exact + ".\n";
  }
  const Optimality& judged = *learned.optimality;
  const char* const word = !judged.optimal ? "not decided" : *judged.optimal ? "yes" : "no";
  std::string text = fmt::format("Policy optimal: {} ({}).", word, judged.proof);
  if (judged.optimal != true) {
    text += fmt::format(" Regret at most {} at {}.", number_text(judged.regret),
                        learned.names->state_name(judged.worst));
  }
  return text + "\n";
}

double start_value(const LogLearning& learned) {
  const Mdp& names = *learned.names;
  double value = 0.0;
  for (std::uint64_t i = 0; i < names.start().size(); ++i) {
    value += names.start_probability(i) * learned.plan.state_value[names.start()[i]];
  }
  return value;
}

void write_q(JsonWriter& json, const LogLearning& learned, bool all) {
  const Mdp& names = *learned.names;
  const std::vector<double> q_star = q_star_of(learned);
  std::vector<TriedPair> pairs;
  for (State s = 0; s < names.states(); ++s) {
    if (names.terminal(s) || (learned.named_by_logs && learned.unknown(s))) continue;
    for (Action a = 0; a < names.actions(s); ++a) {
      pairs.push_back({s, a, learned.model.tried(names.choice_begin(s) + a)});
    }
  }
  json.rows("q", pairs.size(), all, [&](std::uint64_t i) {
    const TriedPair& row = pairs[i];
    const std::uint64_t pair = names.choice_begin(row.state) + row.action;
    json.begin_object().member("state", names.state_name(row.state));
    json.member("action", names.action_name(pair));
    std::optional<double> q, mean, best;
    if (row.visits > 0) q = learned.plan.pair_value[pair];
    if (row.visits > 0) mean = learned.mean_reward(pair);
    if (!q_star.empty()) best = q_star[pair];
    json.member("q", q);
    json.member("visits", row.visits);
    json.member("mean_reward", mean);
    json.member("q_star", best);
    json.end_object();
  });
}

void write_values(JsonWriter& json, const LogLearning& learned, bool all) {
  const Mdp& names = *learned.names;
  const ExperienceCertificate* const bounds = bounds_of(learned);
  json.rows("policy", names.states(), all, [&](std::uint64_t i) {
    const auto s = static_cast<State>(i);
    json.begin_object().member("state", names.state_name(s));
    if (learned.plan.policy[s] == no_action)
      json.null_member("action");
    else
      json.member("action", names.action_name(names.choice_begin(s) + learned.plan.policy[s]));
    json.member("value", learned.plan.state_value[s]);
    std::optional<double> lower, upper;
    if (bounds != nullptr) {
      lower = bounds->lower[s];
      upper = bounds->upper[s];
    }
    json.member("lower", lower);
    json.member("upper", upper);
    json.end_object();
  });
}

void write_verdict(JsonWriter& json, const LogLearning& learned) {
  const std::optional<Optimality>& judged = learned.optimality;
  json.member("optimal", judged ? judged->optimal : std::nullopt);
  json.member("proof", judged ? std::optional(judged->proof) : std::nullopt);
  json.member("regret", judged ? std::optional(judged->regret) : std::nullopt);
  json.member("unreachable", judged ? std::optional(judged->unreachable) : std::nullopt);
}

}  // namespace

std::string log_text(const LogLearning& learned, const std::vector<std::string>& logs,
                     const std::string& world, bool all) {
  std::string from = logs.front();
  if (logs.size() > 1) from += fmt::format(" and {} more", logs.size() - 1);
  std::string text =
      fmt::format("learn {}from {}   counted model, discount {}\n",
                  world.empty() ? "" : world + " ", from, shortest(learned.discount));
  text += fmt::format("{}, {} ended, {} cut off\n\n", counted(learned.steps, "step"),
                      counted(learned.ended, "episode"), grouped(learned.cut));
  text += table_text(learned, all) + counts_text(learned);
  text += fmt::format("Start value by the counts: {}\n", value_text(start_value(learned)));
  text += bounds_text(learned) + verdict_text(learned);
  return text;
}

std::string log_json(const LogLearning& learned, const std::vector<std::string>& logs, bool all) {
  const LogCounts counts = counts_of(learned);
  JsonWriter json(JsonStyle::pretty);
  json.begin_object();
  json.member("world", learned.named_by_logs ? std::nullopt : std::optional(learned.world.name));
  json.key("data").begin_array();
  for (const std::string& log : logs) json.value(log);
  json.end_array();
  json.member("discount", learned.discount).member("steps", learned.steps);
  json.member("episodes", learned.ended + learned.cut).member("ended", learned.ended);
  json.member("pairs", counts.pairs).member("never_tried", counts.untried);
  json.member("unknown_states", counts.unknown).member("misfits", learned.misfits);
  json.key("rewards").begin_object();
  const RewardRange& range = learned.rewards ? *learned.rewards : learned.seen;
  json.member("low", range.low()).member("high", range.high());
  json.member("known", learned.rewards.has_value()).end_object();
  json.key("least_tried").begin_array();
  for (const TriedPair& pair : counts.least) {
    json.begin_object().member("state", learned.names->state_name(pair.state));
    json.member("action",
                learned.names->action_name(learned.names->choice_begin(pair.state) + pair.action));
    json.member("visits", pair.visits).end_object();
  }
  json.end_array();
  write_q(json, learned, all);
  write_values(json, learned, all);
  json.member("start", start_value(learned));
  write_verdict(json, learned);
  write_bounds(json, report_of(learned));
  json.end_object();
  return json.text() + "\n";
}

}  // namespace quoll::cli
