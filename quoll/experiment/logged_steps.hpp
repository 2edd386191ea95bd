#pragma once
// Steps from logs (quoll/model/formats/step_log.hpp), as numbers of states and actions.

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "quoll/base/error.hpp"
#include "quoll/learn/update.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// The only action of a state that logs show as a successor alone.
inline constexpr std::string_view unknown_action = "(unknown)";

/// The states and actions that logs name, as a model of which nothing else is true: every action
/// stays where it is and earns nothing. A state that is shown only after an end has no action; one
/// that followed a step but in which nobody acted has `unknown_action`. Episodes begin where those
/// of the logs do: at the first row of a file and after each row that ended or was cut off.
/// `discount` is the model's. Cost: one pass.
Result<Mdp> names_in_logs(std::span<const std::string> files, double discount);

/// Hands out all steps in order, some at a time: step, state, action, reward, next, terminated and
/// truncated are set. A state or action is a name, else its number from 0 (of an action: in its
/// state). Error: the first row that is none, or that names what `names` does not have, with the
/// nearest name. Cost: one pass; a table of all names.
Result<void> read_steps(std::span<const std::string> files, const Mdp& names,
                        const std::function<void(std::span<const Update>)>& take);

}  // namespace quoll
