#pragma once
// One lane of a world, set to states given as lists of numbers and stepped by hand.

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "quoll/env/world.hpp"

namespace quoll::world_tests {

class OneLane {
 public:
  explicit OneLane(const std::string& name, const Parameters& parameters = {},
                   std::uint64_t seed = 1)
      : world(find_world(name, parameters)) {
    EXPECT_TRUE(world) << (world ? "" : world.error().expected);
    lane_ = world->make({1, seed, 0, nullptr});
    const std::uint32_t size = lane_->spaces().observation;
    seen.resize(size);
    next_seen.resize(size);
  }
  void restart() {
    const std::uint8_t yes = 1;
    Experience now = columns();
    lane_->restart({&yes, 1}, now);
  }
  Feedback step(Action action) {
    action_ = action;
    Experience now = columns();
    lane_->step(now);
    return feedback_;
  }
  bool set(const std::vector<double>& numbers) {
    Tree::List list;
    for (const double number : numbers) list.emplace_back(number);
    return bool(lane_->inspector()->set(0, Tree(std::move(list)), state));
  }
  std::vector<double> numbers() const {
    std::vector<double> numbers;
    const Tree tree = lane_->inspector()->state(0, state);
    for (const Tree& item : std::get<Tree::List>(tree.value)) {
      numbers.push_back(std::get<double>(item.value));
    }
    return numbers;
  }
  std::string text() const { return lane_->inspector()->text(0, state); }
  Drawing drawing() const { return lane_->inspector()->drawing(0, state); }
  const Environment& environment() const { return *lane_; }

  Result<World> world;
  State state = 0, next = 0;
  std::vector<float> seen, next_seen;  ///< after restart(), after step()

 private:
  Experience columns() {
    return {{&state, 1}, {&action_, 1}, {&feedback_, 1}, {&next, 1}, seen, next_seen};
  }

  std::unique_ptr<Environment> lane_;
  Action action_ = 0;
  Feedback feedback_;
};

inline void expect_near(const std::vector<double>& found, const std::vector<double>& expected,
                        double distance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], distance) << i;
}

}  // namespace quoll::world_tests
