#include "quoll/cli/policy_file.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include "quoll/base/file.hpp"
#include "quoll/base/json_tree.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/judged_run.hpp"
#include "quoll/cli/same_world.hpp"
#include "quoll/env/listed.hpp"
#include "quoll/experiment/run.hpp"
#include "quoll/model/formats/fields.hpp"
#include "quoll/model/formats/lines.hpp"

namespace quoll::cli {
namespace {

/// Collects named pairs of a file into one action per state.
class PolicyBuilder {
 public:
  explicit PolicyBuilder(const Mdp& mdp)
      : mdp_(mdp), actions_(mdp.states(), no_action), given_(mdp.states(), false) {}

  /// `place` names the file, and the line if it has one; no action = nothing to do there.
  Result<void> add(std::string_view state, std::optional<std::string_view> action, Error place) {
    const std::optional<State> s = mdp_.find_state(state);
    if (!s) {
      place.expected = "no state '" + std::string(state) + "' in this world";
      place.nearest = mdp_.arrays().state_names.nearest(state);
      return place;
    }
    if (given_[*s]) {
      place.expected = "state " + std::string(state) + " stands twice";
      return place;
    }
    given_[*s] = true;
    if (!action) return {};
    return set(*s, *action, std::move(place));
  }

  std::vector<Action> take() { return std::move(actions_); }

 private:
  Result<void> set(State s, std::string_view action, Error place) {
    Nearest nearest(action);
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      const std::string name = mdp_.action_name(c);
      if (name == action) {
        actions_[s] = static_cast<Action>(c - mdp_.choice_begin(s));
        return {};
      }
      nearest.offer(name);
    }
    const auto number = parse_count(action);
    if (number && *number < mdp_.actions(s)) {
      actions_[s] = static_cast<Action>(*number);
      return {};
    }
    place.expected = "no action '" + std::string(action) + "' at state " + mdp_.state_name(s);
    place.nearest = nearest.best();
    return place;
  }

  const Mdp& mdp_;
  std::vector<Action> actions_;
  std::vector<bool> given_;
};

/// The columns of a table of actions: "state,action", or moves on a map, "x,y,state,move,cost".
struct Columns {
  static constexpr std::size_t none = Fields::most;
  std::size_t count = 0;  ///< 0 = the header was not read yet
  std::size_t state = none, action = none;

  /// Whether the header has both.
  bool read(const Fields& header) {
    count = header.count;
    for (std::size_t i = 0; i < header.count && i < Fields::most; ++i) {
      if (header.text[i] == "state") state = i;
      if (header.text[i] == "action" || header.text[i] == "move") action = i;
    }
    return state != none && action != none;
  }
};

Result<std::vector<Action>> read_csv_policy(const std::string& path, const Mdp& mdp) {
  Result<quoll::Lines> lines = quoll::Lines::open(path);
  if (!lines) return lines.error();
  PolicyBuilder builder(mdp);
  std::string_view line;
  Fields fields;
  Columns columns;
  while (lines->next(line)) {
    if (trim(line).empty() || line.front() == '#') continue;
    Error place{path, lines->number(), 0, "", ""};
    if (const auto bad = fields.split(line)) {
      place.column = *bad + 1;
      place.expected = "a quotation mark without its partner";
      return place;
    }
    if (columns.count == 0) {
      if (columns.read(fields)) continue;
      place.expected =
          "the header state,action expected, not '" + std::string(line.substr(0, 60)) + "'";
      return place;
    }
    if (fields.count != columns.count) {
      place.expected = counted(columns.count, "field") + " expected, as in the header, not " +
                       std::to_string(fields.count);
      return place;
    }
    std::optional<std::string_view> action;
    if (!fields.text[columns.action].empty()) action = fields.text[columns.action];
    const Result<void> added = builder.add(fields.text[columns.state], action, place);
    if (!added) return added.error();
  }
  if (!lines->error().empty()) return Error{path, lines->number(), 0, lines->error(), ""};
  if (columns.count == 0)
    return Error{path, 0, 0, "the header state,action expected; the file is empty", ""};
  return builder.take();
}

// A name, a number from 0, or nothing for null; an object as learn and solve write them.
Result<void> add_json_row(PolicyBuilder& builder, const Tree& row, Error place) {
  const Tree* const state = row.find("state");
  const Tree* const action = row.find("action");
  const auto* const name = state ? std::get_if<std::string>(&state->value) : nullptr;
  const auto* const word = action ? std::get_if<std::string>(&action->value) : nullptr;
  const auto* const number = action ? std::get_if<std::int64_t>(&action->value) : nullptr;
  const bool none = action && std::holds_alternative<std::nullptr_t>(action->value);
  if (!name || !(word || number || none)) {
    place.expected += "an object with a state and an action (names) expected";
    return place;
  }
  place.expected.clear();
  if (none) return builder.add(*name, std::nullopt, std::move(place));
  return builder.add(*name, word ? *word : std::to_string(*number), std::move(place));
}

Result<std::vector<Action>> read_json_policy(const std::string& path, const Mdp& mdp) {
  const Result<std::string> content = read_file(path);
  if (!content) return content.error();
  const Result<Tree> json = read_json(*content, path);
  if (!json) return json.error();
  std::string_view key;
  const Tree::List* list = nullptr;
  for (const std::string_view name : {"policy", "values"}) {
    const Tree* const found = list ? nullptr : json->find(name);
    if (found) list = std::get_if<Tree::List>(&found->value);
    if (list && key.empty()) key = name;
  }
  if (list == nullptr) {
    return Error{path, 0, 0, "a list \"policy\" or \"values\" expected, as learn and solve write",
                 ""};
  }
  if (json->find("omitted") && list->empty()) {
    return Error{path, 0, 0,
                 "the list \"" + std::string(key) + "\" was left out; write it with --all", ""};
  }
  PolicyBuilder builder(mdp);
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Error place{path, 0, 0, std::string(key) + "[" + std::to_string(i) + "]: ", ""};
    const Result<void> added = add_json_row(builder, (*list)[i], place);
    if (!added) return added.error();
  }
  return builder.take();
}

