#pragma once
// The taxi's 5 x 5 town: where its walls and places are, and what an action does there.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "quoll/env/drawing.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// Places are R 0, G 1, Y 2, B 3; passenger 4 = aboard.
struct Cab {
  std::uint32_t row = 0, column = 0, passenger = 0, destination = 0;

  bool operator==(const Cab&) const = default;
};
inline constexpr std::uint32_t aboard = 4;
inline constexpr State cab_states = 500;

/// ((row * 5 + column) * 5 + passenger) * 4 + destination, and back.
State cab_number(const Cab& cab);
Cab cab_of(State number);

/// Whether the passenger has arrived: the taxi stands at the place where both are.
bool has_arrived(const Cab& cab);
/// Whether an episode may begin so: the passenger waits, and not at the destination.
bool may_start(const Cab& cab);

struct CabMove {
  Cab cab;
  double reward = -1.0;
};
/// One action, nothing random: south 0, north 1, east 2, west 3, pickup 4, dropoff 5.
CabMove drive(const Cab& cab, Action action);
/// The two ways rain may push a taxi that moves: to the left and to the right of its heading.
std::array<Action, 2> sides_of(Action heading);

/// "r2c3-R-to-G", "r2c3-aboard-to-G".
std::string cab_name(const Cab& cab);
/// The map with its walls, the taxi as t or, with the passenger aboard, T, and a line of words.
std::string cab_text(const Cab& cab);
Drawing cab_drawing(const Cab& cab);

}  // namespace quoll
