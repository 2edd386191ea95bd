// explain --state --run of a world without a model: what was learned about one state.

#include <fmt/format.h>

#include "quoll/base/json.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/explain.hpp"
#include "quoll/cli/judged_run.hpp"
#include "quoll/cli/policy_file.hpp"
#include "quoll/cli/same_world.hpp"
#include "quoll/env/listed.hpp"

namespace quoll::cli {
namespace {

struct Known {
  const Mdp& states;
  State state;
  Estimates estimates;
  Action greedy;
  const Run& run;
};

std::string text_of(const Known& known) {
  const Mdp& states = known.states;
  const Training& first = known.run.trainings().front();
  std::string text = fmt::format(
      "explain {}   state {}, discount {}\n\nThe model is not known, so there is no exact value. "
      "Learned:\n",
      known.run.world().name, states.state_name(known.state), number_text(known.run.discount()));
  TextTable table({{"move"},
                   {"learned Q", TextTable::Align::point},
                   {"visits", TextTable::Align::right},
                   {""}});
  for (Action a = 0; a < states.actions(known.state); ++a) {
    const std::uint64_t c = states.choice_begin(known.state) + a;
    table.row({states.action_name(c), number_text(known.estimates.q[c]),
               grouped(known.estimates.visits[c]), a == known.greedy ? "<- greedy" : ""});
  }
  return text + table.text() +
         fmt::format("\nLearned Q: {}, seed {}, after {} steps.\n", rule_words(known.run.entry()),
                     first.seed(), grouped(first.learner().progress().steps));
}

std::string json_of(const Known& known) {
  const Mdp& states = known.states;
  JsonWriter json(JsonStyle::pretty);
  json.begin_object().member("world", known.run.world().name);
  json.member("state", states.state_name(known.state)).member("discount", known.run.discount());
  json.null_member("lower").null_member("upper");
  json.key("actions").begin_array();
  for (Action a = 0; a < states.actions(known.state); ++a) {
    const std::uint64_t c = states.choice_begin(known.state) + a;
    json.begin_object().member("action", states.action_name(c)).null_member("q_star");
    json.null_member("optimal");
    json.key("q").number(known.estimates.q[c], known.estimates.single_precision);
    json.member("visits", known.estimates.visits[c]);
    json.key("outcomes").begin_array().end_array().end_object();
  }
  json.end_array().key("way").begin_array().end_array().end_object();
  return json.text() + "\n";
}

}  // namespace

Exit explain_learned(const World& world, const StateQuestion& question,
                     const OutputOption& output) {
  const Result<std::shared_ptr<const Mdp>> states = listed(world);
  if (!states) return fail({"explain", 0, 0, states.error().expected, ""});
  World named = world;
  named.mdp = *states;
  const Result<State> state = parse_state(named, question.state, "--state");
  if (!state) return fail(state.error());
  const Result<Run> run = Run::load(run_file(question.run), false);
  if (!run) return fail(run.error());
  if (const Result<void> same = check_same_world(*run, question.run, world); !same) {
    return fail(same.error());
  }
  const std::string missing = no_table(*run);
  if (!missing.empty()) return fail({"--run", 0, 0, missing, ""});
  Known known{**states, *state, run->trainings().front().learner().estimates(), no_action, *run};
  known.greedy = greedy_policy(known.estimates)[*state];
  return print(output.json ? json_of(known) : text_of(known)) ? done : user_error;
}

}  // namespace quoll::cli
