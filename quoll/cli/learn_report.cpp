#include "quoll/cli/learn_report.hpp"
#include "quoll/cli/evaluate_sample.hpp"
#include "quoll/cli/learn_certificate.hpp"
#include "quoll/cli/learn_heading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "quoll/base/text.hpp"
#include "quoll/cli/explain.hpp"
#include "quoll/cli/judged_run.hpp"
#include "quoll/cli/seeds_curve.hpp"
#include "quoll/model/graph.hpp"
#include "quoll/report/curve.hpp"
#include "quoll/report/explain_text.hpp"
#include "quoll/report/grid_text.hpp"
#include "quoll/report/progress.hpp"

namespace quoll::cli {

std::vector<double> q_star_all(const Mdp& mdp, const Solution& exact, double discount) {
  std::vector<double> middle(mdp.states());
  for (State s = 0; s < mdp.states(); ++s) {
    middle[s] =
        exact.lower[s] == exact.upper[s] ? exact.lower[s] : 0.5 * (exact.lower[s] + exact.upper[s]);
  }
  std::vector<double> q(mdp.choices());
  for (State s = 0; s < mdp.states(); ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      q[c] = mdp.terminal(s) ? 0.0 : q_star(mdp, middle, c, discount);
    }
  }
  return q;
}

namespace {

// "stable after 213 steps": and what that means.
std::string stop_sentence(const Run& run, const SeedResult& seed, const LearnStory& story) {
  const std::string after =
      fmt::format(" after {}, {}, {}", counted(seed.steps, "step"),
                  counted(seed.episodes, "episode"), duration_text(seed.seconds));
  const Result<LearnSetup> setup = resolve(run.settings().learn, run.world());
  switch (seed.stop) {
    case Stop::stable: {
      const bool proved = setup && run.entry().sound && run.world().traits.deterministic &&
                          setup->stable.visits == 1 && setup->stable.tolerance == 0.0 &&
                          run.world().mdp;
      if (!run.entry().sound) return "stable" + after + ": the printed rule changes nothing more";
      return "stable" + after +
             (proved ? ": proved, Q is the fixed point of its update" : ": stable, not proved") +
             (run.world().mdp ? "" : "; over the states met so far");
    }
    case Stop::certified:
      return "certified" + after;
    case Stop::reached:
      return fmt::format(
          "reached after {}, {}, {} of the processor: the last {} training episodes returned {} on "
          "average, as asked",
          counted(seed.reached->steps, "step"), counted(seed.reached->episodes, "episode"),
          duration_text(seed.reached->processor_seconds), ReturnWatch::window,
          number_text(seed.reached->mean));
    case Stop::diverged:
      return "stopped" + after + ": the values have left every bound";
    case Stop::budget:
      return (run.entry().traits.approximates    ? "not reached"
              : run.settings().certified.empty() ? "not stable"
                                                 : "not certified") +
             after + ": the budget is used up";
    case Stop::interrupted:
      return "interrupted" + after;
    default:
      if (missed_stable(seed, story)) return "not stable" + after;
      return "stopped" + after + (story.bounded ? " as asked" : ", as without a limit");
  }
}

std::string impossible_text(const Run& run, const Impossible& impossible) {
  if (!impossible.found || !run.world().mdp) return "";
  const std::string where = pair_text(*run.world().mdp, impossible.state, impossible.action);
  if (impossible.bound > 0.0) {
    return fmt::format(
        "Impossible value: at step {} Q{} = {}, but no policy can earn more than {} here (largest "
        "reward / (1 - discount)).\nSuch a value estimates nothing.\n",
        grouped(impossible.step), where, number_text(impossible.value),
        number_text(impossible.bound));
  }
  return fmt::format("Diverged: at step {} Q{} = {}.\n", grouped(impossible.step), where,
                     shortest(impossible.value));
}

std::string least_visited_text(const Run& run, const RunResult& result, const LearnStory& story) {
  const std::vector<PairVisits> pairs = least_visited(run, result, story);
  if (pairs.empty()) return "";
  std::string text;
  for (const PairVisits& pair : pairs) {
    text += fmt::format("{}{} {}", text.empty() ? "Least visited: " : ", ",
                        pair_text(*run.world().mdp, pair.state, pair.action),
                        counted(pair.visits, "time"));
  }
  return text + "\n";
}

std::string verdict(const Run& run, const RunResult& result, const SeedResult& seed) {
  if (!run.entry().sound) {
    return "No verdict: the rule " + run.settings().learn.rule +
           " exists to be studied; its policy is neither certified nor exported.\n";
  }
  if (!seed.optimality) return "No certificate: " + result.no_exact + ".\n";
  const Optimality& judged = *seed.optimality;
  std::string text = "Policy optimal: ";
  text += !judged.optimal ? "not decided" : *judged.optimal ? "yes" : "no";
  text += " (" + judged.proof + ").";
  if (judged.optimal != true && run.world().mdp) {
    text += fmt::format(" Regret at most {} at {}.", number_text(judged.regret),
                        run.world().mdp->state_name(judged.worst));
  }
  if (judged.optimal != true) {
    text += fmt::format(" {:.2f} % of {} states have an optimal action.",
                        100.0 * static_cast<double>(seed.optimal_states) /
                            static_cast<double>(std::max<std::uint64_t>(1, seed.judged_states)),
                        grouped(seed.judged_states));
  }
  if (judged.unreachable > 0) {
    text += fmt::format(" {} states cannot be reached from the start and are left out.",
                        grouped(judged.unreachable));
  }
  return text + "\n";
}

// What is told of a seed besides its steps and its return: the exact verdict where a model is
// known, the moment its return was reached where that was asked for, the mean of the last training
// episodes of methods without a table.
std::string seeds_rows(const Run& run, const RunResult& result, const LearnStory& story) {
  const bool model = run.world().mdp != nullptr, sound = run.entry().sound;
  using Align = TextTable::Align;
  std::vector<TextTable::Column> columns{{"seed"}, {"steps", Align::right}, {"stop"}};
  if (story.until_return) {
    columns.insert(columns.end(), {{"reached at", Align::right}, {"processor", Align::right}});
  }
  if (model) columns.insert(columns.end(), {{"optimal"}, {"regret", Align::point}});
  const bool training = run.entry().traits.approximates;
  if (training) columns.push_back({"in training", Align::point});
  const bool played = run.settings().evaluation_episodes > 0;
  if (played) {
    columns.insert(columns.end(), {{"mean return", Align::point}, {"ended", Align::right}});
  }
  TextTable table(std::move(columns));
  for (const SeedResult& seed : result.seeds) {
    std::vector<std::string> row{std::to_string(seed.seed), grouped(seed.steps),
                                 std::string(stop_name(seed.stop))};
    if (story.until_return) {
      row.push_back(seed.reached ? grouped(seed.reached->steps) : "-");
      row.push_back(seed.reached ? fmt::format("{:.2f} s", seed.reached->processor_seconds) : "-");
    }
    if (model) {
      const bool decided = seed.optimality && seed.optimality->optimal;
      row.push_back(!sound ? "-" : !decided ? "?" : *seed.optimality->optimal ? "yes" : "no");
      row.push_back(seed.optimality ? number_text(seed.optimality->regret) : "");
    }
    if (training) row.push_back(seed.training_return ? number_text(*seed.training_return) : "-");
    if (seed.played.episodes > 0) {
      row.push_back(number_text(seed.played.mean));
      row.push_back(fmt::format("{:.0f} %", 100 * seed.played.ended));
    } else if (played) {
      row.insert(row.end(), 2, "-");
    }
    table.row(std::move(row));
  }
  return table.text();
}

// "Reached by 29 of 30 seeds: ...".
std::string reached_line(const RunResult& result) {
  std::vector<double> steps, seconds;
  std::size_t known = 0;
  for (const SeedResult& seed : result.seeds) {
    known += seed.reached || seed.stop != Stop::interrupted;
    if (!seed.reached) continue;
    steps.push_back(static_cast<double>(seed.reached->steps));
    seconds.push_back(seed.reached->processor_seconds);
  }
  std::string text = fmt::format("reached by {} of {} seeds", steps.size(), known);
  if (known < result.seeds.size()) text += ", besides those interrupted before";
  if (steps.empty()) return text + "\n";
  return text + fmt::format(", in the median of these after {} steps and {:.2f} s of a processor\n",
                            grouped(static_cast<std::uint64_t>(statistics(steps).median)),
                            statistics(seconds).median);
}

// That somebody stopped the greedy episodes.
std::string cut_short_line(const Run& run, const RunResult& result) {
  if (result.cut_short == 0) return "";
  if (result.seeds.size() > 1) {
    return fmt::format("Interrupted while greedy episodes were played, in {} of {}.\n",
                       result.cut_short, counted(result.seeds.size(), "seed"));
  }
  return fmt::format("Interrupted after {} of {} greedy episodes.\n",
                     grouped(result.seeds.front().played.episodes),
                     grouped(run.settings().evaluation_episodes));
}

// What the greedy policies of the seeds earned.
std::string statistics_lines(const Run& run, const RunResult& result) {
  const Statistics& s = result.statistics;
  std::string text;
  if (result.counted < result.seeds.size()) {
    const bool ended =
        std::any_of(result.seeds.begin(), result.seeds.end(), [&](const SeedResult& seed) {
          return seed.stop != Stop::interrupted &&
                 seed.played.episodes == run.settings().evaluation_episodes;
        });
    text += fmt::format("of the {} {}: ", counted(result.counted, "seed"),
                        ended ? "not interrupted" : "begun");
  }
  text += fmt::format("mean {}, median {}, interquartile mean {}, smallest {}", number_text(s.mean),
                      number_text(s.median), number_text(s.iqm), number_text(s.minimum));
  if (s.lower) {
    text += fmt::format(", 95 % interval of the mean [{}, {}]", number_text(*s.lower),
                        number_text(*s.upper));
  }
  text += "\n";
  if (result.solved) {
    text += fmt::format("solved (mean return of at least {}): {} of {} seeds\n",
                        number_text(*run.world().traits.solved), *result.solved, result.counted);
  }
  return text;
}

std::string seeds_table(const Run& run, const RunResult& result, const LearnStory& story) {
  std::string text = seeds_rows(run, result, story);
  if (run.settings().evaluation_episodes > 0 && result.counted > 0)
    text += statistics_lines(run, result);
  text += cut_short_line(run, result);
  return story.until_return ? text + reached_line(result) : text;
}

std::string curve_line(const Run& run, const TerminalStyle& style) {
  const std::vector<Training>& seeds = run.trainings();
  std::vector<double> values;
  if (seeds.size() > 1) {
    for (const CurvePoint& point : curve_over_seeds(run).points) values.push_back(point.value);
  } else {
    for (const LearningCurve::Bin& bin : seeds.front().curve().bins()) {
      if (bin.episodes > 0) values.push_back(bin.mean());
    }
  }
  if (values.size() < 2) return "";
  return fmt::format("return  {}  {} -> {}\n", sparkline(values, 50, style.unicode),
                     number_text(values.front()), number_text(values.back()));
}

std::string next_steps(const Run& run) {
  if (!run.world().mdp || !run.entry().sound) return "";
  const std::string& name = run.source().name;
  const bool table = !run.entry().traits.approximates;  // explain shows updates of tables
  return fmt::format("Next: {2}quoll solve {0} | quoll show {0} -o {1}.svg\n", name,
                     run.world().name, table ? "quoll explain " + name + " | " : "");
}

// The rule as-printed and the standard rule, where they part.
std::string printed_text(const Run& run, const LearnStory& story) {
  if (run.settings().learn.rule != "as-printed") return "";
  std::string text;
  if (!story.coming) text += as_printed_banner(run.settings().learn.initial_rewards == "zero");
  if (!run.world().mdp || !story.beside) return text;
  if (story.beside->q.empty()) {
    return text + fmt::format(
                      "The standard rule stands beside it in runs of at most {} steps from their "
                      "beginning; see also quoll explain {} --rule as-printed.\n",
                      grouped(json_complete_rows), run.source().name);
  }
  if (!story.beside->printed) return text + "The standard rule gives the same values here.\n";
  const Update& printed = *story.beside->printed;
  return text + fmt::format("First difference: step {}, QE{} = {}; the standard rule has {}.\n",
                            grouped(printed.step),
                            pair_text(*run.world().mdp, printed.state, printed.action),
                            number_text(printed.new_value),
                            number_text(story.beside->standard->new_value));
}

// What the first seed learned: a grid where there is one, else the table.
std::string learned_text(const Run& run, const RunResult& result, const TerminalStyle& style,
                         const LearnStory& story) {
  const Mdp& mdp = *run.world().mdp;
  const std::vector<Action>& policy = result.seeds.front().policy;
  const Estimates estimates = run.trainings().front().learner().estimates();
  if (mdp.layout() && mdp.states() > 20) {
    std::vector<double> value(mdp.states(), 0.0);
    for (State s = 0; s < mdp.states(); ++s) {
      if (policy[s] != no_action) value[s] = estimates.q[mdp.choice_begin(s) + policy[s]];
    }
    const auto grid = grid_policy_text({&mdp, value, policy, {}, "learned policy"}, style);
    return grid ? *grid + "\n" : "";
  }
  const std::vector<double> q_star =
      result.exact ? q_star_all(mdp, *result.exact, run.discount()) : std::vector<double>();
  QTableView view;
  view.mdp = &mdp;
  view.q = estimates.q;
  view.q_is_float = estimates.single_precision;
  view.q_star = q_star;
  view.visits = estimates.visits;
  view.policy = policy;
  if (!run.entry().sound) view.q_title = "QE";
  if (story.beside && !story.beside->q.empty()) {
    view.more.push_back({"standard", story.beside->q});
    if (const auto& first = story.beside->printed) {
      view.marked = mdp.choice_begin(first->state) + first->action;
      view.mark = fmt::format("<- first difference, step {}", grouped(first->step));
    }
  }
  if (!estimates.reward_estimate.empty()) view.more.push_back({"rE", estimates.reward_estimate});
  view.states = story.all ? 0 : 20;
  return q_table(view) + "\n";
}

}  // namespace