Result<Run> read_run(const std::string& path, const World& world) {
  Result<Run> run = Run::load(path, false);
  if (!run) return run.error();
  const Result<void> same = check_same_game(*run, path, world);
  if (!same) return same.error();
  const std::string reason = unsound(*run);
  if (!reason.empty()) return Error{path, 0, 0, "no policy to judge: " + reason, ""};
  return run;
}

// By the names of states and actions; states that `from` does not have get none.
std::vector<Action> in_names_of(const Mdp& to, const Mdp& from, std::span<const Action> actions) {
  std::vector<Action> out(to.states(), no_action);
  for (State s = 0; s < to.states(); ++s) {
    const std::optional<State> known = from.find_state(to.state_name(s));
    if (to.terminal(s) || !known || actions[*known] == no_action) continue;
    const std::string name = from.action_name(from.choice_begin(*known) + actions[*known]);
    for (Action a = 0; a < to.actions(s); ++a) {
      if (to.action_name(to.choice_begin(s) + a) == name) out[s] = a;
    }
  }
  return out;
}

// Of a run that passed check_same_game() and has a table.
std::vector<Action> table_of(const Run& run, const World& world) {
  std::vector<Action> actions = greedy_policy(run.trainings().front().learner().estimates());
  if (!world.mdp || same_world(run.world(), world)) return actions;
  return in_names_of(*world.mdp, *run.world().mdp, actions);
}

Result<std::vector<Action>> read_run_policy(const std::string& path, const World& world) {
  const Result<Run> run = read_run(path, world);
  if (!run) return run.error();
  const std::string reason = no_table(*run);
  if (!reason.empty()) return Error{path, 0, 0, reason, ""};
  return table_of(*run, world);
}

// The model whose states a file may name: of a game against somebody that of all its boards, since
// a policy may know what to do against others as well.
Result<std::shared_ptr<const Mdp>> nameable(const World& world) {
  if (const std::optional<Parameters> parameters = without_opponent(world)) {
    const Result<World> all = find_world(world.name, *parameters);
    if (all && all->mdp) return all->mdp;
  }
  return listed(world);
}

}  // namespace

Result<std::vector<Action>> read_policy(const std::string& path, const World& world) {
  const std::string file = run_file(path);
  if (file.ends_with(".quoll")) return read_run_policy(file, world);
  const Result<std::shared_ptr<const Mdp>> states = nameable(world);
  if (!states) {
    return Error{"--policy", 0, 0,
                 "uniform or a saved run (.quoll) expected: " + states.error().expected, ""};
  }
  if (!file.ends_with(".csv") && !file.ends_with(".json")) {
    return Error{
        "--policy", 0, 0,
        "uniform or a file that ends in .csv, .json or .quoll expected, not '" + path + "'",
        nearest(path, std::vector<std::string>{"uniform"})};
  }
  Result<std::vector<Action>> actions =
      file.ends_with(".csv") ? read_csv_policy(file, **states) : read_json_policy(file, **states);
  if (!actions || !world.mdp || *states == world.mdp) return actions;
  return in_names_of(*world.mdp, **states, *actions);
}

Result<std::unique_ptr<Policy>> read_acting(const std::string& path, const World& world) {
  const std::string file = run_file(path);
  if (file.ends_with(".quoll")) {
    const Result<Run> run = read_run(file, world);
    if (!run) return run.error();
    if (!no_table(*run).empty()) return run->trainings().front().learner().policy();
    return std::unique_ptr<Policy>(std::make_unique<TablePolicy>(table_of(*run, world)));
  }
  Result<std::vector<Action>> actions = read_policy(path, world);
  if (!actions) return actions.error();
  return std::unique_ptr<Policy>(std::make_unique<TablePolicy>(std::move(*actions)));
}

std::string run_file(const std::string& path) {
  struct stat status{};
  const bool folder = stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
  return folder ? path + (path.ends_with('/') ? "" : "/") + "run.quoll" : path;
}

}  // namespace quoll::cli
