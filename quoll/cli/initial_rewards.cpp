#include "quoll/cli/initial_rewards.hpp"

#include <cmath>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"

namespace quoll::cli {
namespace {

// The choice of a named state and action.
Result<std::uint64_t> find_choice(const Mdp& mdp, std::string_view state, std::string_view action,
                                  Error place) {
  const auto s = mdp.find_state(state);
  if (!s) {
    place.expected = "no state '" + std::string(state) + "'";
    place.nearest = mdp.arrays().state_names.nearest(state);
    return place;
  }
  Nearest nearest(action);
  for (std::uint64_t c = mdp.choice_begin(*s); c < mdp.choice_end(*s); ++c) {
    if (mdp.action_name(c) == action) return c;
    nearest.offer(mdp.action_name(c));
  }
  place.expected = "no action '" + std::string(action) + "' at " + std::string(state);
  place.nearest = nearest.best();
  return place;
}

}  // namespace

Result<std::vector<double>> initial_rewards(const std::string& text, const World& world) {
  if (!world.mdp) return std::vector<double>();
  const Mdp& mdp = *world.mdp;
  if (text == "world") return mdp.arrays().reward;
  std::vector<double> rewards(mdp.choices(), 0.0);
  if (text == "zero") return rewards;
  if (text.find('.') == std::string::npos) {
    return Error{"--initial-rewards", 0, 0,
                 "world, zero or a CSV file expected, not '" + text + "'",
                 nearest(text, std::vector<std::string>{"world", "zero"})};
  }
  const Result<std::string> content = read_file(text);
  if (!content) return content.error();
  std::uint64_t number = 0;
  for (const std::string_view line : split(*content, '\n')) {
    Error place{text, ++number, 0, "", ""};
    if (number == 1) {
      if (line == "state,action,reward") continue;
      place.expected = "the header state,action,reward expected, not '" + std::string(line) + "'";
      return place;
    }
    if (line.empty()) continue;
    const std::vector<std::string_view> fields = split(line, ',');
    const auto reward = fields.size() == 3 ? parse_number(fields[2]) : std::nullopt;
    if (!reward || !std::isfinite(*reward)) {
      place.expected = "state,action,reward with a finite number expected";
      return place;
    }
    const Result<std::uint64_t> choice = find_choice(mdp, fields[0], fields[1], place);
    if (!choice) return choice.error();
    rewards[*choice] = *reward;
  }
  return rewards;
}

}  // namespace quoll::cli
