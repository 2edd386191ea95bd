// Methods with memory against their definitions, written out with no thought for speed: what a run
// did is read from its log, and the table after each step must be the one of the definition.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "../worlds.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

struct Story {
  std::vector<std::uint64_t> begin;  // rows
  std::vector<Update> log;
  std::vector<std::vector<double>> after;  // the table after each step
  double discount = 0.0;
  std::uint64_t pair(const Update& u) const { return begin[u.state] + u.action; }
  bool ends(const Update& u) const { return u.terminated || u.truncated; }
};

constexpr double step_size = 0.375;

LearnSettings settings_of(const char* method, const char* explore) {
  LearnSettings settings;
  settings.method = method;
  settings.explore = explore;
  if (settings.explore == "epsilon-greedy") settings.epsilon = "0.3";
  settings.step_size = "0.375";
  settings.precision = Precision::twofold;
  settings.episode_steps = 23;
  settings.until_stable = false;
  return settings;
}

Story told(const LearnSettings& settings, const World& world, int steps) {
  Story story;
  const auto one = learner(settings, world);
  story.discount = world.mdp->carry(world.discount);
  story.begin = one->estimates().row_begin;
  for (int i = 0; i < steps; ++i) {
    Update update;
    one->advance(1, std::span(&update, 1));
    story.log.push_back(update);
    story.after.push_back(one->estimates().q);
  }
  return story;
}

void for_worlds(const std::function<void(const World&, const char* explore)>& check) {
  for (const World& world : {adventure(), star(), slippery(5), game(), corridor(4)}) {
    for (const char* explore : {"uniform", "epsilon-greedy"}) check(world, explore);
  }
}

// The table of the definition, and what the definitions ask of it.
struct Book {
  const Story& story;
  std::vector<double> q;
  explicit Book(const Story& of) : story(of), q(of.after.front().size(), 0.0) {}

  double best(State s) const {
    const auto first = q.begin() + static_cast<std::ptrdiff_t>(story.begin[s]);
    const auto end = q.begin() + static_cast<std::ptrdiff_t>(story.begin[s + 1]);
    return first == end ? 0.0 : *std::max_element(first, end);
  }
  double after(const Update& u) const { return u.terminated ? 0.0 : best(u.next); }
  bool greedy(const Update& u) const { return q[story.pair(u)] == best(u.state); }
  double pi(State s, Action a) const {  // greedy, ties shared
    int ties = 0;
    for (std::uint64_t c = story.begin[s]; c < story.begin[s + 1]; ++c) ties += q[c] == best(s);
    return q[story.begin[s] + a] == best(s) ? 1.0 / ties : 0.0;
  }
  void towards(std::uint64_t pair, double target) { q[pair] += step_size * (target - q[pair]); }
  void expect(std::size_t step, const std::string& name) const {
    for (std::size_t c = 0; c < q.size(); ++c) {
      ASSERT_NEAR(story.after[step][c], q[c], 1e-10) << name << ", step " << step + 1;
    }
  }
};

TEST(Textbook, Sarsa) {
  for_worlds([](const World& world, const char* explore) {
    const Story story = told(settings_of("sarsa", explore), world, 1200);
    Book book(story);
    for (std::size_t t = 0; t + 1 < story.log.size(); ++t) {
      const Update& u = story.log[t];
      double following = 0.0;
      if (u.truncated && !u.terminated) {
        following = u.best_next;  // of an action that was then not taken: one of the row
        bool found = false;
        for (std::uint64_t c = story.begin[u.next]; c < story.begin[u.next + 1]; ++c) {
          found = found || std::fabs(book.q[c] - following) < 1e-12;
        }
        ASSERT_TRUE(found) << world.name;
      } else if (!u.terminated) {
        ASSERT_EQ(story.log[t + 1].state, u.next);
        following = book.q[story.pair(story.log[t + 1])];
      }
      book.towards(story.pair(u), u.reward + story.discount * following);
      book.expect(t, world.name);
    }
  });
}

// epsilon 0.3: 0.3 / n for each of n actions, 0.7 shared by the best.
TEST(Textbook, ExpectedSarsa) {
  for_worlds([](const World& world, const char* explore) {
    const Story story = told(settings_of("expected-sarsa", explore), world, 1200);
    const double epsilon = std::string(explore) == "uniform" ? 1.0 : 0.3;
    Book book(story);
    for (std::size_t t = 0; t < story.log.size(); ++t) {
      const Update& u = story.log[t];
      double mean = 0.0;
      for (std::uint64_t c = story.begin[u.next]; !u.terminated && c < story.begin[u.next + 1];
           ++c) {
        const double n = static_cast<double>(story.begin[u.next + 1] - story.begin[u.next]);
        const Action a = static_cast<Action>(c - story.begin[u.next]);
        mean += (epsilon / n + (1 - epsilon) * book.pi(u.next, a)) * book.q[c];
      }
      book.towards(story.pair(u), u.reward + story.discount * mean);
      book.expect(t, world.name);
    }
  });
}

