// One number over everything that must give the same bits on every machine: each learner with each
// source, exploration and start; each solver; each world stepped. A change of it is a change of
// results: tests/golden/signature.txt is edited in the same commit, on purpose.
//
//   quoll_signature              prints the number
//   quoll_signature --parts      prints one for each part, to find what changed
//   quoll_signature --check FILE compares; exit status 1 when it differs

#include <bit>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>

#include "learn/worlds.hpp"
#include "quoll/base/parallel.hpp"
#include "quoll/learn/deep/learned_network.hpp"
#include "quoll/learn/readers.hpp"
#include "quoll/nn/arithmetic.hpp"
#include "quoll/solve/average_reward.hpp"
#include "quoll/solve/finite_horizon.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

struct Hash {
  std::uint64_t value = 0;
  void add(std::uint64_t bits) { value = mix(value + golden_gamma) ^ mix(bits); }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(std::string_view text) {
    for (const char letter : text) add(std::uint64_t{static_cast<unsigned char>(letter)});
  }
};

std::vector<World> the_worlds() {
  std::vector<World> all{corridor(6),           star(),
                         slippery(7),           lottery(),
                         without_model(star()), without_model(slippery(7)),
                         slippery(40, 1.0)};
  for (const WorldEntry* const entry : worlds()) {
    if (Result<World> world = entry->make({})) all.push_back(std::move(*world));
  }
  return all;
}

std::uint64_t learned(const LearnerEntry& entry, const World& world, const std::string& explore,
                      const std::string& start, const std::string& step_size) {
  Hash hash;
  for (const Precision precision : {Precision::single, Precision::twofold}) {
    LearnSettings settings;
    settings.method = entry.method;
    if (entry.traits.networks) settings.deep.hidden = "16";  // enough to differ
    if (entry.method == "dqn") settings.deep.batch = 8;
    if (entry.method == "nfq") settings.deep.fits = settings.deep.epochs = 2;  // each is the same
    settings.rule = entry.rule.empty() ? "standard" : entry.rule;
    if (!ignores(entry, "explore")) settings.explore = explore;
    settings.start = start;
    if (!ignores(entry, "step_size")) settings.step_size = step_size;
    if (!ignores(entry, "precision")) settings.precision = precision;
    settings.until_stable = false;
    const auto learner = make_learner(settings, world);
    if (!learner) continue;  // a choice this learner or world does not have
    const LearnProgress now = (*learner)->advance(entry.traits.plans ? 300 : 2500, {});
    hash.add(now.steps);
    hash.add(now.episodes);
    hash.add(now.return_sum);
    const Estimates estimates = (*learner)->estimates();
    for (const double q : estimates.q) hash.add(q);
    for (const std::uint32_t visits : estimates.visits) hash.add(std::uint64_t{visits});
    for (const double reward : estimates.reward_estimate) hash.add(reward);
  }
  return hash.value;
}

// A switch of networks and what it is called.
struct Switch {
  std::string_view method, name;  // no method: every learner with a network
  void (*turn)(DeepSettings&);
};
constexpr Switch switches[] = {
    {"", "", [](DeepSettings&) {}},
    {"", "--layout separate", [](DeepSettings& s) { s.layout = NetworkLayout::separate; }},
    {"", "--layout joint", [](DeepSettings& s) { s.layout = NetworkLayout::joint; }},
    {"dqn", "--double-q", [](DeepSettings& s) { s.double_q = true; }},
    {"dqn", "--duelling", [](DeepSettings& s) { s.duelling = true; }},
    {"dqn", "--prioritised", [](DeepSettings& s) { s.prioritised = true; }},
    {"dqn", "--noisy", [](DeepSettings& s) { s.noisy = true; }},
    {"dqn", "--returns categorical", [](DeepSettings& s) { s.returns = Returns::categorical; }},
    {"dqn", "--returns quantile", [](DeepSettings& s) { s.returns = Returns::quantile; }},
    {"dqn", "--munchausen", [](DeepSettings& s) { s.munchausen = true; }},
    {"dqn", "rainbow", [](DeepSettings& s) {
       s.double_q = s.duelling = s.prioritised = s.noisy = true;
       s.multi_step = 3;
       s.returns = Returns::categorical;
     }}};

