#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <filesystem>
#include <fstream>

#include "../../refusal.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

template <class T>
void put(std::string& to, T value) {
  for (int shift = 8 * (static_cast<int>(sizeof value) - 1); shift >= 0; shift -= 8) {
    to += static_cast<char>(value >> shift & 0xff);
  }
}

// A sparse matrix with whole numbers of type Whole.
template <class Whole>
std::string matrix(Whole rows, Whole columns, std::initializer_list<Whole> lengths,
                   std::initializer_list<Whole> places, std::initializer_list<double> values) {
  std::string out;
  for (const Whole number : {Whole{1211216}, rows, columns, static_cast<Whole>(places.size())}) {
    put(out, number);
  }
  for (const Whole length : lengths) put(out, length);
  for (const Whole place : places) put(out, place);
  for (const double value : values) put(out, std::bit_cast<std::uint64_t>(value));
  return out;
}

// Two states, two actions: 0 stays or moves by halves, 1 stays or returns.
template <class Whole>
std::string small() {
  return matrix<Whole>(4, 2, {1, 2, 1, 1}, {0, 0, 1, 1, 0}, {1, 0.5, 0.5, 1, 1});
}

std::string dense_rewards() {
  std::string out;
  for (const std::uint32_t number : {1211216u, 2u, 2u, 0xffffffffu}) put(out, number);
  for (const double value : {1.0, 2.0, 3.0, 0.0}) put(out, std::bit_cast<std::uint64_t>(value));
  return out;
}

std::string file_with(const std::string& content) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("quoll_petsc_" + std::to_string(getpid())))
          .string();
  std::ofstream(path, std::ios::binary)
      .write(content.data(), static_cast<std::streamsize>(content.size()));
  return path;
}

std::string refusal(std::string_view content, const Parameters& given = {}) {
  return tests::refusal_of(parse_model(content, "P.bin", given));
}

TEST(Petsc, BothWidthsOfWholeNumbers) {
  const std::string rewards = file_with(dense_rewards());
  for (const std::string& content : {small<std::uint32_t>(), small<std::uint64_t>()}) {
    const auto mdp = parse_model(content, "P.bin", {{"rewards", rewards}, {"discount", "0.9"}});
    ASSERT_TRUE(mdp) << message(mdp.error());
    EXPECT_EQ(mdp->states(), 2u);
    EXPECT_EQ(mdp->actions(1), 2u);
    EXPECT_EQ(mdp->discount(), 0.9);
    EXPECT_EQ(mdp->outcome_end(1) - mdp->outcome_begin(1), 2u);
    EXPECT_EQ(mdp->next(3), 1u);
    EXPECT_EQ(mdp->next(4), 0u);
    EXPECT_EQ(mdp->probability(2), 0.5);
    EXPECT_EQ(mdp->reward(1), 2.0);
    EXPECT_EQ(mdp->reward(2), 3.0);
    EXPECT_EQ(mdp->reward(3), 0.0);
  }
  std::filesystem::remove(rewards);
}

TEST(Petsc, CostsTurnTheSign) {
  const std::string costs = file_with(matrix<std::uint64_t>(2, 2, {1, 1}, {1, 0}, {4, 0.25}));
  const auto mdp =
      parse_model(small<std::uint32_t>(), "P.bin", {{"rewards", costs}, {"costs", "true"}});
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_EQ(mdp->reward(0), 0.0);
  EXPECT_EQ(mdp->reward(1), -4.0);
  EXPECT_EQ(mdp->reward(2), -0.25);
  EXPECT_EQ(mdp->discount(), 0.99);
  std::filesystem::remove(costs);
}

TEST(Petsc, FaultsAreNamed) {
  const std::string whole = small<std::uint32_t>();
  EXPECT_EQ(refusal(""),
            "P.bin: expected a matrix in PETSc's binary format, which begins with 1211216");
  EXPECT_EQ(refusal(whole.substr(0, whole.size() - 1)),
            "P.bin: expected 5 entries in a matrix of 4 x 2, found 75 bytes behind its head");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(refusal(whole.substr(0, size)), "") << size;
  }
  EXPECT_EQ(refusal(matrix<std::uint32_t>(3, 2, {1, 1, 1}, {0, 1, 0}, {1, 1, 1})),
            "P.bin: expected states * actions rows and a column per state, found 3 x 2");
  EXPECT_EQ(refusal(matrix<std::uint32_t>(2, 2, {1, 1}, {0, 2}, {1, 1})),
            "P.bin: row 1: columns below 2 expected");
  EXPECT_EQ(refusal(matrix<std::uint32_t>(2, 2, {1, 3}, {0, 1}, {1, 1})),
            "P.bin: row 1: more entries than the matrix has");
  EXPECT_EQ(refusal(matrix<std::uint32_t>(2, 2, {1, 1}, {0, 1}, {1, -1})),
            "P.bin: state 1, action 0: probability -1 is outside [0, 1]");
  std::string huge;  // 2^40 rows
  for (const std::uint64_t number : {1211216ull, 1ull << 40, 1ull << 20, 1ull << 60})
    put(huge, number);
  EXPECT_TRUE(refusal(huge).starts_with("P.bin: expected 1152921504606846976 entries"));
  const std::string square = file_with(whole);
  EXPECT_EQ(refusal(whole, {{"rewards", square}}),
            square + ": expected a matrix of 2 x 2, states x actions, found 4 x 2");
  std::filesystem::remove(square);
  EXPECT_EQ(refusal(whole, {{"rewards", square}}), square + ": no such file");
}

}  // namespace
}  // namespace quoll
