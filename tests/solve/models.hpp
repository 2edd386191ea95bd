#pragma once
// Small models with values computed by hand, shared by the solver tests.

#include <cstdint>
#include <string>
#include <utility>

#include "quoll/model/builder.hpp"
#include "quoll/model/graph.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll::test {

inline Mdp built(const MdpBuilder& builder) {
  Result<Mdp> mdp = builder.build();
  return std::move(*mdp);
}

/// Whether a solver is made for a model of this kind.
inline bool can_do(const SolverEntry& entry, const Mdp& mdp, double discount) {
  if (entry.needs_discount && discount == 1.0) return false;
  if (entry.needs_total && discount < 1.0) return false;
  if (entry.name == "backward-induction") return returning_states(mdp).empty();
  if (entry.name == "game-iteration") return mdp.alternating();
  if (mdp.alternating()) return false;
  return mdp.deterministic() || entry.name != "label-setting";
}
inline bool can_do(const SolverEntry& entry, const Mdp& mdp) {
  return can_do(entry, mdp, mdp.discount());
}

/// The lecture's game: V* = 64, 80, 80, 100, 100 at GATE, HALL, POOL, CAVE, WELL.
inline Mdp adventure(double discount = 0.8) {
  MdpBuilder b(discount);
  b.move("GATE", "To-POOL", "POOL");
  b.move("HALL", "To-CAVE", "CAVE").move("HALL", "To-POOL", "POOL");
  b.move("POOL", "To-CAVE", "CAVE").move("POOL", "To-GATE", "GATE");
  b.move("POOL", "To-HALL", "HALL").move("POOL", "To-WELL", "WELL");
  b.move("CAVE", "To-GOAL", "GOAL", 100).move("CAVE", "To-HALL", "HALL");
  b.move("CAVE", "To-POOL", "POOL");
  b.move("WELL", "To-GOAL", "GOAL", 100).move("WELL", "To-POOL", "POOL");
  return built(b);
}

/// The gambler of Sutton and Barto 2018, example 4.3, with p = 1/4 and goal 4: betting all that
/// helps is optimal. V(1) = p V(2) = 1/16, V(2) = p = 1/4, V(3) = p + (1 - p) V(2) = 7/16.
inline Mdp gambler() {
  MdpBuilder b(1.0);
  const double p = 0.25;
  for (int capital = 1; capital < 4; ++capital) {
    const std::string from = std::to_string(capital);
    for (int stake = 1; stake <= capital && capital + stake <= 4; ++stake) {
      const std::string action = "stake-" + std::to_string(stake);
      b.move(from, action, std::to_string(capital + stake), capital + stake == 4 ? 1.0 : 0.0, p);
      b.move(from, action, std::to_string(capital - stake), 0.0, 1.0 - p);
    }
  }
  b.start("1");
  return built(b);
}

/// Two states without an end. At discount 1/2: B stays and earns 1, V(B) = 2. A waits for
/// V = 0 + (V(A) + V(B)) / 4 = 2/3, or earns 1/2 and stays: V(A) = 1. So V(A) = 1, V(B) = 2.
inline Mdp two_states() {
  MdpBuilder b(0.5);
  b.move("A", "wait", "A", 0.0, 0.5).move("A", "wait", "B", 0.0, 0.5);
  b.move("A", "stay", "A", 0.5);
  b.move("B", "stay", "B", 1.0);
  return built(b);
}

/// Expected moves: from A half the time back to A (cost 1 each), so V(A) = -2; B first pays 3 to go
/// to A or pays 6 to leave at once: V(B) = -5. FREE and ALSO-FREE lead to each other for nothing,
/// and ALSO-FREE to B for nothing: both are worth -5, and only by leaving.
inline Mdp free_circle() {
  MdpBuilder b(1.0);
  b.move("A", "try", "A", -1.0, 0.5).move("A", "try", "END", -1.0, 0.5);
  b.move("B", "go", "A", -3.0).move("B", "leave", "END", -6.0);
  b.move("FREE", "turn", "ALSO-FREE", 0.0);
  b.move("ALSO-FREE", "turn", "FREE", 0.0).move("ALSO-FREE", "go", "B", 0.0);
  b.start("FREE");
  return built(b);
}

/// Going round 1 and 2 is for nothing, at discount 1: 1 pays 4 until it comes to 2, which takes two
/// tries: -8. 2 earns 2 until it comes to 1, which takes four: +8. So V(2) = V(1) + 8; V(0) = V(2)
/// - 2 by its own two tries; V(1) = V(0) / 2 by ending half the time. V(1) = (V(1) + 6) / 2 = 6,
/// V(0) = 12, V(2) = 14, V(3) = V(2) - 1 = 13.
inline Mdp there_and_back() {
  MdpBuilder b(1.0);
  for (const char* name : {"0", "1", "2", "3", "END"}) b.state(name);
  b.move("0", "quit", "END", -4).move("0", "a", "0", -1, 0.25).move("0", "a", "END", -1, 0.75);
  b.move("0", "b", "0", -1, 0.5).move("0", "b", "2", -1, 0.5);
  b.move("1", "quit", "END", -2).move("1", "a", "END", 0, 0.5).move("1", "a", "0", 0, 0.5);
  b.move("1", "b", "1", -4, 0.5).move("1", "b", "2", -4, 0.5);
  b.move("2", "quit", "END", -4).move("2", "a", "1", 2, 0.25).move("2", "a", "2", 2, 0.75);
  b.move("2", "b", "1", 1, 0.5).move("2", "b", "3", 1, 0.5);
  b.move("3", "quit", "END", -4).move("3", "a", "2", -1).move("3", "b", "1", -4);
  return built(b);
}

/// A random model: `states` - 1 states with up to 3 actions of up to 3 outcomes with probabilities
/// in eighths, rewards in quarters, one end that every action may lead to. Linear congruential
/// dice.
inline Mdp random_model(std::uint64_t seed, unsigned states, double discount) {
  std::uint64_t x = seed * 2862933555777941757u + 3037000493u;
  const auto draw = [&x](unsigned below) {
    x = x * 6364136223846793005u + 1442695040888963407u;
    return static_cast<unsigned>((x >> 33) % below);
  };
  MdpBuilder b(discount);
  for (unsigned s = 0; s < states; ++s) b.state(std::to_string(s));
  for (unsigned s = 0; s + 1 < states; ++s) {
    const unsigned actions = 1 + draw(3);
    for (unsigned a = 0; a < actions; ++a) {
      const unsigned first = 1 + draw(5);
      const unsigned second = 1 + draw(7 - first);
      const double reward = -0.25 * draw(9);
      const std::uint32_t action = b.action("a" + std::to_string(a));
      b.move(s, action, draw(states - 1), reward, first / 8.0);
      b.move(s, action, draw(states - 1), reward, second / 8.0);
      if (first + second < 8)
        b.move(s, action, states - 1, reward + draw(5), (8 - first - second) / 8.0);
    }
  }
  return built(b);
}

}  // namespace quoll::test
