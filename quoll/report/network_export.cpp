#include "quoll/report/network_export.hpp"

#include <algorithm>
#include <cmath>

#include "quoll/base/json.hpp"
#include "quoll/base/text.hpp"
#include "quoll/base/utf8.hpp"
#include "quoll/env/listed.hpp"
#include "quoll/experiment/evaluation.hpp"

namespace quoll {
namespace {

constexpr std::size_t most_vectors = 32;
constexpr int steps_between = 3;

bool finite(const std::vector<float>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); });
}

bool finite(const nn::PlainNetwork& network) {
  bool all = true;
  each_layer(network, [&](const std::string&, const nn::PlainLayer& layer, bool) {
    all = all && finite(layer.weights) && finite(layer.bias) && finite(layer.gain) &&
          finite(layer.shift);
  });
  return all;
}

// Moments of uniform play with the stream of seed 1, every few steps.
void observe(const World& world, NetworkExport& out) {
  const std::unique_ptr<Environment> environment = world.make({});
  const UniformPolicy policy = uniform_policy_of(world);
  const Spaces spaces = environment->spaces();
  State state = 0, next = 0;
  Action action = 0;
  Feedback feedback;
  std::vector<float> observation(spaces.observation), seen(spaces.observation);
  Experience now{{&state, 1}, {&action, 1}, {&feedback, 1}, {&next, 1}, observation, seen};
  Rng behaviour = stream(1, "behaviour");
  const std::uint8_t one = 1;
  environment->restart({&one, 1}, now);
  for (std::size_t moment = 0; moment < most_vectors; ++moment) {
    out.vectors.observations.insert(out.vectors.observations.end(), observation.begin(),
                                    observation.end());
    for (int step = 0; step < steps_between; ++step) {
      policy.act(now, {&action, 1}, {&behaviour, 1});
      environment->step(now);
      state = next;
      observation = seen;
      if (feedback.over()) environment->restart({&one, 1}, now);
    }
  }
  out.vectors.count = most_vectors;
}

void count_states(NetworkExport& out, std::uint32_t states) {
  out.vectors.count = std::min<std::size_t>(most_vectors, states);
  for (std::size_t i = 0; i < out.vectors.count; ++i) {
    out.vectors.states.push_back(static_cast<State>(
        states <= most_vectors ? i : i * (std::size_t{states} - 1) / (most_vectors - 1)));
  }
}

// Of states spread over all in which somebody acts; what inputs and outputs are called.
void spell(NetworkExport& out, const Mdp& mdp) {
  const NameLetters& letters = *out.network->letters;
  for (const auto& [letter, place] : letters.letters()) {
    std::string name;
    encode(letter, name);
    out.numbers.push_back(name + " " + std::to_string(place));
  }
  for (const std::string& name : letters.output_names()) out.actions.push_back(name);
  std::vector<State> acting;
  for (State s = 0; s < mdp.states(); ++s) {
    if (!mdp.terminal(s)) acting.push_back(s);
  }
  out.vectors.count = std::min(most_vectors, acting.size());
  out.vectors.observations.assign(out.vectors.count * letters.size(), 0.0F);
  for (std::size_t i = 0; i < out.vectors.count; ++i) {
    const State s = acting[i * acting.size() / out.vectors.count];
    for (const std::uint32_t spot : letters.of(s)) {
      out.vectors.observations[i * letters.size() + spot] = 1.0F;
    }
  }
}

void value(NetworkExport& out) {
  const std::size_t row = out.network->observed.size(), actions = out.network->actions;
  out.vectors.q.resize(out.vectors.count * actions);
  for (std::size_t i = 0; i < out.vectors.count; ++i) {
    const bool numbered = out.network->numbered;
    out.network->values(numbered ? out.vectors.states[i] : 0,
                        numbered ? std::span<const float>()
                                 : std::span(out.vectors.observations).subspan(i * row, row),
                        std::span(out.vectors.q).subspan(i * actions, actions));
  }
}

