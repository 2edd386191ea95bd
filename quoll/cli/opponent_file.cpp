#include "quoll/cli/opponent_file.hpp"

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "quoll/act/policy.hpp"
#include "quoll/base/file.hpp"
#include "quoll/base/json_tree.hpp"
#include "quoll/cli/judged_run.hpp"
#include "quoll/cli/same_world.hpp"
#include "quoll/experiment/run.hpp"
#include "quoll/model/formats/fields.hpp"
#include "quoll/report/export_policy.hpp"

namespace quoll::cli {
namespace {

// A run's policy as somebody who sees; the run stays as long as anybody plays.
SeeingPlayer seeing(Run run) {
  const auto kept = std::make_shared<const Run>(std::move(run));
  return SeeingPlayer([kept]() -> SeeingPlayer::Act {
    const std::shared_ptr<const Policy> policy = kept->trainings().front().learner().policy();
    return [policy, seen = std::vector<float>()](std::span<const float> observation) mutable {
      seen.assign(observation.begin(), observation.end());
      State state = 0;
      Action action = no_action;
      Experience now;
      now.state = {&state, 1};
      now.observation = seen;
      policy->act(now, {&action, 1}, {});
      return action;
    };
  });
}

Result<SavedPolicy> run_policy(const std::string& path, std::string_view world,
                               const Parameters& parameters) {
  Result<Run> run = Run::load(path, false);
  if (!run) return run.error();
  if (run->world().name != world) {
    return Error{path, 0, 0,
                 "this run learned " + run->world().name + ", not " + std::string(world), ""};
  }
  const std::string reason = unsound(*run);
  if (!reason.empty()) return Error{path, 0, 0, "no policy to play by: " + reason, ""};
  if (!no_table(*run).empty()) {
    const Result<void> same = check_opponent(*run, path, world, parameters);
    if (!same) return same.error();
    return SavedPolicy{"", seeing(std::move(*run))};
  }
  const std::vector<Action> actions = greedy_policy(run->trainings().front().learner().estimates());
  return SavedPolicy{policy_csv({run->world().mdp.get(), actions, "", {}}), {}};
}

// The text of a name, or the number of an action.
std::string word_of(const Tree* tree) {
  if (tree == nullptr) return "";
  if (const auto* const name = std::get_if<std::string>(&tree->value)) return as_field(*name);
  if (const auto* const number = std::get_if<std::int64_t>(&tree->value)) {
    return std::to_string(*number);
  }
  return "";
}

Result<std::string> json_rows(const std::string& path) {
  const Result<std::string> content = read_file(path);
  if (!content) return content.error();
  const Result<Tree> json = read_json(*content, path);
  if (!json) return json.error();
  for (const std::string_view key : {"policy", "values"}) {
    const Tree* const found = json->find(key);
    const auto* const rows = found ? std::get_if<Tree::List>(&found->value) : nullptr;
    if (rows == nullptr || rows->empty()) continue;
    std::string text = "state,action\n";
    for (const Tree& row : *rows) {
      text += word_of(row.find("state")) + "," + word_of(row.find("action")) + "\n";
    }
    return text;
  }
  return Error{path, 0, 0,
               "a list \"policy\" or \"values\" expected, complete, as learn and solve write with "
               "--all",
               ""};
}

}  // namespace

Result<SavedPolicy> opponent_policy(const std::string& path, std::string_view world,
                                    const Parameters& parameters) {
  if (path.ends_with(".quoll")) return run_policy(path, world, parameters);
  Result<std::string> rows = json_rows(path);
  if (!rows) return rows.error();
  return SavedPolicy{std::move(*rows), {}};
}

}  // namespace quoll::cli
