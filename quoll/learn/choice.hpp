#pragma once
// Which method fits a world, by what the world declares of itself; never by a measurement.

#include <optional>
#include <string>

#include "quoll/learn/settings.hpp"

namespace quoll {

/// A way to learn, and why.
struct MethodChoice {
  std::string method, start;  ///< as --method and --start say it
  std::string reason;         ///< one sentence
  std::string options() const { return "--method " + method + " --start " + start; }
};

/// In this order:
///   states that cannot be listed      -> linear-q where ranges of the observed numbers are known,
///                                        else q-learning, and resolve() says why it cannot
///   two players, or so few pairs that chance visits them all, or so many that a model is too large
///                                     -> q-learning, the lecture's own
///   can be put into any state         -> empirical-model, each pair in turn
///   rewards declared, values bounded  -> optimistic-model
///   else                              -> dyna-q; prioritised-sweeping where steps are dear
MethodChoice choose_method(const World& world, const LearnSettings& settings);

/// Puts the choice into settings whose method is "auto"; a start that was given stays. Returns the
/// choice, or nothing for any other method.
std::optional<MethodChoice> settle_method(const World& world, LearnSettings& settings);

}  // namespace quoll