bool missed_stable(const SeedResult& seed, const LearnStory& story) {
  return (seed.stop == Stop::budget && !seed.certificate && !story.until_return) ||
         (story.until_stable &&
          (seed.stop == Stop::steps || seed.stop == Stop::episodes || seed.stop == Stop::time));
}

std::vector<PairVisits> least_visited(const Run& run, const RunResult& result,
                                      const LearnStory& story) {
  std::size_t seed = 0;
  while (seed < result.seeds.size() && !missed_stable(result.seeds[seed], story)) ++seed;
  const Result<LearnSetup> setup = resolve(run.settings().learn, run.world());
  if (seed == result.seeds.size() || !run.world().mdp || !setup) return {};
  const Mdp& mdp = *run.world().mdp;
  const Estimates estimates = run.trainings()[seed].learner().estimates();
  const std::vector<bool> reached = reachable(mdp, setup->starts.states());
  std::vector<PairVisits> pairs;
  for (State s = 0; s < mdp.states(); ++s) {
    if (!reached[s] || mdp.terminal(s)) continue;
    for (Action a = 0; a < mdp.actions(s); ++a) {
      pairs.push_back({estimates.visits[mdp.choice_begin(s) + a], s, a});
    }
  }
  const std::size_t shown = std::min<std::size_t>(10, pairs.size());
  std::partial_sort(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(shown), pairs.end(),
                    [](const PairVisits& left, const PairVisits& right) {
                      return std::tie(left.visits, left.state, left.action) <
                             std::tie(right.visits, right.state, right.action);
                    });
  pairs.resize(shown);
  return pairs;
}