// The names of the actions, if each number means the same everywhere; and how many there are.
void name_actions(const World& world, NetworkExport& out) {
  const std::uint32_t actions = out.network->actions;
  if (!out.states) {
    for (Action a = 0; a < actions; ++a) {
      out.actions.push_back(a < world.action_names.size() ? world.action_names[a]
                                                          : std::to_string(a));
    }
    return;
  }
  const Mdp& mdp = *out.states;
  std::vector<std::string> names(actions);
  bool same = true, equal = true;
  for (State s = 0; s < mdp.states(); ++s) {
    const Action count = mdp.terminal(s) ? 0 : mdp.actions(s);
    out.action_counts.push_back(count == 0 ? actions : count);
    equal = equal && out.action_counts.back() == actions;
    for (Action a = 0; a < count && same; ++a) {
      const std::string name = mdp.action_name(mdp.choice_begin(s) + a);
      if (names[a].empty()) names[a] = name;
      same = names[a] == name;
    }
  }
  if (same) out.actions = std::move(names);
  if (equal) out.action_counts.clear();
}

std::string list(const std::vector<std::string>& names) {
  JsonWriter json;
  json.begin_array();
  for (const std::string& name : names) json.value(name);
  json.end_array();
  return json.take();
}

std::string state_actions(const Mdp& mdp) {
  JsonWriter json;
  json.begin_array();
  for (State s = 0; s < mdp.states(); ++s) {
    json.begin_array();
    for (Action a = 0; a < (mdp.terminal(s) ? 0 : mdp.actions(s)); ++a) {
      json.value(mdp.action_name(mdp.choice_begin(s) + a));
    }
    json.end_array();
  }
  json.end_array();
  return json.take();
}

}  // namespace

Result<NetworkExport> network_export(const World& world,
                                     std::shared_ptr<const LearnedNetwork> network) {
  NetworkExport out;
  out.network = std::move(network);
  out.world = out.name = world.name;
  for (const Measured& number : world.measured) out.numbers.emplace_back(number.name);
  const bool spelled = out.network->letters != nullptr;
  if (out.network->numbered || spelled) {
    const Result<std::shared_ptr<const Mdp>> states = listed(world);
    if (!states) return states.error();
    if (spelled) {
      spell(out, **states);
    } else {
      out.states = *states;
      count_states(out, out.network->observed.channels);
    }
  } else {
    observe(world, out);
  }
  if (!spelled) name_actions(world, out);
  value(out);
  if (!finite(out.network->network) || !finite(out.vectors.q)) {
    return Error{"", 0, 0, "a number of this network is not finite: it has diverged", ""};
  }
  return out;
}

std::vector<std::pair<std::string, std::string>> network_facts(const NetworkExport& what) {
  const LearnedNetwork& network = *what.network;
  std::string origin;
  for (const std::string& sentence : what.origin) origin += (origin.empty() ? "" : " ") + sentence;
  std::vector<std::pair<std::string, std::string>> facts{{"world", what.world}, {"origin", origin}};
  if (!what.method.empty()) {
    facts.emplace_back("method", what.method);
    facts.emplace_back("discount", shortest(what.discount));
  }
  if (!what.numbers.empty()) facts.emplace_back("observation", list(what.numbers));
  const bool few = what.states && what.states->states() <= json_complete_rows;
  if (!what.actions.empty()) {
    facts.emplace_back("actions", list(what.actions));
  } else if (few) {
    facts.emplace_back("actions", state_actions(*what.states));
  }
  if (few) {
    std::vector<std::string> names;
    for (State s = 0; s < what.states->states(); ++s) names.push_back(what.states->state_name(s));
    facts.emplace_back("states", list(names));
  }
  facts.emplace_back("layout", layout_names[static_cast<std::size_t>(network.layout)]);
  facts.emplace_back("returns", returns_names[static_cast<std::size_t>(network.returns)]);
  facts.emplace_back("value_scale", shortest(network.value_scale));
  return facts;
}

}  // namespace quoll
