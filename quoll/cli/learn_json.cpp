// The JSON object of `learn` (docs/json.md).

#include "quoll/base/json.hpp"
#include "quoll/cli/judged_run.hpp"
#include "quoll/cli/learn_certificate.hpp"
#include "quoll/cli/learn_report.hpp"
#include "quoll/cli/network_words.hpp"
#include "quoll/nn/arithmetic.hpp"

namespace quoll::cli {
namespace {

void write_q(JsonWriter& json, const Mdp& mdp, const Estimates& estimates,
             const std::vector<double>& q_star, const LearnStory& story) {
  std::vector<State> owner(mdp.choices());
  for (State s = 0; s < mdp.states(); ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) owner[c] = s;
  }
  const bool beside = story.beside != nullptr && !story.beside->q.empty();
  json.rows("q", mdp.choices(), story.all, [&](std::uint64_t c) {
    json.begin_object();
    json.member("state", mdp.state_name(owner[c])).member("action", mdp.action_name(c));
    json.key("q").number(estimates.q[c], estimates.single_precision);
    json.member("visits", estimates.visits[c]);
    if (q_star.empty())
      json.null_member("q_star");
    else
      json.member("q_star", q_star[c]);
    if (!estimates.reward_estimate.empty()) {
      json.member("reward_estimate", estimates.reward_estimate[c]);
    }
    if (beside) json.member("standard", story.beside->q[c]);
    json.end_object();
  });
}

void write_policy(JsonWriter& json, const Mdp& mdp, const std::vector<Action>& policy, bool all) {
  json.rows("policy", mdp.states(), all, [&](std::uint64_t s) {
    const auto state = static_cast<State>(s);
    json.begin_object().member("state", mdp.state_name(state));
    if (policy[state] == no_action)
      json.null_member("action");
    else
      json.member("action", mdp.action_name(mdp.choice_begin(state) + policy[state]));
    json.end_object();
  });
}

void write_evaluation(JsonWriter& json, const Run& run, const RunResult& result) {
  if (run.settings().evaluation_episodes == 0) {
    json.null_member("evaluation");
    return;
  }
  const Statistics& s = result.statistics;
  json.key("evaluation").begin_object();
  json.member("episodes", run.settings().evaluation_episodes).member("seeds", result.counted);
  json.member("mean", s.mean).member("median", s.median).member("iqm", s.iqm);
  json.member("minimum", s.minimum);
  json.member("lower", s.lower).member("upper", s.upper);
  json.member("threshold", run.world().traits.solved).member("solved", result.solved);
  json.end_object();
}

void write_reached(JsonWriter& json, const std::optional<ReturnReached>& reached) {
  if (!reached) {
    json.null_member("reached");
    return;
  }
  json.key("reached").begin_object();
  json.member("steps", reached->steps).member("episodes", reached->episodes);
  json.member("processor_seconds", reached->processor_seconds).member("mean", reached->mean);
  json.end_object();
}

void write_runs(JsonWriter& json, const RunResult& result) {
  json.key("runs").begin_array();
  for (const SeedResult& seed : result.seeds) {
    json.begin_object().member("seed", seed.seed).member("steps", seed.steps);
    json.member("stop", stop_name(seed.stop));
    json.member("optimal", seed.optimality ? seed.optimality->optimal : std::nullopt);
    json.key("regret");
    if (seed.optimality)
      json.value(seed.optimality->regret);
    else
      json.null();
    if (seed.played.episodes > 0) {
      json.member("mean", seed.played.mean);
    } else {
      json.null_member("mean");
    }
    json.member("evaluation_episodes", seed.played.episodes);
    json.member("training_return", seed.training_return);
    json.member("processor_seconds", seed.processor_seconds);
    write_reached(json, seed.reached);
    json.end_object();
  }
  json.end_array();
}

void write_verdict(JsonWriter& json, const SeedResult& seed) {
  if (!seed.optimality) {
    for (const char* key : {"optimal", "proof", "regret", "optimal_states", "unreachable"}) {
      json.null_member(key);
    }
    return;
  }
  json.member("optimal", seed.optimality->optimal)
      .member("proof", seed.optimality->proof)
      .member("regret", seed.optimality->regret);
  json.member("optimal_states", seed.optimal_states);
  json.member("unreachable", seed.optimality->unreachable);
}

void write_impossible(JsonWriter& json, const Mdp* mdp, const Impossible& found) {
  if (!found.found || mdp == nullptr) {
    json.null_member("impossible");
    return;
  }
  json.key("impossible").begin_object();
  json.member("step", found.step).member("state", mdp->state_name(found.state));
  json.member("action", mdp->action_name(mdp->choice_begin(found.state) + found.action));
  json.member("value", found.value).member("bound", found.bound).end_object();
}

void write_first_difference(JsonWriter& json, const LearnStory& story) {
  if (story.beside != nullptr && story.beside->printed)
    json.member("first_difference", story.beside->printed->step);
  else
    json.null_member("first_difference");
}

void write_least_visited(JsonWriter& json, const Run& run, const RunResult& result,
                         const LearnStory& story) {
  const std::vector<PairVisits> pairs = least_visited(run, result, story);
  if (pairs.empty()) {
    json.null_member("least_visited");
    return;
  }
  const Mdp& mdp = *run.world().mdp;
  json.key("least_visited").begin_array();
  for (const PairVisits& pair : pairs) {
    json.begin_object().member("state", mdp.state_name(pair.state));
    json.member("action", mdp.action_name(mdp.choice_begin(pair.state) + pair.action));
    json.member("visits", pair.visits).end_object();
  }
  json.end_array();
}

}  // namespace

