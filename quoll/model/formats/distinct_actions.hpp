#pragma once
// Model files of other programs let several choices of a state carry the same action, or none.

#include "quoll/model/mdp.hpp"

namespace quoll {

/// Makes `given`, which `arrays.action` leads into, the names of the actions. As NumberedModel
/// does, a choice without a proper name is called by its number in its state, and a name that
/// another choice of the state has gets that number behind it ("go.1"); the first such is a remark.
/// Linear.
void name_actions(MdpArrays& arrays, Names given);

}  // namespace quoll
