#pragma once
// What an update rule is, and the one place where a rule changes a value. A rule gives the target
// of an update; loads, masks, step sizes and loops are the engine's.

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>

#include "quoll/base/archive.hpp"
#include "quoll/learn/step_size.hpp"

namespace quoll {

struct LearnSetup;

/// What a rule aims at: the reward it went by (observed, or its own estimate) and the target.
struct Target {
  double reward, value;
};

/// `target` is called once per update, after the visit was counted (n >= 1); `learned` with the
/// value that was stored. A rule with own_step takes the whole step (step size 1) and refuses
/// others.
template <class R>
concept UpdateRule =
    requires(R rule, std::uint64_t pair, double x, std::uint32_t n, Archive& archive) {
      typename R::Value;
      { R::own_step } -> std::convertible_to<bool>;
      { rule.target(pair, x, x, x, n) } -> std::same_as<Target>;
      rule.learned(pair, x);
      rule.persist(archive);
    };

/// One update in numbers.
template <class Value>
struct Revision {
  double reward, target, step_size;
  Value value;
};

/// Bits with which round_at_random() gives the nearest float.
inline constexpr std::uint32_t nearest_rounding = ~std::uint32_t{0};

/// `x` as a float, up or down at random so that the mean is x: increments below half an ulp still
/// count on average. `bits` are 32 random bits.
inline float round_at_random(double x, std::uint32_t bits) {
  const float near = static_cast<float>(x);
  const double rest = x - double{near};
  if (rest == 0.0 || !std::isfinite(near)) return near;
  const bool up = rest > 0.0;
  const float other = std::nextafterf(near, up ? HUGE_VALF : -HUGE_VALF);
  const double share = rest / (double{other} - double{near});
  return bits * 0x1p-32 < share ? other : near;
}

/// The new value of a pair: old + step_size * (target - old), rounded once; exactly the target when
/// the step size is 1. Diminishing and small steps on floats round at random: there an increment
/// can be less than half an ulp.
template <UpdateRule Rule, class Step>
inline Revision<typename Rule::Value> revise(Rule& rule, const Step& step, std::uint64_t pair,
                                             typename Rule::Value old, double reward,
                                             double discount, double best_next, std::uint32_t n,
                                             std::uint32_t bits) {
  using Value = typename Rule::Value;
  const Target target = rule.target(pair, reward, discount, best_next, n);
  if (Rule::own_step || step.one()) {
    return {target.reward, target.value, 1.0, static_cast<Value>(target.value)};
  }
  const double alpha = step.at(n);
  const double moved = double{old} + alpha * (target.value - double{old});
  if constexpr (sizeof(Value) == 4) {
    if (step.small()) {
      return {target.reward, target.value, alpha, round_at_random(moved, bits)};
    }
  }
  return {target.reward, target.value, alpha, static_cast<Value>(moved)};
}

}  // namespace quoll
