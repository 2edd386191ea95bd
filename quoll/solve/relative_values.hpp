#pragma once
// What can be earned per step by staying for ever in a closed part of a model, as certified bounds.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/model/graph.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {

/// Parts of a model, disjoint, that are not left by the choices inside.
struct ClosedParts {
  std::vector<std::uint32_t> part;  ///< per state; no_component = in none
  std::uint32_t count = 0;
  std::vector<bool> inside;  ///< per choice; empty = every choice is
  std::vector<State> zero;   ///< per part: the state whose relative value is 0
};

struct PartGains {
  std::vector<double> lower, upper;  ///< per part
  std::vector<double> value;         ///< per state: relative value, 0 at zero[part] and at ends
  std::vector<Action> policy;        ///< per state; no_action outside the parts and for ends
  std::uint64_t sweeps = 0;
  bool stopped = false;
};

/// The model of the choices inside alone; states in `ended` and in no part become ends. Names are
/// numbers. origin[c] is the choice of `mdp` that choice c was.
struct InnerModel {
  Mdp mdp;
  std::vector<std::uint64_t> origin;
};
Result<InnerModel> inner_model(const Mdp& mdp, const ClosedParts& parts,
                               const std::vector<bool>& ended = {});

/// Bounds on the gain: `policy` earns at least `lower` per step in the long run from every state of
/// its part, and no policy that stays inside earns more than `upper` from any. The two meet if the
/// optimal gain is the same in all states of a part, as it is when one can go from each to each
/// (Puterman 1994, theorem 8.3.2) or when all policies end up in one class. Ends in a part earn 0
/// for ever. Sweeps until upper - lower <= width in each part, or rounding is all that is left.
/// Cost: a sweep over all parts at a time; the number of sweeps grows with the time after which a
/// start is forgotten. Memory: two values and an action a state, and a copy of the choices inside
/// unless all are.
Result<PartGains> part_gains(const Mdp& mdp, const ClosedParts& parts,
                             const SolveSettings& settings);

}  // namespace quoll
