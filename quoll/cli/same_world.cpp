#include "quoll/cli/same_world.hpp"

#include <algorithm>

#include "quoll/base/text.hpp"
#include "quoll/model/digest.hpp"

namespace quoll::cli {
namespace {

// Every parameter of a built-in world that may differ from its standard.
Parameters resolved(const World& world) {
  Parameters all;
  const WorldEntry* const entry = find_world_entry(world.name);
  for (const ParameterText& one : entry ? entry->parameters() : std::vector<ParameterText>()) {
    all.emplace_back(one.name, one.standard);
    for (const auto& given : world.parameters) {
      if (gives({given}, one.name)) all.back().second = given.second;
    }
  }
  return all;
}

bool same_text(const std::string& one, const std::string& other) {
  const auto number = parse_number(one);
  return one == other || (number && number == parse_number(other));
}

bool same_world(const World& one, const World& other) {
  if (one.mdp && other.mdp) return digest(*one.mdp) == digest(*other.mdp);
  if (one.mdp || other.mdp || one.name != other.name) return false;
  const Parameters first = resolved(one), second = resolved(other);
  return std::equal(first.begin(), first.end(), second.begin(), second.end(),
                    [](const auto& a, const auto& b) {
                      return a.first == b.first && same_text(a.second, b.second);
                    });
}

// "cartpole --with bins=6,6,12,12", "model.tra --goal done"
std::string described(const World& world) {
  std::string text = world.name;
  for (const auto& [key, value] : world.parameters) {
    text += key.starts_with("--") ? " " + key + " " + value : " --with " + key + "=" + value;
  }
  return text;
}

}  // namespace

Result<void> check_same_world(const Run& run, const std::string& file, const World& world) {
  if (same_world(run.world(), world)) return {};
  return Error{file, 0, 0,
               "this run learned " + described(run.world()) +
                   (world.mdp ? ", which is not the model of " : ", not ") + described(world),
               ""};
}

}  // namespace quoll::cli
