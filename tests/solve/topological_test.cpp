// One component after the other.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "models.hpp"
#include "quoll/solve/components.hpp"

namespace quoll {
namespace {

// A, B and C, D go round; B leads on to C, D to the end.
MdpBuilder two_circles(double discount) {
  MdpBuilder b(discount);
  b.move("A", "go", "B", -1);
  b.move("B", "back", "A", -1).move("B", "on", "C", -1, 0.5).move("B", "on", "B", -1, 0.5);
  b.move("C", "go", "D", -1).move("D", "back", "C", -1).move("D", "out", "END", -4);
  return b;
}

TEST(Topological, ComponentsComeAfterWhatFollows) {
  const Mdp mdp = test::built(two_circles(1.0));
  std::vector<std::uint8_t> live(mdp.states(), 1);
  live[*mdp.find_state("END")] = 0;
  const Components parts(mdp, live);
  ASSERT_EQ(parts.count(), 2u);
  const auto names = [&](std::size_t k) {
    std::string text;
    for (const State s : parts[k]) text += mdp.state_name(s);
    return text;
  };
  EXPECT_EQ(names(0), "CD");
  EXPECT_EQ(names(1), "AB");
}

// V(D) = -4, V(C) = -5; from B two tries: -2 - 5 = -7, V(A) = -8.
TEST(Topological, SolvesCircleAfterCircle) {
  const Mdp mdp = test::built(two_circles(1.0));
  const auto found = solve(mdp, {}, "topological");
  ASSERT_TRUE(found) << message(found.error());
  EXPECT_TRUE(found->converged);
  const std::pair<const char*, double> expected[] = {{"A", -8}, {"B", -7}, {"C", -5}, {"D", -4}};
  for (const auto& [name, value] : expected) {
    EXPECT_LE(found->lower[*mdp.find_state(name)], value) << name;
    EXPECT_GE(found->upper[*mdp.find_state(name)], value) << name;
  }
}

// Without an end, at 0.999: all of 1 + 0.999 + ... = 1000 in E and F; G comes there for 2 by a
// coin: V = 2 + 0.999 (V / 2 + 1000 / 2), V = 501.5 / 0.5005.
TEST(Topological, ACircleWithoutAnEndIsLevelled) {
  MdpBuilder b(0.999);
  b.move("E", "go", "F", 1).move("F", "go", "E", 1, 0.5).move("F", "go", "F", 1, 0.5);
  b.move("G", "coin", "G", 2, 0.5).move("G", "coin", "E", 2, 0.5);
  const Mdp mdp = test::built(b);
  const auto found = solve(mdp, {}, "topological");
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->converged);
  EXPECT_NEAR(found->lower[*mdp.find_state("E")], 1000.0, 1e-6);
  EXPECT_NEAR(found->upper[*mdp.find_state("G")], 501.5 / 0.5005, 1e-6);
  EXPECT_LT(found->sweeps, 100u);
}

// A chain of 300 pairs, each of which goes round; with a way back from the last to the first pair
// all is one component.
Mdp pairs(bool back) {
  MdpBuilder b(0.9);
  for (unsigned k = 0; k < 300; ++k) {
    const std::string one = "a" + std::to_string(k), other = "b" + std::to_string(k);
    b.move(one, "go", other, -1);
    b.move(other, "try", one, -1, 0.5);
    b.move(other, "try", k == 299 ? "END" : "a" + std::to_string(k + 1), -1, 0.5);
  }
  if (back) b.move("b299", "back", "a0", -1);
  return test::built(b);
}

TEST(Topological, IsChosenWhereComponentsAreSmall) {
  EXPECT_TRUE(Components::many(pairs(false)));
  EXPECT_FALSE(Components::many(pairs(true)));
  EXPECT_EQ(solve(pairs(false))->method, "topological");
  EXPECT_NE(solve(pairs(true))->method, "topological");
}

// One pair: V(a) = -1 + V(b), V(b) = -1 + (V(a) + next) / 2: V(a) = -4 + next. So -4 (300 - k).
TEST(Topological, CountsExactlyOnALongChain) {
  SolveSettings settings;
  settings.discount = 1.0;
  const Mdp mdp = pairs(false);
  const auto found = solve(mdp, settings);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->method, "topological");
  EXPECT_TRUE(found->converged);
  EXPECT_NEAR(found->lower[*mdp.find_state("a0")], -1200.0, 1e-6);
  EXPECT_NEAR(found->upper[*mdp.find_state("a299")], -4.0, 1e-6);
}

}  // namespace
}  // namespace quoll
