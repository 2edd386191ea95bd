// A plain struct with start and step becomes a world: a robot with a battery, on a street of ten
// houses. Each parcel delivered at the last house earns 10, each step costs 1, an empty battery
// ends it all.
#include <cstdio>
#include <quoll/quoll.hpp>

struct Courier {
  static constexpr int full = 12;  // steps
  struct Position {
    int house = 0, battery = full;
  };

  quoll::Spaces spaces() const { return {.actions = 3, .states = 10 * (full + 1)}; }

  Position start(auto& dice) const { return {static_cast<int>(dice.below(10)), full}; }

  // 0 = left, 1 = right, 2 = load the battery, which works at house 0 only. Wind may take a step
  // away.
  quoll::Feedback step(Position& at, quoll::Action action, auto& dice) const {
    const bool wind = dice.uniform() < 0.1;
    if (action == 2) {
      if (at.house == 0) at.battery = full;
      return {-1.0, false, false};
    }
    --at.battery;
    if (!wind) at.house += action == 1 ? (at.house < 9 ? 1 : 0) : (at.house > 0 ? -1 : 0);
    if (at.house == 9) return {10.0, true, false};
    if (at.battery == 0) return {-20.0, true, false};
    return {-1.0, false, false};
  }

  quoll::State number(const Position& at) const {
    return static_cast<quoll::State>(at.house * (full + 1) + at.battery);
  }
};

int main() {
  quoll::RunSettings settings;
  settings.steps = 1'000'000;
  settings.learn.explore = "epsilon-greedy";
  const quoll::Learned learned =
      quoll::learn(quoll::to_world("courier", Courier{}, 0.95), settings);

  const auto& played = learned.result().seeds.front().played;
  std::printf("%llu greedy episodes: %.2f on average in %.1f steps\n",
              static_cast<unsigned long long>(played.episodes), played.mean, played.mean_steps);
  const Courier courier;
  const char* const names[] = {"left", "right", "load"};
  for (const int house : {0, 4, 8}) {
    const quoll::Action action = learned.policy()(courier.number({house, Courier::full}));
    std::printf("house %d, full battery: %s\n", house,
                action == quoll::no_action ? "never been there" : names[action]);
  }
}