std::string learn_json(const Run& run, const RunResult& result, const LearnStory& story) {
  const LearnSettings& learn = run.settings().learn;
  const SeedResult& first = result.seeds.front();
  const Mdp* mdp = run.world().mdp.get();
  std::uint64_t steps = 0, episodes = 0;
  for (const SeedResult& seed : result.seeds) {
    steps += seed.steps;
    episodes += seed.episodes;
  }
  JsonWriter json(JsonStyle::pretty);
  json.begin_object();
  json.member("world", run.world().name).member("method", learn.method);
  if (run.choice()) json.member("chosen", run.choice()->options());
  write_rule(json, run.entry());
  json.member("discount", run.discount()).member("seed", learn.seed);
  if (run.entry().traits.networks) {
    json.member("arithmetic", nn::arithmetic().fused ? "fused" : "plain");
  }
  if (const auto network = run.trainings().front().learner().network()) {
    json.key("network").begin_object().member("sizes", sizes_of(*network));
    json.member("layout", layout_names[static_cast<std::size_t>(network->layout)]);
    json.member("numbers", numbers_of(network->network));
    json.member("reward_scale", network->value_scale).end_object();
  }
  json.member("steps", steps).member("seconds", result.seconds);
  json.member("steps_per_second",
              result.seconds > 0.0 ? static_cast<double>(steps) / result.seconds : 0.0);
  json.member("episodes", episodes).member("stop", stop_name(first.stop));
  if (mdp && no_table(run).empty()) {
    const Estimates estimates = run.trainings().front().learner().estimates();
    write_q(json, *mdp, estimates,
            result.exact ? q_star_all(*mdp, *result.exact, run.discount()) : std::vector<double>(),
            story);
    write_policy(json, *mdp, first.policy, story.all);
  } else {
    json.null_member("q").null_member("policy");
  }
  write_verdict(json, first);
  write_impossible(json, mdp, first.impossible);
  write_first_difference(json, story);
  write_least_visited(json, run, result, story);
  write_learned_certificate(json, run, result);
  write_evaluation(json, run, result);
  write_runs(json, result);
  if (story.coming) write_updates(json, run, *story.coming, story.all);
  json.end_object();
  return json.text() + "\n";
}

}  // namespace quoll::cli
