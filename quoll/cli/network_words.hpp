#pragma once
// A network in one line, for people.

#include <cstdint>
#include <string>

#include "quoll/learn/deep/learned_network.hpp"

namespace quoll::cli {

/// The numbers that are learned: weights, biases, gains and shifts.
std::uint64_t numbers_of(const nn::PlainNetwork& network);

/// Sizes from the input to the outputs: "4-128-128-2", with planes and convolutions
/// "10x10x4-16x3-128-3"; of a duel "...-(1+3)", of several networks "... for each of 9 actions".
std::string sizes_of(const LearnedNetwork& network);

/// "network 4-128-128-2, layout shared, 17,410 numbers".
std::string network_words(const LearnedNetwork& network);

}  // namespace quoll::cli
