#include "quoll/experiment/learn.hpp"

#include "quoll/base/raise.hpp"
#include "quoll/base/text.hpp"

namespace quoll {

World world(const std::string& name_or_file,
            const std::vector<std::pair<std::string, std::string>>& parameters) {
  return value_or_raise(find_world(name_or_file, parameters));
}

World world(std::string name, const MdpBuilder& builder) {
  return to_world(std::move(name), value_or_raise(builder.build()));
}

Learned::Learned(const Run& run, RunResult result)
    : world_(run.world()),
      choice_(run.choice()),
      estimates_(run.trainings().front().learner().estimates()),
      result_(std::move(result)),
      policy_(result_.seeds.front().policy) {}

State Learned::find(std::string_view state) const {
  if (!world_.mdp) {
    raise({"", 0, 0, "the states of " + world_.name + " have no names; an index expected", ""});
  }
  const std::optional<State> found = world_.mdp->find_state(state);
  if (!found) {
    raise({"", 0, 0, "no state '" + std::string(state) + "' in " + world_.name,
           world_.mdp->arrays().state_names.nearest(state)});
  }
  return *found;
}

std::uint64_t Learned::pair(State state, Action action) const {
  const std::vector<std::uint64_t>& begin = estimates_.row_begin;
  if (state + std::uint64_t{1} >= begin.size() || action >= begin[state + 1] - begin[state]) {
    raise({"", 0, 0,
           "no action " + std::to_string(action) + " in state " + std::to_string(state) + " of " +
               world_.name,
           ""});
  }
  return begin[state] + action;
}

double Learned::q(State state, Action action) const {
  return estimates_.q[pair(state, action)];
}

std::uint32_t Learned::visits(State state, Action action) const {
  return estimates_.visits[pair(state, action)];
}

double Learned::q(std::string_view state, std::string_view action) const {
  const State s = find(state);
  Nearest nearest{std::string(action)};
  for (std::uint64_t c = world_.mdp->choice_begin(s); c < world_.mdp->choice_end(s); ++c) {
    const std::string name = world_.mdp->action_name(c);
    if (name == action) return estimates_.q[c];
    nearest.offer(name);
  }
  raise({"", 0, 0, "no action '" + std::string(action) + "' in " + std::string(state),
         std::string(nearest.best())});
}

std::string Learned::best(std::string_view state) const {
  const State s = find(state);
  const Action action = policy_(s);
  return action == no_action ? "" : world_.mdp->action_name(world_.mdp->choice_begin(s) + action);
}

bool Learned::optimal() const {
  const std::optional<Optimality>& judged = result_.seeds.front().optimality;
  return judged && judged->optimal && *judged->optimal;
}

Learned learn(const World& world, const RunSettings& settings) {
  RunSettings asked = settings;
  if (!asked.time.empty()) value_or_raise(parse_duration(asked.time, "time"));
  if (!asked.until.empty() && asked.until != "stable") {
    raise({"until", 0, 0, "stable expected, not '" + asked.until + "'", "stable"});
  }
  if (asked.learn.initial_rewards != "world" && asked.learn.initial_rewards != "zero") {
    raise({"initial_rewards", 0, 0,
           "world or zero expected, not '" + asked.learn.initial_rewards + "'", ""});
  }
  asked.learn.until_stable = !asked.has_limit() || asked.until == "stable";
  Run run = value_or_raise(Run::start(asked, {world.name, world.parameters}, world, {}));
  run.set_threads(asked.threads);
  run.advance(asked, 0.0, {}, {});
  return {run, run.result(true)};
}

Learned learn(const World& world) {
  LearnSettings open;
  open.method = "auto";
  return learn(world, open);
}

Learned learn(const World& world, const LearnSettings& settings) {
  RunSettings asked;
  asked.learn = settings;
  return learn(world, asked);
}

}  // namespace quoll