void add_layer(Hash& hash, const nn::PlainLayer& layer) {
  for (const std::vector<float>* const numbers :
       {&layer.weights, &layer.bias, &layer.gain, &layer.shift}) {
    for (const float number : *numbers) hash.add(double{number});
  }
}

// What the network has become after some steps.
std::uint64_t networked(const LearnerEntry& entry, const World& world, const Switch& one) {
  Hash hash;
  LearnSettings settings;
  settings.method = entry.method;
  settings.until_stable = false;
  settings.deep.hidden = "16";
  if (entry.method == "dqn") {
    settings.deep.learning_starts = 100;
    settings.deep.batch = 8;
  }
  if (entry.method == "nfq") settings.deep.fits = settings.deep.epochs = 2;
  one.turn(settings.deep);
  const auto learner = make_learner(settings, world);
  if (!learner) return 1;  // a switch it does not have
  const LearnProgress now = (*learner)->advance(1500, {});
  hash.add(now.steps);
  hash.add(now.return_sum);
  const auto network = (*learner)->network();
  if (!network) return 2;
  for (const nn::PlainLayer& layer : network->network.body) add_layer(hash, layer);
  for (const std::vector<nn::PlainLayer>& head : network->network.heads) {
    for (const nn::PlainLayer& layer : head) add_layer(hash, layer);
  }
  return hash.value;
}

std::uint64_t solved(const SolverEntry& entry, const World& world) {
  Hash hash;
  SolveSettings settings;
  settings.width = 1e-9;
  if (entry.needs_total) settings.discount = 1.0;
  const Result<Solution> solution = entry.make()->solve(*world.mdp, settings);
  if (!solution) return 1;  // a kind of model it cannot do
  for (const double bound : solution->lower) hash.add(bound);
  for (const double bound : solution->upper) hash.add(bound);
  for (const Action action : solution->policy) hash.add(std::uint64_t{action});
  return hash.value;
}

/// The answers to the questions of another kind: average reward, and a number of steps.
std::uint64_t asked_otherwise(const World& world) {
  Hash hash;
  SolveSettings endless;
  endless.max_sweeps = 1000;
  if (const Result<AverageSolution> average = solve_average(*world.mdp, endless); average) {
    for (const double bound : average->lower) hash.add(bound);
    for (const double bound : average->upper) hash.add(bound);
    for (const Action action : average->policy) hash.add(std::uint64_t{action});
  }
  HorizonSettings steps;
  steps.steps = 20;
  if (const Result<HorizonSolution> horizon = solve_horizon(*world.mdp, steps); horizon) {
    for (const double bound : horizon->lower) hash.add(bound);
    for (const double bound : horizon->upper) hash.add(bound);
    for (const Action action : horizon->policy) hash.add(std::uint64_t{action});
  }
  return hash.value;
}

/// Larger worlds are stepped only: learning them would add minutes, and no kind of step. Methods
/// that plan do so for almost every step here.
constexpr std::uint64_t learned_up_to = 10'000;  // states
constexpr std::uint64_t planned_up_to = 100, with_memory_up_to = 500;

std::uint64_t stepped(const World& world) {
  Hash hash;
  constexpr std::uint32_t lanes = 3;
  const auto environment = world.make({lanes, 1, 0, nullptr});
  std::vector<State> state(lanes), next(lanes);
  std::vector<Action> action(lanes);
  std::vector<Feedback> feedback(lanes);
  std::vector<std::uint8_t> restart(lanes, 1);
  Rng coin = stream(1, "signature");
  Experience now{state, action, feedback, next, {}, {}};
  for (int t = 0; t < 1000; ++t) {
    environment->restart(restart, now);
    for (std::uint32_t i = 0; i < lanes; ++i) {
      action[i] = coin.below(std::max(environment->actions(state[i]), 1u));
    }
    environment->step(now);
    for (std::uint32_t i = 0; i < lanes; ++i) {
      hash.add(std::uint64_t{next[i]});
      hash.add(feedback[i].reward);
      hash.add(std::uint64_t{feedback[i].terminated} * 2 + feedback[i].truncated);
      restart[i] = feedback[i].terminated || feedback[i].truncated;
    }
    state = next;
  }
  return hash.value;
}

