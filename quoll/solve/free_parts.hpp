#pragma once
// Where one moves for nothing, at discount 1: end components whose choices earn nothing, or earn
// on the way there what they cost on the way back. A value found by sweeps may circle there for
// ever, so that all states of such a part share one value, each with its height. de Alfaro 1997,
// section 3.3 (collapsing); heights are the potentials of Ng, Harada and Russell 1999.

#include <cstdint>
#include <vector>

#include "quoll/model/graph.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

class FreeParts {
 public:
  /// The end components of choices without reward that keep to live states; all heights are 0.
  FreeParts(const Mdp& mdp, const std::vector<std::uint8_t>& live);

  /// Finds those in which rewards of both signs balance, near `value`, an approximation of the
  /// optimum that no number is larger than `size` in. Heights are multiples of 2^-26 of size's
  /// power of two; where those prove no balance, as with thirds, nothing is found. Cost: two more
  /// searches for end components, only where rewards have both signs.
  void balance(const std::vector<double>& value, double size);

  std::uint32_t count() const { return parts_.count; }
  const EndComponents& parts() const { return parts_; }
  /// Whether a choice earns nothing but height, and stays in its part.
  bool inside(std::uint64_t choice) const { return parts_.inside[choice]; }
  /// The part of a state, or no_component.
  std::uint32_t part(State s) const { return parts_.component[s]; }

  /// Gives all states of a part the greatest number among them.
  void share(std::vector<double>& number) const;
  /// The same for values, which differ by their heights; rounded up so that they do so exactly.
  void level_up(std::vector<double>& value) const;
  /// The least among them, rounded down.
  void level_down(std::vector<double>& value) const;

 private:
  template <class Round>
  void level(std::vector<double>& value, double sign, Round round) const;
  double height(State s) const { return height_.empty() ? 0.0 : height_[s]; }
  bool keeps_to_live(std::uint64_t choice) const;
  bool balanced(State s, std::uint64_t choice) const;

  const Mdp& mdp_;
  const std::vector<std::uint8_t>& live_;
  EndComponents parts_;
  std::vector<double> height_;  // empty = all 0
  double grid_ = 0.0;           // of the values of a part with heights
};

}  // namespace quoll
