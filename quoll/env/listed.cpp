#include "quoll/env/listed.hpp"

#include <utility>

namespace quoll {

Result<std::shared_ptr<const Mdp>> listed(const World& world) {
  if (world.mdp) return world.mdp;
  if (world.traits.states == 0) {
    return Error{"", 0, 0, "the states of " + world.name + " cannot be listed", ""};
  }
  const std::unique_ptr<Environment> environment = world.make({});
  const Spaces spaces = environment->spaces();
  MdpArrays arrays;
  arrays.discount = world.discount;
  arrays.choice_begin.push_back(0);
  if (!world.state_name) arrays.state_names = Names::numbered("", spaces.states);
  for (State s = 0; s < spaces.states; ++s) {
    if (world.state_name) arrays.state_names.push_back(world.state_name(s));
    const Action count = environment->actions(s);
    for (Action a = 0; a < count; ++a) {
      arrays.action.push_back(a);
      arrays.next.push_back(s);
      arrays.reward.push_back(0.0);
    }
    arrays.choice_begin.push_back(arrays.action.size());
  }
  if (world.action_names.empty()) {
    arrays.action_names = Names::numbered("", spaces.actions);
  } else {
    for (const std::string& name : world.action_names) arrays.action_names.push_back(name);
  }
  Result<Mdp> mdp = Mdp::make(std::move(arrays));
  if (!mdp) return mdp.error();
  return std::make_shared<const Mdp>(std::move(*mdp));
}

}  // namespace quoll
