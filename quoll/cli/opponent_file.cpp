#include "quoll/cli/opponent_file.hpp"

#include "quoll/base/file.hpp"
#include "quoll/base/json_tree.hpp"
#include "quoll/cli/judged_run.hpp"
#include "quoll/experiment/run.hpp"
#include "quoll/model/formats/fields.hpp"
#include "quoll/report/export_policy.hpp"

namespace quoll::cli {
namespace {

Result<std::string> run_text(const std::string& path, std::string_view world) {
  const Result<Run> run = Run::load(path, false);
  if (!run) return run.error();
  if (run->world().name != world) {
    return Error{path, 0, 0,
                 "this run learned " + run->world().name + ", not " + std::string(world), ""};
  }
  const std::string reason = unsound(*run);
  if (!reason.empty()) return Error{path, 0, 0, "no policy to play by: " + reason, ""};
  const std::string missing = no_table(*run);
  if (!missing.empty()) return Error{path, 0, 0, "no policy to play by: " + missing, ""};
  const std::vector<Action> actions = greedy_policy(run->trainings().front().learner().estimates());
  return policy_csv({run->world().mdp.get(), actions, "", {}});
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

Result<std::string> opponent_text(const std::string& path, std::string_view world) {
  return path.ends_with(".quoll") ? run_text(path, world) : json_rows(path);
}

}  // namespace quoll::cli
