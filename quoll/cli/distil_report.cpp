// What a distilled network still knows: counted, measured, certified.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "quoll/base/json.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/distil.hpp"
#include "quoll/cli/network_words.hpp"
#include "quoll/env/listed.hpp"
#include "quoll/learn/deep/distil.hpp"
#include "quoll/report/table.hpp"

namespace quoll::cli {
namespace {

// Per state, whether the action that a network prefers is right; nothing where nothing is known.
std::vector<std::optional<bool>> rightness(const Lesson& lesson, const Estimates& learned,
                                           const std::optional<Solution>& exact) {
  std::vector<std::optional<bool>> right = agreement(lesson.table, learned);
  if (!exact) return right;
  const std::vector<Action> policy = greedy_policy(learned);
  const TiedActions tied(*lesson.world.mdp, *exact);
  for (State s = 0; s < right.size(); ++s) {
    if (!right[s]) continue;
    const std::vector<Action> best = tied.of(s);
    right[s] = std::find(best.begin(), best.end(), policy[s]) != best.end();
  }
  return right;
}

DistilledSeed judged(const Lesson& lesson, const Mdp& names, const Learner& learner,
                     const std::optional<Solution>& exact) {
  DistilledSeed seed;
  const Estimates learned = learner.estimates();
  const std::vector<std::optional<bool>> right = rightness(lesson, learned, exact);
  const std::vector<std::uint8_t>& kept = withheld(learner);
  std::uint64_t pairs = 0;
  double sum = 0.0;
  for (State s = 0; s < right.size(); ++s) {
    if (!right[s]) continue;
    Right& of = kept[s] != 0 ? seed.withheld : seed.taught;
    ++of.states;
    of.right += *right[s];
    for (std::uint64_t c = learned.row_begin[s]; c < learned.row_begin[s + 1]; ++c) {
      if (lesson.table.visits[c] == 0) continue;
      const double error = std::fabs(learned.q[c] - lesson.table.q[c]);
      sum += error;
      ++pairs;
      if (pairs > 1 && !(error > seed.largest_error)) continue;
      seed.largest_error = error;
      seed.worst_pair = names.state_name(s) + ", " +
                        names.action_name(names.choice_begin(s) + (c - learned.row_begin[s]));
    }
  }
  if (pairs > 0) seed.mean_error = sum / static_cast<double>(pairs);
  return seed;
}

std::string share_text(const Right& of) {
  if (of.states == 0) return "-";
  const double share = 100.0 * static_cast<double>(of.right) / static_cast<double>(of.states);
  return fmt::format("{} of {} ({:.2f} %)", grouped(of.right), grouped(of.states), share);
}

std::string_view layout_of(const Run& run) {
  return layout_names[static_cast<std::size_t>(run.settings().learn.deep.layout)];
}

std::string table_of(const Distilled& of, bool exact, bool withholds) {
  using Align = TextTable::Align;
  std::vector<TextTable::Column> columns{{"seed", Align::right}, {"updates", Align::right}};
  columns.push_back({exact ? "optimal action" : "action as the table's"});
  if (withholds) columns.push_back({"of states not taught"});
  columns.push_back({"largest error", Align::point});
  columns.push_back({"mean error", Align::point});
  if (exact) {
    columns.push_back({"regret at start", Align::point});
    columns.push_back({"worst regret", Align::point});
  }
  TextTable table(std::move(columns));
  for (std::size_t i = 0; i < of.seeds.size(); ++i) {
    const DistilledSeed& seed = of.seeds[i];
    const SeedResult& result = of.result.seeds[i];
    if (result.steps == 0 && result.stop == Stop::interrupted) continue;
    std::vector<std::string> row{std::to_string(result.seed), grouped(result.steps)};
    row.push_back(share_text(seed.taught));
    if (withholds) row.push_back(share_text(seed.withheld));
    row.push_back(number_text(seed.largest_error));
    row.push_back(number_text(seed.mean_error));
    if (exact) {
      row.push_back(number_text(result.optimality->start_regret));
      row.push_back(number_text(result.optimality->regret));
    }
    table.row(std::move(row));
  }
  return table.text();
}

// How many seeds did not come to their end.
std::string shortfall(const Distilled& of) {
  const auto ended = [&](Stop how) {
    return std::count_if(of.result.seeds.begin(), of.result.seeds.end(),
                         [&](const SeedResult& seed) { return seed.stop == how; });
  };
  const std::string all = counted(of.result.seeds.size(), "seed");
  std::string text;
  if (const auto stopped = ended(Stop::interrupted); stopped > 0) {
    text = fmt::format("Interrupted: {} of {}.\n\n", stopped, all);
  }
  const bool wanted = of.run.settings().learn.until_stable;
  if (const auto missed = ended(Stop::budget) + ended(Stop::steps); wanted && missed > 0) {
    text +=
        "Not reached" +
        (of.result.seeds.size() > 1 ? fmt::format(" by {} of {}", missed, all) : std::string()) +
        ": every action right, and a mean error of at most 2 % of the largest value.\n\n";
  }
  return text;
}

std::string verdict(const Distilled& of, const Optimality& judged) {
  const Mdp& mdp = *of.lesson.world.mdp;
  const std::string_view answer = !judged.optimal ? "not decided" : *judged.optimal ? "yes" : "no";
  std::string text = fmt::format("Policy optimal: {} ({}).\n", answer, judged.proof);
  if (!std::isfinite(judged.regret)) return text + "What it can lose has no bound.\n";
  return text + fmt::format("Certified: no state that can be reached loses more than {}{}.\n",
                            number_text(judged.regret),
                            judged.regret > 0.0 ? " (" + mdp.state_name(judged.worst) + ")" : "");
}

}  // namespace

Result<Distilled> judge_distilled(const Run& run, const Lesson& lesson) {
  const Result<std::shared_ptr<const Mdp>> names = listed(lesson.world);
  if (!names) return names.error();
  Distilled of{run, lesson, run.result(true), run.trainings().front().learner().network(), {}};
  for (const Training& training : run.trainings()) {
    of.seeds.push_back(judged(lesson, **names, training.learner(), of.result.exact));
  }
  return of;
}

std::string distilled_text(const Distilled& of) {
  std::uint64_t states = 0;
  for (const Right* right : {&of.seeds[0].taught, &of.seeds[0].withheld}) states += right->states;
  const bool exact = of.result.exact.has_value();
  std::string text = fmt::format("distil {}   {}, {}, discount {}\n{}\n\n", of.lesson.world.name,
                                 of.lesson.origin, counted(states, "state"),
                                 shortest(of.lesson.discount), network_words(*of.network));
  text += table_of(of, exact, of.seeds[0].withheld.states > 0) + "\n" + shortfall(of);
  text +=
      fmt::format("Largest error of Q{}: {} at {}.\n", of.seeds.size() > 1 ? " (first seed)" : "",
                  number_text(of.seeds[0].largest_error), of.seeds[0].worst_pair);
  if (!exact) return text + "No certificate: " + of.result.no_exact + ".\n";
  return of.seeds.size() > 1 ? text : text + verdict(of, *of.result.seeds[0].optimality);
}

std::string distilled_json(const Distilled& of) {
  JsonWriter json(JsonStyle::pretty);
  json.begin_object().member("world", of.lesson.world.name).member("table", of.lesson.origin);
  json.member("discount", of.lesson.discount).member("layout", layout_of(of.run));
  json.member("inputs", of.network->network.input.size());
  json.member("numbers", numbers_of(of.network->network));
  json.key("runs").begin_array();
  for (std::size_t i = 0; i < of.seeds.size(); ++i) {
    const DistilledSeed& seed = of.seeds[i];
    const SeedResult& result = of.result.seeds[i];
    json.begin_object().member("seed", result.seed).member("updates", result.steps);
    json.member("stop", stop_name(result.stop)).member("seconds", result.processor_seconds);
    json.member("states", seed.taught.states).member("right", seed.taught.right);
    json.member("withheld_states", seed.withheld.states);
    json.member("withheld_right", seed.withheld.right);
    json.member("largest_error", seed.largest_error).member("mean_error", seed.mean_error);
    const bool exact = result.optimality.has_value();
    if (exact && result.optimality->optimal) {
      json.member("optimal", *result.optimality->optimal);
    } else {
      json.null_member("optimal");
    }
    if (exact) {
      json.member("proof", result.optimality->proof);
      json.member("start_regret", result.optimality->start_regret);
      json.member("regret", result.optimality->regret);
      json.member("worst", of.lesson.world.mdp->state_name(result.optimality->worst));
    } else {
      json.null_member("proof").null_member("start_regret").null_member("regret");
      json.null_member("worst");
    }
    json.end_object();
  }
  json.end_array().end_object();
  return json.text() + "\n";
}

}  // namespace quoll::cli
