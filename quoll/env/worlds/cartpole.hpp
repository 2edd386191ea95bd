#pragma once
// The cart and pole of worlds/cartpole.cpp: one lane as a plain struct, many lanes as columns.

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "quoll/env/binned.hpp"
#include "quoll/env/worlds/control.hpp"

namespace quoll {
namespace cartpole {

inline constexpr double gravity = 9.8;
inline constexpr double pole_mass = 0.1;
inline constexpr double total_mass = 0.1 + 1.0;
inline constexpr double half_pole = 0.5;
inline constexpr double pole_moment = pole_mass * half_pole;
inline constexpr double force_size = 10.0;
inline constexpr double step_seconds = 0.02;
inline constexpr double track_end = 2.4;
inline constexpr double angle_end = 12 * 2 * pi / 360;
inline constexpr double start_size = 0.05;

// The Taylor series of sin x / x - 1 over x^2, and of cos x - 1 over x^2, in x^2, from the last
// term to the first. No angle is beyond 12 degrees: what is left out is below 2e-17 of the value
// (in float: 1e-10).
template <class Real>
inline constexpr auto sine_terms = std::to_array<Real>({-1.0f / 5040, 1.0f / 120, -1.0f / 6});
template <>
inline constexpr auto sine_terms<double> =
    std::to_array({-1.0 / 39916800, 1.0 / 362880, -1.0 / 5040, 1.0 / 120, -1.0 / 6});
template <class Real>
inline constexpr auto cosine_terms = std::to_array<Real>({-1.0f / 720, 1.0f / 24, -0.5f});
template <>
inline constexpr auto cosine_terms<double> =
    std::to_array({-1.0 / 3628800, 1.0 / 40320, -1.0 / 720, 1.0 / 24, -0.5});

template <const auto& terms, class Number, std::size_t... i>
[[gnu::always_inline]] inline void series(const Number& z, Number& sum, std::index_sequence<i...>) {
  sum = z * terms[0] + terms[1];
  ((sum = sum * z + terms[i + 2]), ...);
}

/// One step in this program's own arithmetic, for one lane or for a vector of lanes (Number), with
/// the same bits: + - * and one division of Reals.
template <class Real, class Number>
[[gnu::always_inline]] inline void move(Number& x, Number& speed, Number& angle, Number& turning,
                                        const Number& force) {
  constexpr auto moment = static_cast<Real>(pole_moment);
  constexpr auto per_mass = static_cast<Real>(1.0 / total_mass);
  constexpr auto moment_per_mass = static_cast<Real>(pole_moment / total_mass);
  constexpr auto inertia = static_cast<Real>(half_pole * 4.0 / 3.0);
  constexpr auto inertia_loss = static_cast<Real>(half_pole * pole_mass / total_mass);
  constexpr auto pull = static_cast<Real>(gravity);
  constexpr auto seconds = static_cast<Real>(step_seconds);
  const Number z = angle * angle;
  Number odd, even;
  series<sine_terms<Real>>(z, odd, std::make_index_sequence<sine_terms<Real>.size() - 2>());
  series<cosine_terms<Real>>(z, even, std::make_index_sequence<cosine_terms<Real>.size() - 2>());
  const Number sine = angle + angle * (z * odd);
  const Number cosine = even * z + Real{1};
  const Number push = (force + (turning * turning) * sine * moment) * per_mass;
  const Number angular = (sine * pull - cosine * push) / (inertia - cosine * cosine * inertia_loss);
  const Number linear = push - angular * cosine * moment_per_mass;
  x = x + speed * seconds;
  speed = speed + linear * seconds;
  angle = angle + turning * seconds;
  turning = turning + angular * seconds;
}

std::string text(const std::array<double, 4>& at);
Drawing drawing(const std::array<double, 4>& at);

}  // namespace cartpole

/// One lane; Real is double or float.
template <class Real>
struct CartPole {
  using Position = std::array<Real, 4>;
  bool sutton_barto_reward;

  Spaces spaces() const {
    Spaces spaces;
    spaces.actions = 2;
    spaces.observation = 4;
    return spaces;
  }
  std::vector<std::string> action_names() const { return {"left", "right"}; }
  std::vector<Measured> measured() const {
    return {{"position", -cartpole::track_end, cartpole::track_end},
            {"velocity", -3.0, 3.0},
            {"angle", -cartpole::angle_end, cartpole::angle_end},
            {"turning rate", -3.5, 3.5}};
  }

  Position start(auto& dice) const {
    Position at;
    for (Real& number : at) {
      number = static_cast<Real>(between(dice, -cartpole::start_size, cartpole::start_size));
    }
    return at;
  }
  Feedback step(Position& at, Action action, auto&) const {
    if (fallen(at)) return {0.0, true, false};
    const auto force =
        static_cast<Real>(action == 1 ? cartpole::force_size : -cartpole::force_size);
    cartpole::move<Real>(at[0], at[1], at[2], at[3], force);
    return outcome(at);
  }
  /// In the order of Gymnasium's source, with the C library's functions.
  Feedback step(Position& at, Action action, GuestDice& dice) const {
    using namespace cartpole;
    if (fallen(at)) return {0.0, true, false};
    const std::array<double, 4> before{at[0], at[1], at[2], at[3]};
    const auto [x, speed, angle, turning] = before;
    const double force = action == 1 ? force_size : -force_size;
    const double cosine = cos_of(dice, angle), sine = sin_of(dice, angle);
    const double push = (force + pole_moment * (turning * turning) * sine) / total_mass;
    const double angular = (gravity * sine - cosine * push) /
                           (half_pole * (4.0 / 3.0 - pole_mass * (cosine * cosine) / total_mass));
    const double linear = push - pole_moment * angular * cosine / total_mass;
    at = {static_cast<Real>(x + step_seconds * speed),
          static_cast<Real>(speed + step_seconds * linear),
          static_cast<Real>(angle + step_seconds * turning),
          static_cast<Real>(turning + step_seconds * angular)};
    return outcome(at);
  }
  void observe(const Position& at, std::span<float> seen) const {
    for (std::size_t i = 0; i < at.size(); ++i) seen[i] = static_cast<float>(at[i]);
  }
  static bool fallen(const Position& at) {
    constexpr auto edge = static_cast<Real>(cartpole::track_end);
    constexpr auto lean = static_cast<Real>(cartpole::angle_end);
    return !(at[0] <= edge && at[0] >= -edge && at[2] <= lean && at[2] >= -lean);
  }
  double reward(bool ended) const { return sutton_barto_reward ? (ended ? -1.0 : 0.0) : 1.0; }

  std::string text(const Position& at) const {
    return cartpole::text({at[0], at[1], at[2], at[3]});
  }
  Drawing drawing(const Position& at) const {
    return cartpole::drawing({at[0], at[1], at[2], at[3]});
  }

 private:
  Feedback outcome(const Position& at) const {
    const bool ended = fallen(at);
    return {reward(ended), ended, false};
  }
};

/// As many lanes as wanted, stepped as columns with the processor's vectors: each the struct's
/// bits, in every width of vector up to `most_bytes`. The limit of `lanes` is below 2^31.
template <class Real>
std::unique_ptr<Environment> cartpole_lanes(CartPole<Real> dynamics, const Lanes& lanes,
                                            int most_bytes = 64);

}  // namespace quoll
