#include "quoll/cli/learn_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include "quoll/base/text.hpp"
#include "quoll/report/export_policy.hpp"

namespace quoll::cli {
namespace {

Result<std::optional<World>> open(const WorldOption& option, const GivenSettings& how) {
  if (option.name.empty()) {
    const char* const flag = !option.with.empty()      ? "--with"
                             : !option.goal.empty()    ? "--goal"
                             : !option.rewards.empty() ? "--reward"
                                                       : nullptr;
    if (flag != nullptr) return Error{flag, 0, 0, "needs WORLD", ""};
    return std::optional<World>();
  }
  Result<World> world = option.open(how);
  if (!world) return world.error();
  return std::optional(std::move(*world));
}

Result<void> check_file(const std::string& file) {
  if (file.empty() || file.ends_with(".csv") || file.ends_with(".json")) return {};
  return Error{"-o", 0, 0, "a name that ends in .csv or .json expected, not '" + file + "'", ""};
}

Result<void> write_policy(const std::string& file, const LogLearning& learned,
                          const WorldOption& world, const std::vector<std::string>& logs) {
  if (file.empty()) return {};
  PolicyExport policy;
  policy.mdp = learned.names.get();
  policy.policy = learned.plan.policy;
  policy.name = learned.world.name;
  policy.origin = {fmt::format("learned from {} in {}, discount {}", counted(learned.steps, "step"),
                               counted(logs.size(), "log"), shortest(learned.discount))};
  const std::string text = file.ends_with(".csv") ? policy_csv(policy) : policy_json(policy);
  for (const std::string& log : logs) {
    const Result<void> other = write_output(file, text, {world.name, log});
    if (!other) return other;
  }
  return {};
}

}  // namespace

LogCounts counts_of(const LogLearning& learned) {
  const Mdp& names = *learned.names;
  LogCounts counts;
  std::vector<TriedPair> tried;
  for (State s = 0; s < names.states(); ++s) {
    if (names.terminal(s)) continue;
    const bool unknown = learned.unknown(s);
    counts.unknown += unknown ? 1 : 0;
    if (unknown && learned.named_by_logs) continue;
    for (Action a = 0; a < names.actions(s); ++a) {
      const std::uint32_t visits = learned.model.tried(names.choice_begin(s) + a);
      ++counts.pairs;
      if (visits > 0) tried.push_back({s, a, visits});
    }
  }
  counts.untried = counts.pairs - tried.size();
  const auto shown = static_cast<std::ptrdiff_t>(std::min<std::size_t>(5, tried.size()));
  std::partial_sort(tried.begin(), tried.begin() + shown, tried.end(),
                    [](const TriedPair& a, const TriedPair& b) {
                      return std::tie(a.visits, a.state, a.action) <
                             std::tie(b.visits, b.state, b.action);
                    });
  counts.least.assign(tried.begin(), tried.begin() + shown);
  return counts;
}

Exit learn_log(const WorldOption& world, const OutputOption& output, const GivenSettings& how,
               const std::vector<std::string>& logs) {
  const Result<void> named = check_file(output.file);
  if (!named) return fail(named.error());
  const Result<void> fits = how.check_discount();
  if (!fits) return fail(fits.error());
  RunSettings settings;
  const Result<void> applied = how.apply(settings_of(settings));
  if (!applied) return fail(applied.error());
  const Result<std::optional<World>> opened = open(world, how);
  if (!opened) return fail(opened.error());
  const Result<LogLearning> learned = learn_from_logs(logs, *opened, settings);
  if (!learned) return fail(learned.error());
  const Result<void> written = write_policy(output.file, *learned, world, logs);
  if (!written) return fail(written.error());
  const std::string text = output.json ? log_json(*learned, logs, output.all)
                                       : log_text(*learned, logs, world.name, output.all);
  return print(text) ? done : user_error;
}

}  // namespace quoll::cli
