#include "quoll/env/worlds/board_opponent.hpp"

namespace quoll::board {

Result<Opponent> OpponentSettings::kind(bool has_perfect) const {
  if (opponent == "self") return Opponent::self;
  if (opponent == "uniform") return Opponent::uniform;
  if (opponent == "perfect" && has_perfect) return Opponent::perfect;
  if (from_file()) return Opponent::file;
  std::vector<std::string> names{"self", "uniform"};
  if (has_perfect) names.emplace_back("perfect");
  return Error{"--with opponent", 0, 0,
               std::string("self, uniform") + (has_perfect ? ", perfect" : "") +
                   " or a file .csv, .json or .quoll expected, not '" + opponent + "'",
               nearest(opponent, names)};
}

}  // namespace quoll::board
