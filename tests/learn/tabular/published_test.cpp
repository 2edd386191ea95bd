// Examples of Sutton and Barto 2018 ("Reinforcement Learning: An Introduction", second edition)
// whose outcome is printed there.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../worlds.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

LearnSettings plain(const char* method) {
  LearnSettings settings;
  settings.method = method;
  settings.explore = "epsilon-greedy";
  settings.discount = 1.0;
  settings.until_stable = false;
  return settings;
}

// The greedy way from the start: its length, or 0 where it does not end within 100 steps, and how
// many of its cells lie at the edge (row 2, columns 1 to 10: 25 to 34).
struct Way {
  int length = 0, at_the_edge = 0;
};

Way greedy_way(const Mdp& mdp, const std::vector<Action>& policy) {
  Way way;
  State s = mdp.start().front();
  while (!mdp.terminal(s)) {
    if (++way.length > 100 || policy[s] == no_action) return {};
    s = mdp.next(mdp.outcome_begin(mdp.choice_begin(s) + policy[s]));
    const std::string name = mdp.state_name(s);
    way.at_the_edge += name.starts_with("r2c") && name != "r2c0" && name != "r2c11";
  }
  return way;
}

// Example 6.6, figure 6.4: epsilon 0.1, 500 episodes. Q-learning learns the way along the edge (13
// steps, 10 of them there) and falls off again and again, about -50 an episode; SARSA and Expected
// SARSA stay away from the edge, about -25.
TEST(Published, SarsaWalksFarFromTheCliff) {
  const World cliff = *find_world("cliff-walking");
  const auto walk = [&](const char* method) {
    LearnSettings settings = plain(method);
    settings.step_size = "0.5";
    settings.episode_steps = 100'000;
    double online = 0.0;
    int edge = 0, shortest = 0;
    constexpr int seeds = 20;
    for (settings.seed = 1; settings.seed <= seeds; ++settings.seed) {
      const auto one = learner(settings, cliff);
      LearnProgress now;
      double before = 0.0;
      std::uint64_t episodes_before = 0;
      while (now.episodes < 500) {
        now = one->advance(50, {});
        if (now.episodes < 300) before = now.return_sum, episodes_before = now.episodes;
      }
      online +=
          (now.return_sum - before) / static_cast<double>(now.episodes - episodes_before) / seeds;
      const Way way = greedy_way(*cliff.mdp, greedy_policy(one->estimates()));
      edge += way.at_the_edge;
      shortest += way.length == 13;
    }
    return std::tuple(online, edge, shortest);
  };
  const auto [q_online, q_edge, q_shortest] = walk("q-learning");
  EXPECT_NEAR(q_online, -50, 10);
  EXPECT_EQ(q_shortest, 20);
  EXPECT_EQ(q_edge, 200);
  for (const char* method : {"sarsa", "expected-sarsa"}) {
    const auto [online, edge, shortest] = walk(method);
    EXPECT_NEAR(online, -25, 6) << method;
    EXPECT_LE(shortest, 2) << method;
    EXPECT_LE(edge, 20) << method;
  }
}

// Example 6.7, figure 6.5: from A right ends with 0, left leads to B, whose actions end with noise
// of mean -0.1 and variance 1 (here 1 or -1.2). Q-learning goes left most of the time at first;
// double Q-learning does not take luck for a promise. Share of left in the first 100 episodes.
TEST(Published, DoubleQLearningIsNotLuredByLuck) {
  MdpBuilder builder(1.0);
  builder.move("A", "left", "B").move("A", "right", "END");
  for (int i = 0; i < 10; ++i) {
    const std::string action = "b" + std::to_string(i);
    builder.move("B", action, "END", 0.9, 0.5).move("B", action, "END", -1.1, 0.5);
  }
  builder.start("A");
  const World world = to_world("lure", *builder.build());
  const auto share_of_left = [&](const char* method) {
    LearnSettings settings = plain(method);
    settings.step_size = "0.1";
    int left = 0, all = 0;
    for (settings.seed = 1; settings.seed <= 300; ++settings.seed) {
      const auto one = learner(settings, world);
      for (int episode = 0; episode < 100;) {
        Update update;
        one->advance(1, std::span(&update, 1));
        episode += update.terminated;
        if (update.state != 0) continue;
        left += update.action == 0;
        ++all;
      }
    }
    return static_cast<double>(left) / all;
  };
  const double single = share_of_left("q-learning"), twofold = share_of_left("double-q");
  EXPECT_GT(single, 0.5);
  EXPECT_LT(twofold, 0.4);
}

// Example 7.1, figure 7.2: 19 states in a row, steps left and right by chance, -1 at the left end
// and 1 at the right one; root of the mean squared error over the states, averaged over the first
// 10 episodes and 100 runs, from values of 0. The figure's best n is 4 with alpha 0.4, at about
// 0.25; n = 1 is far worse at that alpha, and n = 64 at any.
TEST(Published, FourStepsAreBestOnTheRandomWalk) {
  MdpBuilder builder(1.0);
  const auto name = [](int i) { return "s" + std::to_string(i); };
  for (int i = 1; i <= 19; ++i) {
    builder.move(name(i), "go", i == 1 ? "LEFT" : name(i - 1), i == 1 ? -1 : 0, 0.5);
    builder.move(name(i), "go", i == 19 ? "RIGHT" : name(i + 1), i == 19 ? 1 : 0, 0.5);
  }
  builder.start(name(10));
  const World world = to_world("walk", *builder.build());
  const auto error = [&](const char* method, std::uint64_t n, const char* alpha) {
    LearnSettings settings = plain(method);
    settings.of_method.return_steps = n;
    settings.step_size = alpha;
    settings.episode_steps = 1'000'000;
    double sum = 0.0;
    for (settings.seed = 1; settings.seed <= 100; ++settings.seed) {
      const auto one = learner(settings, world);
      for (int episode = 0; episode < 10;) {
        Update update;
        one->advance(1, std::span(&update, 1));
        if (!update.terminated) continue;
        ++episode;
        const Estimates estimates = one->estimates();
        double squares = 0.0;
        for (int i = 1; i <= 19; ++i) {
          const State s = *world.mdp->find_state(name(i));
          const double off = estimates.q[world.mdp->choice_begin(s)] - (i - 10) / 10.0;
          squares += off * off;
        }
        sum += std::sqrt(squares / 19) / 1000;
      }
    }
    return sum;
  };
  for (const char* method : {"n-step", "tree-backup"}) {  // one action: nothing is ever cut
    const double four = error(method, 4, "0.4");
    EXPECT_NEAR(four, 0.25, 0.03) << method;
    EXPECT_GT(error(method, 1, "0.4"), four + 0.08) << method;
    EXPECT_GT(error(method, 64, "0.4"), four + 0.2) << method;
  }
}

}  // namespace
}  // namespace quoll
