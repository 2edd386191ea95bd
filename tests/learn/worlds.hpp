#pragma once
// Small worlds for the tests of learning.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "quoll/env/mdp_environment.hpp"
#include "quoll/env/world.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/model/builder.hpp"

namespace quoll::learn_tests {

/// GATE-POOL, POOL-HALL, HALL-CAVE, POOL-CAVE, POOL-WELL, CAVE -> GOAL and WELL -> GOAL with 100.
inline World adventure() {
  return *find_world("adventure");
}

/// `n` cells in a row, left and right; the last step to the right ends with 1.
inline World corridor(int n, double discount = 0.9) {
  MdpBuilder builder(discount);
  const auto name = [](int i) { return "c" + std::to_string(i); };
  for (int i = 0; i < n; ++i) {
    builder.move(name(i), "left", name(i > 0 ? i - 1 : 0));
    if (i + 1 < n)
      builder.move(name(i), "right", name(i + 1));
    else
      builder.move(name(i), "right", "END", 1.0);
  }
  builder.start(name(0));
  return to_world("corridor", *builder.build());
}

/// The corridor with steps that slip back with probability 1/4 and cost 1/8 each.
inline World slippery(int n, double discount = 0.9) {
  MdpBuilder builder(discount);
  const auto name = [](int i) { return "c" + std::to_string(i); };
  for (int i = 0; i < n; ++i) {
    const std::string back = name(i > 0 ? i - 1 : 0), on = i + 1 < n ? name(i + 1) : "END";
    const double end = i + 1 < n ? -0.125 : 1.0;
    builder.move(name(i), "left", back, -0.125, 0.75).move(name(i), "left", on, end, 0.25);
    builder.move(name(i), "right", on, end, 0.75).move(name(i), "right", back, -0.125, 0.25);
  }
  builder.start(name(0));
  return to_world("slippery", *builder.build());
}

/// Five actions in a state, so that rows are ragged.
inline World star() {
  MdpBuilder builder(0.5);
  for (int i = 0; i < 5; ++i) {
    const std::string arm = "arm" + std::to_string(i);
    builder.move("HUB", "to" + std::to_string(i), arm, i);
    builder.move(arm, "back", "HUB", 1).move(arm, "end", "END", 2.0 * i);
  }
  builder.start("HUB");
  return to_world("star", *builder.build());
}

/// A thief's choice: A earns 1 and stays, or walks through B to the end with a random prize.
inline World lottery() {
  MdpBuilder builder(0.5);
  builder.move("A", "stay", "A", 1.0).move("A", "walk", "B", 0.0);
  builder.move("B", "draw", "END", 8.0, 0.5).move("B", "draw", "END", 0.0, 0.5);
  builder.move("B", "back", "A", 0.25);
  builder.start("A").start("B");
  return to_world("lottery", *builder.build());
}

/// Two players take one to three of six stones in turn; the last stone earns 8, others cost or earn
/// something. Rows of two and three actions, ties on the way; no way back, where floats might
/// circle.
inline World game() {
  MdpBuilder builder(0.75);
  for (int i = 0; i < 6; ++i) {
    const std::string from = "p" + std::to_string(i);
    for (int take = 1; take <= 2 + i % 2; ++take) {
      const bool last = i + take >= 6;
      builder.move(from, "take" + std::to_string(take),
                   last ? "END" : "p" + std::to_string(i + take), last ? 8 : take - 2);
    }
  }
  builder.start("p0");
  builder.alternating(true);
  return to_world("game", *builder.build());
}

/// The same world as something that can only be acted in.
inline World without_model(World world) {
  world.name += " without a model";
  world.make = mdp_environments(world.mdp);
  world.mdp.reset();
  return world;
}

inline std::unique_ptr<Learner> learner(const LearnSettings& settings, const World& world) {
  return std::move(*make_learner(settings, world));
}

inline std::vector<std::byte> saved(Learner& learner) {
  Archive archive;
  archive("learner", learner);
  return archive.bytes();
}

}  // namespace quoll::learn_tests
