#pragma once
// Grids of letters with the agent in one cell, as text and as a picture.

#include <cstdint>
#include <string>
#include <vector>

#include "quoll/env/drawing.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// Rows of equal length. S start, G goal, H hole, C cliff; every other letter is free ground. Cells
/// are numbered in reading order.
using LetterGrid = std::vector<std::string>;

/// One line per row, three characters per cell: " F ", and "[F]" where the agent is.
std::string letter_text(const LetterGrid& grid, State at);

/// Cells of side 1.
Drawing letter_drawing(const LetterGrid& grid, State at);

/// Every cell a state; the actions go (right, down) as listed.
Layout letter_layout(const LetterGrid& grid, std::vector<std::pair<int, int>> direction);

/// The states' names, "r3c14".
Names letter_names(const LetterGrid& grid);

}  // namespace quoll
