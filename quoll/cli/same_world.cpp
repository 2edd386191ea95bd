#include "quoll/cli/same_world.hpp"

#include <algorithm>

#include "quoll/base/text.hpp"
#include "quoll/model/digest.hpp"

namespace quoll::cli {
namespace {

// Every parameter of a built-in world that may differ from its standard.
Parameters resolved(std::string_view name, const Parameters& parameters) {
  Parameters all;
  const WorldEntry* const entry = find_world_entry(name);
  for (const ParameterText& one : entry ? entry->parameters() : std::vector<ParameterText>()) {
    all.emplace_back(one.name, one.standard);
    for (const auto& given : parameters) {
      if (gives({given}, one.name)) all.back().second = given.second;
    }
  }
  return all;
}

bool same_text(const std::string& one, const std::string& other) {
  const auto number = parse_number(one);
  return one == other || (number && number == parse_number(other));
}

bool same_parameters(const Parameters& one, const Parameters& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const auto& a, const auto& b) {
                      return a.first == b.first && same_text(a.second, b.second);
                    });
}

bool says_who_plays(std::string_view parameter) {
  return parameter == "opponent" || parameter == "mark" || parameter == "unknown";
}

// A game of two who move in turn: which sides are the learner's, "x", "o" or "both", and what else
// its parameters say.
struct Game {
  std::string sides;  // empty: no such game
  Parameters rules;

  Game(std::string_view name, const Parameters& parameters) {
    std::string mark;
    for (auto& [key, value] : resolved(name, parameters)) {
      if (key == "opponent") sides = value == "self" ? "both" : "one";
      if (key == "mark") mark = value;
      if (!says_who_plays(key)) rules.emplace_back(key, value);
    }
    if (sides == "one") sides = mark;
  }
  explicit Game(const World& world) : Game(world.name, world.parameters) {}

  bool knows(const std::string& side) const { return sides == "both" || sides == side; }
};

// "cartpole --with bins=6,6,12,12", "model.tra --goal done"
std::string described(const World& world) {
  std::string text = world.name;
  for (const auto& [key, value] : world.parameters) {
    text += key.starts_with("--") ? " " + key + " " + value : " --with " + key + "=" + value;
  }
  return text;
}

Error other_rules(const std::string& file, const World& learned, std::string_view game,
                  const Parameters& parameters) {
  World wanted;
  wanted.name = game;
  for (const auto& one : parameters) {
    if (!says_who_plays(one.first)) wanted.parameters.push_back(one);
  }
  return Error{file, 0, 0,
               "this run learned " + described(learned) + ", not " + described(wanted) +
                   ": who plays may differ, the game may not",
               ""};
}

Error one_side_only(const std::string& file, const World& learned, const std::string& known,
                    const std::string& wanted) {
  return Error{file, 0, 0,
               "this run learned " + described(learned) + ": to move as " + known +
                   ", but here it has to move as " + (wanted == "both" ? "x and as o" : wanted) +
                   "; what is learned with opponent=self can do both",
               ""};
}

}  // namespace

bool same_world(const World& one, const World& other) {
  if (one.mdp && other.mdp) return digest(*one.mdp) == digest(*other.mdp);
  if (one.mdp || other.mdp || one.name != other.name) return false;
  return same_parameters(resolved(one.name, one.parameters),
                         resolved(other.name, other.parameters));
}

Result<void> check_same_game(const Run& run, const std::string& file, const World& world) {
  const World& learned = run.world();
  const Game mine(learned), here(world);
  const bool same_kind = learned.name == world.name && bool{learned.mdp} == bool{world.mdp};
  if (here.sides.empty() || !same_kind || same_world(learned, world)) {
    return check_same_world(run, file, world);
  }
  if (!same_parameters(mine.rules, here.rules)) {
    return other_rules(file, learned, world.name, world.parameters);
  }
  if (mine.knows(here.sides)) return {};
  return one_side_only(file, learned, mine.sides, here.sides);
}

Result<void> check_opponent(const Run& run, const std::string& file, std::string_view game,
                            const Parameters& parameters) {
  const World& learned = run.world();
  Game mine(learned), here(game, parameters);
  for (Parameters* const rules : {&mine.rules, &here.rules}) {
    std::erase_if(*rules, [](const auto& one) { return one.first == "discount"; });
  }
  if (learned.name != game || !same_parameters(mine.rules, here.rules)) {
    return other_rules(file, learned, game, parameters);
  }
  const std::string side = here.sides == "x" ? "o" : "x";
  if (mine.knows(side)) return {};
  return one_side_only(file, learned, mine.sides, side);
}

std::optional<Parameters> without_opponent(const World& world) {
  const Game game(world);
  if (game.sides.empty() || game.sides == "both") return std::nullopt;
  Parameters left = world.parameters;
  std::erase_if(left, [](const auto& one) { return says_who_plays(one.first); });
  return left;
}

Result<void> check_same_world(const Run& run, const std::string& file, const World& world) {
  if (same_world(run.world(), world)) return {};
  return Error{file, 0, 0,
               "this run learned " + described(run.world()) +
                   (world.mdp ? ", which is not the model of " : ", not ") + described(world),
               ""};
}

}  // namespace quoll::cli
