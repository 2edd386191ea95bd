#include "quoll/cli/learn_explain.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "quoll/base/archive.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/explain.hpp"
#include "quoll/report/explain_text.hpp"

namespace quoll::cli {
namespace {

constexpr std::size_t lines_unasked = 1000;

// A second learner that stands exactly where the first one stands.
Result<std::unique_ptr<Learner>> copy_of(Learner& learner, const Run& run) {
  Archive saved;
  learner.persist(saved);
  Result<std::unique_ptr<Learner>> copy = make_learner(run.settings().learn, run.world());
  if (!copy) return copy;
  Archive loaded{std::span<const std::byte>(saved.bytes())};
  (*copy)->persist(loaded);
  if (!loaded.good()) return loaded.error();
  return copy;
}

bool whole_steps(const Run& run) {
  const Result<LearnSetup> setup = resolve(run.settings().learn, run.world());
  return setup && setup->step_size.one();
}

std::size_t most_updates(const Run& run, const RunSettings& limits, bool all) {
  if (all) return ~std::size_t{0};
  if (limits.steps > 0 || limits.episodes > 0) return json_complete_rows;
  if (run.settings().learn.rule == "as-printed") return lines_unasked;
  return lines_unasked / (whole_steps(run) ? 2 : 3);
}

// Steps that cannot overshoot a limit: an episode takes at least one.
std::uint64_t chunk(const RunSettings& limits, const LearnProgress& now, std::uint64_t budget,
                    std::uint64_t room) {
  std::uint64_t steps = std::min<std::uint64_t>(room, 4096);
  const auto left = [&](std::uint64_t limit, std::uint64_t reached) {
    steps = std::min(steps, limit - std::min(limit, reached));
  };
  if (limits.steps > 0) left(limits.steps, now.steps);
  if (limits.episodes > 0) left(limits.episodes, now.episodes);
  if (limits.steps == 0 && limits.episodes == 0) left(budget, now.steps);
  return steps;
}

}  // namespace

Result<ComingUpdates> coming_updates(Run& run, const RunSettings& limits, bool all) {
  if (!run.world().mdp) {
    return Error{"--explain", 0, 0, "the model of " + run.world().name + " is not known", ""};
  }
  if (run.entry().traits.approximates) {
    return Error{"--explain", 0, 0,
                 "shows the updates of a table; " + run.settings().learn.method + " keeps none",
                 ""};
  }
  Learner& first = run.trainings().front().learner();
  Result<std::unique_ptr<Learner>> copy = copy_of(first, run);
  if (!copy) return copy.error();
  ComingUpdates coming;
  coming.before = first.progress();
  coming.table = first.estimates();
  const std::size_t most = most_updates(run, limits, all);
  LearnProgress now = coming.before;
  while (now.halt == LearnProgress::Halt::none) {
    const std::uint64_t left = chunk(limits, now, default_budget(run.world()), 4096);
    const std::uint64_t steps = std::min<std::uint64_t>(left, most - coming.updates.size());
    coming.more = left > 0;
    if (steps == 0) break;
    now = advance_told(**copy, run.entry(), steps, coming);
    coming.more = false;
  }
  if (run.settings().learn.rule == "as-printed" && coming.before.steps == 0) {
    Result<std::vector<Update>> standard =
        standard_beside(run.settings().learn, run.world(), coming.updates);
    if (!standard) return standard.error();
    coming.standard = std::move(*standard);
  }
  return coming;
}

Result<std::unique_ptr<Learner>> first_twin(Run& run) {
  Learner& first = run.trainings().front().learner();
  if (run.settings().learn.rule != "as-printed" || !run.world().mdp || first.progress().steps > 0) {
    return std::unique_ptr<Learner>();
  }
  return copy_of(first, run);
}

Result<StandardBeside> standard_beside(const Run& run, Learner* twin) {
  const std::uint64_t steps = run.trainings().front().learner().progress().steps;
  StandardBeside beside;
  if (twin == nullptr || steps > json_complete_rows) return beside;
  std::vector<Update> log(steps);
  if (steps > 0) log.resize(twin->advance(steps, log).logged);
  const Result<std::vector<Update>> standard =
      standard_beside(run.settings().learn, run.world(), log);
  if (!standard) return standard.error();
  const Mdp& mdp = *run.world().mdp;
  beside.q.assign(mdp.choices(), 0.0);
  for (const Update& update : *standard) {
    beside.q[mdp.choice_begin(update.state) + update.action] = update.new_value;
  }
  if (const auto first = first_difference({&mdp, log, *standard})) {
    beside.printed = log[*first];
    beside.standard = (*standard)[*first];
  }
  return beside;
}

namespace {

UpdateTeller teller_of(const Run& run, const ComingUpdates& coming) {
  return UpdateTeller(*run.world().mdp, coming.table.q, run.discount(), own_words(run.entry()),
                      coming.table.visits);
}

std::string one_column(const Run& run, const ComingUpdates& coming) {
  const Mdp& mdp = *run.world().mdp;
  const std::vector<Update> seen = observed(mdp, coming.updates);
  UpdateTeller teller = teller_of(run, coming);
  std::uint64_t episode = coming.before.episodes, steps = 0;
  double sum = 0.0;
  bool begins = true, whole = coming.before.steps == 0;
  std::string text;
  for (std::size_t i = 0; i < coming.updates.size(); ++i) {
    const Update& update = coming.updates[i];
    if (begins) {
      text += fmt::format("episode {} {} {}\n", grouped(++episode),
                          whole ? "begins at" : "goes on at", mdp.state_name(update.state));
      steps = 0;
      sum = 0.0;
    }
    text += teller.tell(update, coming.beside(i));
    ++steps;
    sum += seen[i].reward;
    begins = update.terminated || update.truncated;
    if (!begins) continue;
    text +=
        fmt::format("episode {} {} {} after {}{}\n", grouped(episode),
                    update.terminated ? "ends at" : "is cut off at", mdp.state_name(update.next),
                    counted(steps, "step"), whole ? ", return " + number_text(sum) : "");
    whole = true;
  }
  return text;
}

}  // namespace

std::string updates_text(const Run& run, const ComingUpdates& coming) {
  std::string text;
  if (run.trainings().size() > 1) {
    text += fmt::format("The updates of seed {}:\n", run.trainings().front().seed());
  }
  if (run.settings().learn.rule == "as-printed") {
    const bool zero = run.settings().learn.initial_rewards == "zero";
    text += as_printed_banner(zero);
  }
  if (coming.standard.empty()) {
    text += one_column(run, coming);
  } else {
    const RuleComparison both{run.world().mdp.get(), coming.updates, coming.standard,
                              run.discount(), true};
    if (const auto first = first_difference(both)) {
      text += fmt::format("Watch step {}.\n", grouped(coming.updates[*first].step));
    }
    text += "\n" + comparison_text(both);
  }
  if (coming.more) {
    text += fmt::format(
        "... the first {} updates; --steps N or --episodes N for so many, --all for all\n",
        grouped(coming.updates.size()));
  }
  return text + "\n";
}

void write_updates(JsonWriter& json, const Run& run, const ComingUpdates& coming, bool all) {
  UpdateTeller teller = teller_of(run, coming);
  json.rows("updates", coming.updates.size(), all, [&](std::uint64_t i) {
    teller.write(
        json, coming.updates[i], coming.table.single_precision,
        coming.standard.empty() ? std::nullopt : std::optional(coming.standard[i].new_value),
        coming.beside(i));
  });
}

}  // namespace quoll::cli
