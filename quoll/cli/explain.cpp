// quoll explain WORLD: updates and states with their numbers.

#include "quoll/cli/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "quoll/base/json.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/initial_rewards.hpp"
#include "quoll/cli/judged_run.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/experiment/config.hpp"
#include "quoll/report/explain_text.hpp"

namespace quoll::cli {
namespace {

// The trace of the lecture's slides.
constexpr std::string_view lecture_trace = "HALL:To-CAVE, CAVE:To-GOAL, HALL:To-CAVE";
constexpr std::size_t most_revisits = 50;
constexpr std::uint64_t most_steps = 65536;

struct ExplainOptions {
  WorldOption world;
  OutputOption output;
  GivenSettings how;
  std::string state, run;
  std::optional<std::string> trace, steps_text;
  std::uint64_t steps = 0;  // 0 = not given
};

// What is explained: a way to learn, and the updates it made.
struct Lesson : ToldUpdates {
  LearnSettings settings;
  LearnSetup setup;
  const LearnerEntry* entry = nullptr;
  std::string origin;            // where the transitions come from, one sentence
  bool own = false;              // the updates are a learner's own, not a replay
  std::vector<Update> standard;  // the standard rule beside it; empty for the standard rule itself
  UpdateWords words() const { return own ? own_words(*entry) : UpdateWords::of(settings.rule); }
  bool printed() const { return settings.rule == "as-printed"; }
  bool all_zero() const {
    return printed() && std::all_of(setup.initial_rewards.begin(), setup.initial_rewards.end(),
                                    [](double r) { return r == 0.0; });
  }
  bool impossible(const Update& update) const {
    return setup.value_bound > 0.0 &&
           std::fabs(update.new_value) > setup.value_bound * (1.0 + 1e-5);
  }
};

// The rule as printed goes wrong when a pair is visited again: the last move is repeated until its
// value is above what anybody can earn, or does not move any more.
void continue_trace(Lesson& lesson, std::vector<Update>& script) {
  double before = lesson.updates.back().new_value;
  for (std::size_t more = 1; more <= most_revisits; ++more) {
    if (lesson.impossible(lesson.updates.back())) return;
    Update again = script.back();
    again.step = script.size() + 1;
    script.push_back(again);
    lesson.updates = lesson.entry->replay(lesson.setup, script);
    const double now = lesson.updates.back().new_value;
    if (more >= 3 && now == before) return;
    before = now;
  }
}

// The first episode of a run, or the steps asked for.
void own_updates(Lesson& lesson, std::uint64_t steps) {
  lesson.own = true;
  const std::unique_ptr<Learner> learner = lesson.entry->make(lesson.setup);
  advance_told(*learner, *lesson.entry, steps > 0 ? steps : 10, lesson);
  if (steps == 0) {
    const auto end =
        std::find_if(lesson.updates.begin(), lesson.updates.end(),
                     [](const Update& update) { return update.terminated || update.truncated; });
    if (end != lesson.updates.end()) lesson.updates.erase(end + 1, lesson.updates.end());
  }
  lesson.origin = fmt::format(
      "The first {} of a run, seed {}, actions {}, starts {}:",
      lesson.updates.size() == 1 ? "step" : std::to_string(lesson.updates.size()) + " steps",
      lesson.settings.seed, lesson.setup.exploration.name(), lesson.settings.start);
}

Result<Lesson> lesson_of(const ExplainOptions& options, const World& world) {
  Lesson lesson;
  lesson.settings.until_stable = false;
  const Result<void> applied = options.how.apply(settings_of(lesson.settings));
  if (!applied) return applied.error();
  const Result<const LearnerEntry*> entry = find_offered(lesson.settings);
  if (!entry) return entry.error();
  lesson.entry = *entry;
  if (lesson.entry->traits.approximates) {
    return Error{"--method", 0, 0,
                 "explain shows the updates of a table; " + lesson.settings.method + " keeps none",
                 ""};
  }
  const Result<std::vector<double>> rewards =
      initial_rewards(lesson.settings.initial_rewards, world);
  if (!rewards) return rewards.error();
  const Result<LearnSetup> setup = resolve(lesson.settings, world, *rewards);
  if (!setup) return setup.error();
  lesson.setup = *setup;

  if (options.trace && lesson.entry->replay == nullptr) {
    return Error{"--trace", 0, 0,
                 "an update of " + lesson.settings.method +
                     " depends on more than its own step: --steps N shows those of a run",
                 "--steps"};
  }
  const bool lecture = !options.trace && options.steps == 0 && world.name == "adventure" &&
                       lesson.entry->replay != nullptr && parse_trace(world, lecture_trace);
  if (!lecture && !options.trace) {
    own_updates(lesson, options.steps);
  } else {
    Result<std::vector<Update>> script =
        parse_trace(world, lecture ? lecture_trace : std::string_view(*options.trace));
    if (!script) return script.error();
    lesson.updates = lesson.entry->replay(lesson.setup, *script);
    lesson.origin = lecture ? "The lecture's trace:" : "The trace given:";
    if (lecture && lesson.printed()) {
      continue_trace(lesson, *script);
      lesson.origin = "The lecture's trace, and on from there with its last move again and again:";
    }
  }
  if (lesson.printed()) {
    Result<std::vector<Update>> standard = standard_beside(lesson.settings, world, lesson.updates);
    if (!standard) return standard.error();
    lesson.standard = std::move(*standard);
  }
  return lesson;
}

std::vector<double> first_table(const Lesson& lesson, const Mdp& mdp) {
  std::vector<double> q(mdp.choices(), lesson.setup.initial_value);
  for (State s = 0; s < mdp.states(); ++s) {
    if (!mdp.terminal(s)) continue;
    std::fill(q.begin() + static_cast<std::ptrdiff_t>(mdp.choice_begin(s)),
              q.begin() + static_cast<std::ptrdiff_t>(mdp.choice_end(s)), 0.0);
  }
  return q;
}

std::string heading(const Lesson& lesson, const World& world) {
  const std::string rule = lesson.entry->rule.empty() ? "" : ", rule " + lesson.settings.rule;
  return fmt::format("explain {}   {}{}, discount {}, step size {}, every {} = {} at first\n",
                     world.name, lesson.settings.method, rule, number_text(lesson.setup.discount),
                     lesson.setup.step_size.text(), lesson.words().q,
                     number_text(lesson.setup.initial_value));
}

std::string rule_text(const Lesson& lesson, const Mdp& mdp) {
  if (lesson.entry->replay == nullptr) {
    return std::string(lesson.entry->formula) +
           (mdp.alternating() ? "\nThe turn passes: what follows counts negative.\n" : "\n");
  }
  const char* const sign = mdp.alternating() ? "-" : "+";  // the next move is the other player's
  if (lesson.settings.rule == "reward-estimate") {
    return fmt::format(
        "QE(s,a) := rE(s,a) {} discount * max QE(s',.), rE = the mean of the rewards observed for "
        "(s,a)\n",
        sign);
  }
  if (lesson.setup.step_size.one()) {
    return fmt::format("Q(s,a) := r {} discount * max Q(s',.)\n", sign);
  }
  return fmt::format("Q(s,a) := Q(s,a) + step size * (r {} discount * max Q(s',.) - Q(s,a))\n",
                     sign);
}

// Why a value above the bound estimates nothing; empty when none is.
std::string proof_text(const Lesson& lesson, const Mdp& mdp) {
  const double bound = lesson.setup.value_bound;
  if (!(bound > 0.0)) return "";
  const auto found = std::find_if(lesson.updates.begin(), lesson.updates.end(),
                                  [&](const Update& u) { return lesson.impossible(u); });
  if (found == lesson.updates.end()) return "";
  const double discount = lesson.setup.discount;
  const std::string text = fmt::format(
      "The proof that this is no value: a reward is at most {} and the future counts {} per step, "
      "so\n"
      "nobody can ever earn more than {} / (1 - {}) = {}.",
      number_text(bound * (1.0 - discount)), number_text(discount),
      number_text(bound * (1.0 - discount)), number_text(discount), number_text(bound));
  const auto visits = std::count_if(lesson.updates.begin(), found + 1, [&](const Update& u) {
    return u.state == found->state && u.action == found->action && u.best_next != 0.0;
  });
  return text + fmt::format(" Step {} gives {}: visit {} of {} that sees a future.\n", found->step,
                            number_text(found->new_value), visits,
                            pair_text(mdp, found->state, found->action));
}

std::string zero_text(const Lesson& lesson) {
  std::string text = fmt::format(
      "Every rE and every QE is 0, so each update is 0 + {} * 0 = 0, for ever: nothing is ever "
      "learned.\n",
      number_text(lesson.setup.discount));
  const auto earned = std::find_if(lesson.standard.begin(), lesson.standard.end(),
                                   [](const Update& u) { return u.reward != 0.0; });
  if (earned != lesson.standard.end()) {
    text += fmt::format("Step {} earned {}; the rule as printed has not even looked at it.\n",
                        earned->step, number_text(earned->reward));
  }
  return text;
}

std::string q_text(const Lesson& lesson, const Mdp& mdp, const UpdateTeller& teller, bool all) {
  QTableView view;
  view.mdp = &mdp;
  view.q = teller.q();
  view.q_is_float = !lesson.printed() && lesson.setup.precision == Precision::single;
  view.visits = teller.visits();
  view.q_title = std::string(UpdateWords::of(lesson.settings.rule).q);
  view.states = all ? 0 : 20;
  view.rest = "use --all";
  std::vector<double> reward, standard;
  if (lesson.printed()) {
    reward = lesson.setup.initial_rewards;
    reward.resize(mdp.choices());
    standard.resize(mdp.choices());
    for (std::uint64_t c = 0; c < mdp.choices(); ++c) {
      if (teller.visits()[c] > 0) reward[c] = teller.q()[c];
    }
    for (const Update& update : lesson.standard) {
      standard[mdp.choice_begin(update.state) + update.action] = update.new_value;
    }
    view.more = {{"rE", reward}, {"standard Q", standard}};
    const auto first = first_difference({&mdp, lesson.updates, lesson.standard});
    if (first) {
      const Update& update = lesson.updates[*first];
      view.marked = mdp.choice_begin(update.state) + update.action;
      view.mark = "<- the first to differ";
    }
  }
  return q_table(view);
}

std::string lesson_text(const Lesson& lesson, const World& world, bool all) {
  const Mdp& mdp = *world.mdp;
  UpdateTeller teller(mdp, first_table(lesson, mdp), lesson.setup.discount, lesson.words());
  std::string text = heading(lesson, world), told;
  for (std::size_t i = 0; i < lesson.updates.size(); ++i) {
    told += teller.tell(lesson.updates[i], lesson.beside(i));
  }
  if (!lesson.printed()) {
    text += rule_text(lesson, mdp) + "\n" + lesson.origin + "\n" + told;
    return text + "\n" + q_text(lesson, mdp, teller, all);
  }
  const RuleComparison both{&mdp, lesson.updates, lesson.standard, lesson.setup.discount,
                            lesson.own};
  text += fmt::format("QE(s,a) := rE(s,a) {} discount * max QE(s',.); then rE(s,a) := QE(s,a)\n\n",
                      mdp.alternating() ? "-" : "+");
  text += as_printed_banner(lesson.all_zero());
  const auto first = first_difference(both);
  if (first) text += fmt::format("Watch step {}.\n", lesson.updates[*first].step);
  text += "\n" + lesson.origin + "\n" + comparison_text(both) + "\n";
  text += q_text(lesson, mdp, teller, all) + "\n";
  text += lesson.all_zero() ? zero_text(lesson) : proof_text(lesson, mdp);
  return text +
         "The likely intention: rE holds the reward observed at the visit. Read so, it is the "
         "standard rule\n(see --rule reward-estimate).\n";
}

std::string lesson_json(const Lesson& lesson, const World& world, bool all) {
  const Mdp& mdp = *world.mdp;
  const bool is_float = !lesson.printed() && lesson.setup.precision == Precision::single;
  UpdateTeller teller(mdp, first_table(lesson, mdp), lesson.setup.discount, lesson.words());
  JsonWriter json(JsonStyle::pretty);
  json.begin_object().member("world", world.name).member("method", lesson.settings.method);
  write_rule(json, *lesson.entry);
  json.member("discount", lesson.setup.discount);
  json.member("step_size", lesson.setup.step_size.text());
  json.rows("updates", lesson.updates.size(), all, [&](std::uint64_t i) {
    teller.write(json, lesson.updates[i], is_float,
                 lesson.printed() ? std::optional(lesson.standard[i].new_value) : std::nullopt,
                 lesson.beside(i));
  });
  const auto first = first_difference({&mdp, lesson.updates, lesson.standard});
  json.key("first_difference");
  if (lesson.printed() && first)
    json.value(lesson.updates[*first].step);
  else
    json.null();
  json.key("bound");
  if (lesson.setup.value_bound > 0.0)
    json.value(lesson.setup.value_bound);
  else
    json.null();
  json.key("q").begin_array();
  for (State s = 0; s < mdp.states() && (all || mdp.choices() <= json_complete_rows); ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      json.begin_object().member("state", mdp.state_name(s));
      json.member("action", mdp.action_name(c)).key("q").number(teller.q()[c], is_float);
      json.member("visits", teller.visits()[c]).end_object();
    }
  }
  json.end_array().end_object();
  return json.text() + "\n";
}

Result<void> check_words(const ExplainOptions& options) {
  if (!options.state.empty() && (options.trace || options.steps_text)) {
    return Error{
        "explain", 0, 0,
        fmt::format("either --state or {}, not both", options.trace ? "--trace" : "--steps"), ""};
  }
  if (options.trace && options.steps_text) {
    return Error{"explain", 0, 0, "either --trace or --steps, not both", ""};
  }
  if (!options.run.empty() && options.state.empty()) {
    return Error{"--run", 0, 0, "needs --state STATE: whose learned values?", ""};
  }
  if (options.steps_text && options.steps == 0) {
    return Error{"--steps", 0, 0,
                 fmt::format("a whole number from 1 to {} expected, not '{}'", most_steps,
                             *options.steps_text),
                 ""};
  }
  return options.how.check_discount();
}

Exit explain(const ExplainOptions& options) {
  const Result<World> world = options.world.open(options.how);
  if (!world) return fail(world.error());
  const Result<void> fits = check_words(options);
  if (!fits) return fail(fits.error());
  if (!world->mdp) {
    if (!options.state.empty() && !options.run.empty()) {
      return explain_learned(*world, {options.state, options.run, 0.0}, options.output);
    }
    return fail({"explain", 0, 0,
                 "the model of " + world->name + " is not known" +
                     (world->traits.states > 0 ? ": give --state STATE --run FILE" : ""),
                 ""});
  }
  if (!options.state.empty()) {
    LearnSettings settings;
    const Result<void> applied = options.how.apply(settings_of(settings));
    if (!applied) return fail(applied.error());
    return explain_state(*world, {options.state, options.run, settings.discount}, options.output);
  }
  const Result<Lesson> lesson = lesson_of(options, *world);
  if (!lesson) return fail(lesson.error());
  const std::string text = options.output.json ? lesson_json(*lesson, *world, options.output.all)
                                               : lesson_text(*lesson, *world, options.output.all);
  return print(text) ? done : user_error;
}

}  // namespace

void declare_explain(Options& options) {
  auto given = std::make_shared<ExplainOptions>();
  LearnSettings defaults;
  given->world.declare(options);
  const auto take_trace = [given](const std::string& text) { given->trace = text; };
  options.option("--trace", take_trace, "STATE:MOVE,...",
                 "the transitions to explain; for the adventure the lecture's");
  const auto take_steps = [given](const std::string& text) {
    given->steps_text = text;
    const auto count = parse_count(text);
    given->steps = count && *count <= most_steps ? *count : 0;
  };
  options.option("--steps", take_steps, "N",
                 "the first N steps of a run; without it the first episode, at most 10 steps");
  options.option("--state", &given->state, "STATE", "where the values of one state come from");
  options.option("--run", &given->run, "FILE",
                 "with --state: the values of a saved run (or of its folder) beside them");
  std::vector<Setting> settings = settings_of(defaults);
  for (Setting& setting : settings) {
    if (setting.name == "discount") {
      setting.sentence = "discount factor of the future, above 0; without it the world's own";
    }
  }
  given->how.declare(options, std::move(settings));
  given->output.declare(options, "");
  options.run([given] { return explain(*given); });
}

}  // namespace quoll::cli
