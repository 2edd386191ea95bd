#pragma once
// One lane of a MinAtar game whose state and draws a test decides.

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "quoll/env/world.hpp"

namespace quoll::minatar_tests {

inline Tree number(int value) {
  return Tree(std::int64_t{value});
}
inline Tree word(std::string text) {
  return Tree(std::move(text));
}

using Fields = std::vector<std::pair<std::string, Tree>>;

inline Tree object(Fields fields) {
  return Tree(Tree::Object(std::move(fields)));
}

/// A board with these cells {x, y}.
inline Tree board(const std::vector<std::pair<int, int>>& cells) {
  std::vector<std::string> rows(10, "..........");
  for (const auto& [x, y] : cells) rows[y][x] = '#';
  Tree::List list;
  for (std::string& row : rows) list.emplace_back(std::move(row));
  return Tree(std::move(list));
}

class Game {
 public:
  explicit Game(const std::string& name, const Parameters& parameters = {},
                std::vector<double> start_draws = {})
      : draws_(std::make_shared<std::vector<double>>(std::move(start_draws))),
        world_(find_world(name, parameters)) {
    environment_ = world_->make({1, 1, 0, draws_});
    observation_.resize(environment_->spaces().observation);
    next_.resize(observation_.size());
    const std::uint8_t all = 1;
    Experience now = columns();
    environment_->restart({&all, 1}, now);
  }

  /// Changes these fields of the state; gives what was wrong with them, or "".
  std::string set(const Fields& fields) {
    Tree changed = state();
    for (const auto& [name, value] : fields) {
      for (auto& [key, field] : std::get<Tree::Object>(changed.value)) {
        if (key == name) field = value;
      }
    }
    State at = 0;
    const Result<void> done = environment_->inspector()->set(0, changed, at);
    return done ? "" : done.error().expected;
  }
  /// One step that is not sticky, with the draws after that one.
  Feedback step(Action action, const std::vector<double>& draws = {}) {
    draws_->push_back(0.5);
    draws_->insert(draws_->end(), draws.begin(), draws.end());
    return go(action);
  }
  /// One step with exactly these draws.
  Feedback step_with(Action action, const std::vector<double>& draws) {
    draws_->insert(draws_->end(), draws.begin(), draws.end());
    return go(action);
  }
  /// Whether every draw asked for was there.
  bool draws_left() { return environment_->inspector()->draws_left(); }

  Tree state() { return environment_->inspector()->state(0, 0); }
  Tree at(const std::string& name) {
    const Tree all = state();
    const Tree* const found = all.find(name);
    return found ? *found : Tree();
  }
  int whole(const std::string& name) {
    return static_cast<int>(std::get<std::int64_t>(at(name).value));
  }
  std::string words(const std::string& name) { return std::get<std::string>(at(name).value); }
  bool flag(const std::string& name) { return std::get<bool>(at(name).value); }
  std::size_t size(const std::string& name) { return std::get<Tree::List>(at(name).value).size(); }

  /// What the last step showed in one channel, as cells {x, y} in reading order.
  std::vector<std::pair<int, int>> cells(std::size_t channel) const {
    const std::size_t channels = observation_.size() / 100;
    std::vector<std::pair<int, int>> found;
    for (int i = 0; i < 100; ++i) {
      if (next_[static_cast<std::size_t>(i) * channels + channel] != 0.0f) {
        found.emplace_back(i % 10, i / 10);
      }
    }
    return found;
  }
  const World& world() const { return *world_; }
  Environment& environment() { return *environment_; }

 private:
  Experience columns() {
    return {{&state_, 1}, {&action_, 1}, {&feedback_, 1}, {&after_, 1}, observation_, next_};
  }
  Feedback go(Action action) {
    action_ = action;
    Experience now = columns();
    environment_->step(now);
    return feedback_;
  }

  std::shared_ptr<std::vector<double>> draws_;
  Result<World> world_;
  std::unique_ptr<Environment> environment_;
  State state_ = 0, after_ = 0;
  Action action_ = 0;
  Feedback feedback_;
  std::vector<float> observation_, next_;
};

enum : Action { stay, left, up, right, down, fire };
using Cells = std::vector<std::pair<int, int>>;

}  // namespace quoll::minatar_tests
