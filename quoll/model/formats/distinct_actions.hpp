#pragma once
// Model files of other programs let several choices of a state carry the same action, or none.

#include "quoll/model/mdp.hpp"

namespace quoll {

/// Gives a state's second choice by the action "a" the new name "a'2", its third "a'3", ... (more
/// strokes if that is taken), and says so in a remark. Needs arrays that fit together. Linear.
void make_actions_distinct(MdpArrays& arrays);

}  // namespace quoll