// One line of the signature, and how its hash is found.
struct Part {
  std::string name;
  std::function<std::uint64_t()> find;
};

std::vector<Part> parts_of(const std::vector<World>& all) {
  std::vector<Part> list;
  const auto part = [&](std::string name, std::function<std::uint64_t()> find) {
    list.push_back({std::move(name), std::move(find)});
  };
  for (const World& world : all) {
    const bool large = world.traits.states > learned_up_to;
    for (const LearnerEntry& entry : learners()) {
      const std::uint64_t most = entry.traits.plans        ? planned_up_to
                                 : entry.replay == nullptr ? with_memory_up_to
                                                           : learned_up_to;
      if (world.traits.states > most) continue;
      const std::string name = std::string(entry.method) + " " + std::string(entry.rule);
      for (const std::string_view explore : exploration_names) {
        if (entry.traits.directed && explore != exploration_names[0]) continue;
        part("learn " + world.name + " " + name + " --explore " + std::string(explore),
             [&, explore] { return learned(entry, world, std::string(explore), "world", "auto"); });
      }
      for (const std::string_view start : start_names) {
        part("learn " + world.name + " " + name + " --start " + std::string(start), [&, start] {
          return learned(entry, world, "epsilon-greedy", std::string(start), "auto");
        });
      }
      for (const char* const step_size : {"1", "0.1", "1e-5", "1/N^0.8", "rescaled-linear"}) {
        if (entry.traits.plans) continue;
        part("learn " + world.name + " " + name + " --step-size " + step_size,
             [&, step_size] { return learned(entry, world, "softmax", "world", step_size); });
      }
    }
    for (const SolverEntry& entry : solvers()) {
      if (entry.needs_total && world.traits.states > with_memory_up_to) continue;
      if (world.mdp && !large) {
        part("solve " + world.name + " " + std::string(entry.name),
             [&] { return solved(entry, world); });
      }
    }
    if (world.mdp && world.traits.states <= with_memory_up_to)
      part("average, horizon " + world.name, [&] { return asked_otherwise(world); });
    part("step " + world.name, [&] { return stepped(world); });
    if (world.name != "slippery" && world.name != "cartpole" && world.name != "minatar-breakout") {
      continue;
    }
    for (const LearnerEntry& entry : learners()) {
      for (const Switch& one : switches) {
        if (!entry.traits.networks || (!one.method.empty() && one.method != entry.method)) continue;
        part(
            "network " + world.name + " " + std::string(entry.method) + " " + std::string(one.name),
            [&] { return networked(entry, world, one); });
      }
    }
  }
  return list;
}

std::uint64_t signature(bool told) {
  const std::vector<World> all = the_worlds();
  const std::vector<Part> list = parts_of(all);
  std::vector<std::uint64_t> values(list.size());
  parallel_for(list.size(), 0, [&](std::size_t i) { values[i] = list[i].find(); });
  Hash hash;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (told) std::printf("%016" PRIx64 "  %s\n", values[i], list[i].name.c_str());
    hash.add(values[i]);
  }
  return hash.value;
}

}  // namespace
}  // namespace quoll

int main(int argc, char** argv) {
  // The arithmetic every processor has: networks give other bits where one instruction multiplies
  // and adds (tests/nn compares those with each other).
  quoll::nn::use_arithmetic("base");
  const bool parts = argc == 2 && std::strcmp(argv[1], "--parts") == 0;
  char text[17];
  std::snprintf(text, sizeof text, "%016" PRIx64, quoll::signature(parts));
  std::puts(text);
  if (argc != 3 || std::strcmp(argv[1], "--check") != 0) return 0;
  std::string golden;
  std::ifstream(argv[2]) >> golden;
  if (golden == text) return 0;
  std::printf("%s says %s: results have changed; if that is meant, write the new one there\n",
              argv[2], golden.c_str());
  return 1;
}