std::string learn_text(const Run& run, const RunResult& result, const TerminalStyle& style,
                       const LearnStory& story) {
  const SeedResult& first = result.seeds.front();
  std::string text = learn_heading(run);
  if (run.choice()) {
    text += "Chosen: " + run.choice()->options() + "; " + run.choice()->reason + ".\n";
  }
  if (result.seeds.size() > 1) {
    text += "\n" + printed_text(run, story) + seeds_table(run, result, story) + unchanged_line(run);
    if (!run.world().mdp) text += curve_line(run, style);
    text += least_visited_text(run, result, story);
    if (!run.entry().sound) text += verdict(run, result, first);
    return text + next_steps(run);
  }
  text += stop_sentence(run, first, story) + "\n\n";
  const std::string printed = printed_text(run, story);
  if (!printed.empty()) text += printed + "\n";
  if (run.world().mdp && no_table(run).empty()) text += learned_text(run, result, style, story);
  text += least_visited_text(run, result, story);
  text += impossible_text(run, first.impossible);
  text += experience_text(run, result);
  text += verdict(run, result, first);
  text += unchanged_line(run) + curve_line(run, style);
  if (first.played.episodes > 0) {
    text += fmt::format("greedy policy: mean return {} over {}, {:.0f} % reach an end\n",
                        number_text(first.played.mean), counted(first.played.episodes, "episode"),
                        100 * first.played.ended);
    if (result.solved) {
      text +=
          fmt::format("solved: {} (a mean return of at least {})\n",
                      *result.solved > 0 ? "yes" : "no", number_text(*run.world().traits.solved));
    }
    text += unknown_text(first.played);
  }
  text += cut_short_line(run, result);
  return text + next_steps(run);
}

}  // namespace quoll::cli
