// Traces as people write them, and the standard rule beside another one.

#include <fmt/format.h>

#include "quoll/base/text.hpp"
#include "quoll/cli/explain.hpp"

namespace quoll::cli {
namespace {

std::string move_list(const Mdp& mdp, State state) {
  std::string list;
  for (Action a = 0; a < mdp.actions(state) && a < 20; ++a) {
    list += (a > 0 ? ", " : "") + mdp.action_name(mdp.choice_begin(state) + a);
  }
  return mdp.actions(state) > 20 ? list + ", ..." : list;
}

Result<Action> parse_action(const World& world, State state, std::string_view word) {
  const Mdp& mdp = *world.mdp;
  const std::string at = mdp.state_name(state);
  if (mdp.terminal(state)) {
    return Error{"--trace", 0, 0, at + " is an end: there is no move from it", ""};
  }
  Nearest nearest(word);
  for (Action a = 0; a < mdp.actions(state); ++a) {
    const std::string name = mdp.action_name(mdp.choice_begin(state) + a);
    if (name == word) return a;
    nearest.offer(name);
  }
  const auto index = parse_count(word);
  if (index && *index < mdp.actions(state)) return static_cast<Action>(*index);
  return Error{
      "--trace", 0, 0,
      fmt::format("no move '{}' at {}, whose moves are {}", word, at, move_list(mdp, state)),
      nearest.best()};
}

// The outcome of a choice that the trace names, or the only one.
Result<std::uint64_t> parse_outcome(const World& world, std::uint64_t choice, std::string_view word,
                                    const std::string& move) {
  const Mdp& mdp = *world.mdp;
  const std::uint64_t first = mdp.outcome_begin(choice), end = mdp.outcome_end(choice);
  if (word.empty() && end - first == 1) return first;
  std::string names;
  Nearest nearest(word);
  for (std::uint64_t o = first; o < end; ++o) {
    const std::string name = mdp.state_name(mdp.next(o));
    if (name == word || (!word.empty() && std::to_string(mdp.next(o)) == word)) return o;
    nearest.offer(name);
    if (o - first < 20) names += (o > first ? ", " : "") + name;
  }
  return Error{"--trace", 0, 0,
               word.empty() ? fmt::format("{} can lead to {}: write {}:STATE", move, names, move)
                            : fmt::format("{} does not lead to '{}' but to {}", move, word, names),
               nearest.best()};
}

}  // namespace

Result<State> parse_state(const World& world, std::string_view word, std::string_view place) {
  const Mdp& mdp = *world.mdp;
  if (const auto state = mdp.find_state(word)) return *state;
  const auto index = parse_count(word);
  if (index && *index < mdp.states()) return static_cast<State>(*index);
  return Error{std::string(place), 0, 0, fmt::format("no state '{}' in {}", word, world.name),
               mdp.arrays().state_names.nearest(word)};
}

Result<std::vector<Update>> parse_trace(const World& world, std::string_view text) {
  const Mdp& mdp = *world.mdp;
  std::vector<Update> script;
  for (const std::string_view piece : split(text, ',')) {
    const std::vector<std::string_view> words = split(piece, ':');
    if (words.size() < 2 || words.size() > 3) {
      return Error{"--trace", 0, 0,
                   fmt::format("STATE:MOVE, STATE:MOVE, ... expected, not '{}'", piece), ""};
    }
    const Result<State> state = parse_state(world, words[0], "--trace");
    if (!state) return state.error();
    const Result<Action> action = parse_action(world, *state, words[1]);
    if (!action) return action.error();
    const std::uint64_t choice = mdp.choice_begin(*state) + *action;
    const Result<std::uint64_t> outcome =
        parse_outcome(world, choice, words.size() == 3 ? words[2] : "",
                      std::string(words[0]) + ":" + std::string(words[1]));
    if (!outcome) return outcome.error();
    Update update;
    update.step = script.size() + 1;
    update.state = *state;
    update.action = *action;
    update.reward = mdp.reward(choice, *outcome);
    update.next = mdp.next(*outcome);
    update.terminated = mdp.terminal(update.next);
    script.push_back(update);
  }
  return script;
}

std::vector<Update> observed(const Mdp& mdp, std::span<const Update> updates) {
  std::vector<Update> script(updates.begin(), updates.end());
  for (Update& update : script) {
    const std::uint64_t choice = mdp.choice_begin(update.state) + update.action;
    for (std::uint64_t o = mdp.outcome_begin(choice); o < mdp.outcome_end(choice); ++o) {
      if (mdp.next(o) != update.next) continue;
      update.reward = mdp.reward(choice, o);
      break;
    }
  }
  return script;
}

Result<std::vector<Update>> standard_beside(const LearnSettings& settings, const World& world,
                                            std::span<const Update> updates) {
  LearnSettings standard = settings;
  standard.rule = "standard";
  standard.initial_rewards = "world";
  standard.step_size = "1";
  standard.initial_value = "0";
  standard.precision = Precision::twofold;
  const Result<const LearnerEntry*> entry = find_learner(standard);
  if (!entry) return entry.error();
  const Result<LearnSetup> setup = resolve(standard, world);
  if (!setup) return setup.error();
  return (*entry)->replay(*setup, observed(*world.mdp, updates));
}

std::string as_printed_banner(bool all_zero) {
  if (all_zero) {
    return "This is the rule exactly as printed, with every given rE = 0. It never reads the "
           "reward "
           "it observes.\n";
  }
  return "This is the rule exactly as printed. It equals Q-learning until a pair is re-visited; "
         "then it counts the future again.\n";
}

LearnProgress advance_told(Learner& learner, const LearnerEntry& entry, std::uint64_t steps,
                           ToldUpdates& told) {
  std::vector<Update> log(steps);
  const auto append = [&](std::uint64_t count) {
    told.updates.insert(told.updates.end(), log.begin(),
                        log.begin() + static_cast<std::ptrdiff_t>(count));
  };
  if (entry.replay != nullptr) {
    const LearnProgress now = learner.advance(steps, log);
    append(now.logged);
    return now;
  }
  std::vector<double> before = learner.estimates().q;
  LearnProgress now = learner.progress();
  for (; steps > 0 && now.halt == LearnProgress::Halt::none; --steps) {
    now = learner.advance(1, std::span(log).first(1));
    append(now.logged);
    const Estimates estimates = learner.estimates();
    std::vector<OtherChange>& others = told.others.emplace_back();
    const std::uint64_t own = estimates.row_begin[log[0].state] + log[0].action;
    for (std::uint64_t c = 0; c < before.size(); ++c) {
      if (c != own && before[c] != estimates.q[c]) {
        others.push_back({c, before[c], estimates.q[c]});
      }
    }
    before = estimates.q;
  }
  return now;
}

UpdateWords own_words(const LearnerEntry& entry) {
  UpdateWords words = UpdateWords::of(entry.rule.empty() ? "standard" : entry.rule);
  words.chance = true;
  words.memory = entry.replay == nullptr;
  return words;
}

}  // namespace quoll::cli
