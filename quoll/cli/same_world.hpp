#pragma once
// Whether a saved run is about the world of the command line.

#include <optional>
#include <string>
#include <string_view>

#include "quoll/base/error.hpp"
#include "quoll/env/world.hpp"
#include "quoll/experiment/run.hpp"

namespace quoll::cli {

/// Nothing if the run in `file` learned this world: the same model, or, where no model is known,
/// the same built-in world with the same parameters, those left out at their standard. Else one
/// line with both.
Result<void> check_same_world(const Run& run, const std::string& file, const World& world);
bool same_world(const World& one, const World& other);

/// Nothing if what the run learned can be played in this world: the same one, or the same game of
/// two who move in turn, where somebody else has the other side (board::OpponentSettings); states,
/// observations and actions are then the same. Else one line.
Result<void> check_same_game(const Run& run, const std::string& file, const World& world);
/// The same for who is the opponent in a game of this name with these parameters; the learner's
/// discount is nothing to it.
Result<void> check_opponent(const Run& run, const std::string& file, std::string_view game,
                            const Parameters& parameters);

/// The parameters of a game without those that say who plays on which side: both sides are one's
/// own. Nothing for worlds without an opponent, and where there is none.
std::optional<Parameters> without_opponent(const World& world);

}  // namespace quoll::cli