TEST(Textbook, WatkinsTraces) {
  for_worlds([](const World& world, const char* explore) {
    LearnSettings settings = settings_of("q-lambda", explore);
    settings.of_method.trace_decay = 0.875;
    const Story story = told(settings, world, 1200);
    Book book(story);
    std::vector<double> e(book.q.size(), 0.0);
    for (std::size_t t = 0; t + 1 < story.log.size(); ++t) {
      const Update& u = story.log[t];
      const double delta = u.reward + story.discount * book.after(u) - book.q[story.pair(u)];
      const bool on = !story.ends(u) && book.greedy(story.log[t + 1]);
      for (std::uint64_t c = story.begin[u.state]; c < story.begin[u.state + 1]; ++c) e[c] = 0.0;
      e[story.pair(u)] = 1.0;
      for (std::size_t c = 0; c < e.size(); ++c) {
        book.q[c] += step_size * delta * e[c];
        e[c] *= on ? story.discount * 0.875 : 0.0;
        if (std::fabs(e[c]) < 1e-3) e[c] = 0.0;
      }
      book.expect(t, world.name);
    }
  });
}

// The return from step k, seen after step t: rewards on, and the table at the end. Where the
// behaviour was not greedy all returns so far ended.
TEST(Textbook, NStepReturns) {
  for (const std::size_t n : {1u, 3u, 6u}) {
    for_worlds([n](const World& world, const char* explore) {
      LearnSettings settings = settings_of("n-step", explore);
      settings.of_method.return_steps = n;
      const Story story = told(settings, world, 1200);
      Book book(story);
      std::size_t first = 0;  // the oldest step not learned from
      const auto learn = [&](std::size_t k, std::size_t t, double end) {
        double value = end;
        for (std::size_t i = t + 1; i-- > k;) {
          value = story.log[i].reward + (story.log[i].terminated ? 0.0 : story.discount) * value;
        }
        book.towards(story.pair(story.log[k]), value);
      };
      const auto learn_all = [&](std::size_t t) {
        const double end = book.after(story.log[t]);
        for (std::size_t k = t + 1; k-- > first;) learn(k, t, end);
        first = t + 1;
      };
      for (std::size_t t = 0; t < story.log.size(); ++t) {
        const Update& u = story.log[t];
        if (first < t && !book.greedy(u)) learn_all(t - 1);
        if (t - first + 1 == n) {
          learn(first, t, book.after(u));
          ++first;
        }
        if (story.ends(u)) learn_all(t);
        book.expect(t, world.name + " n " + std::to_string(n));
      }
    });
  }
}

TEST(Textbook, TreeBackups) {
  for (const std::size_t n : {1u, 3u, 6u}) {
    for_worlds([n](const World& world, const char* explore) {
      LearnSettings settings = settings_of("tree-backup", explore);
      settings.of_method.return_steps = n;
      const Story story = told(settings, world, 1200);
      Book book(story);
      // sum over a /= a' of pi Q, and pi times the return of a': as the paper writes it.
      const auto leaves = [&](const Update& u, double value) {
        double sum = book.pi(u.state, u.action) * value;
        for (std::uint64_t c = story.begin[u.state]; c < story.begin[u.state + 1]; ++c) {
          const auto a = static_cast<Action>(c - story.begin[u.state]);
          if (a != u.action) sum += book.pi(u.state, a) * book.q[c];
        }
        return sum;
      };
      const auto back = [&](const Update& u, double value) {
        return u.reward + (u.terminated ? 0.0 : story.discount) * value;
      };
      std::size_t first = 0;
      for (std::size_t t = 0; t < story.log.size(); ++t) {
        const Update& u = story.log[t];
        if (t - first + 1 == n) {
          double value = back(u, book.after(u));
          for (std::size_t i = t; i-- > first;) {
            value = back(story.log[i], leaves(story.log[i + 1], value));
          }
          book.towards(story.pair(story.log[first]), value);
          ++first;
        }
        if (story.ends(u) && first <= t) {  // the last first, each with the tables so far
          double following = book.after(u);
          for (std::size_t k = t + 1; k-- > first;) {
            const double value = back(story.log[k], following);
            following = leaves(story.log[k], value);
            book.towards(story.pair(story.log[k]), value);
          }
        }
        if (story.ends(u)) first = t + 1;
        book.expect(t, world.name + " n " + std::to_string(n));
      }
    });
  }
}

}  // namespace
}  // namespace quoll
