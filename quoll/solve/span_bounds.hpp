#pragma once
// MacQueen's bounds, made true in spite of rounding. MacQueen 1966; Porteus 1971; Puterman 1994,
// section 6.6. For W = T V and m <= W - V <= M, all of V* and of the greedy policy's value lie in
// [W + g m / (1 - g), W + g M / (1 - g)]; ends count with difference 0.

#include <cstdint>

#include "quoll/model/mdp.hpp"

namespace quoll {

/// What of a model decides how large rounding errors can be.
struct ModelScale {
  std::uint64_t most_outcomes = 1;
  double reward_size = 0.0;    ///< largest |reward|, of outcomes too
  double least_row_sum = 1.0;  ///< at most 1
  double greatest_row_sum = 1.0;
  bool has_ends = false;

  explicit ModelScale(const Mdp& mdp);
};

/// Bound on |computed T V - true T V| in any state, for |V| <= size: rounding, and half an ulp more
/// for each number of the model. Higham 2002, section 3.1.
double sweep_error(const ModelScale& scale, double size);

/// What to add to W: [W + lower, W + upper] holds V*, W + upper satisfies T U <= U, and W + lower
/// satisfies T_policy L >= L for the greedy policy, checked with directed rounding or not.
struct SpanBounds {
  double lower;
  double upper;
  double rounding;  ///< the part of upper - lower that more sweeps cannot remove

  double width() const { return upper - lower; }
};

/// Bounds from differences least <= W - V <= greatest where |V|, |W| <= size, all computed in
/// double. Infinite if the discount leaves no contraction.
SpanBounds span_bounds(const ModelScale& scale, double discount, double least, double greatest,
                       double size);

/// Constants that bound V* and every policy's value before anything is computed: min(0, least
/// reward) / (1 - discount) and max(0, greatest reward) / (1 - discount), moved outward until a
/// checker's own sweep with directed rounding accepts them. Infinite if the discount leaves no
/// contraction.
struct StartBounds {
  double lower;
  double upper;
};
StartBounds start_bounds(const ModelScale& scale, double discount, const Mdp& mdp);

}  // namespace quoll
