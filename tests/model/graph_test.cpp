#include "quoll/model/graph.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "quoll/base/random.hpp"
#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

Mdp built(const MdpBuilder& builder) {
  auto mdp = builder.build();
  EXPECT_TRUE(mdp) << message(mdp.error());
  return *std::move(mdp);
}

// A -> B -> C (end, with a move back to A); D -> A; E <-> E.
Mdp small() {
  MdpBuilder builder(0.9);
  for (const char* name : {"A", "B", "C", "D", "E"}) builder.state(name);
  builder.move("A", "go", "B").move("B", "go", "C").move("C", "go", "A").terminal("C");
  builder.move("D", "go", "A").move("E", "go", "E").start("A");
  return built(builder);
}

TEST(Graph, ReachableDoesNotLeaveEnds) {
  const Mdp mdp = small();
  const std::vector<State> from_b{1};
  EXPECT_EQ(reachable(mdp, from_b), (std::vector<bool>{false, true, true, false, false}));
  const std::vector<State> from_end{2};
  EXPECT_EQ(reachable(mdp, from_end), (std::vector<bool>{false, false, true, false, false}));
}

TEST(Graph, CanEndCountsMoves) {
  const Mdp mdp = small();
  EXPECT_EQ(can_end(mdp), (std::vector<bool>{true, true, true, true, false}));
  EXPECT_EQ(moves_to_end(mdp), (std::vector<std::uint32_t>{2, 1, 0, 3, unreached}));
  const std::vector<State> from{3};
  EXPECT_EQ(moves_from(mdp, from), (std::vector<std::uint32_t>{1, 2, 3, 0, unreached}));
}

TEST(Graph, StronglyConnectedInReverseTopologicalOrder) {
  // 0 <-> 1 -> 2 <-> 3 -> 4 (end).
  MdpBuilder builder(0.9);
  builder.move("0", "a", "1").move("1", "a", "0").move("1", "b", "2").move("2", "a", "3");
  builder.move("3", "a", "2").move("3", "b", "4");
  const auto component = strongly_connected(built(builder));
  EXPECT_EQ(component, (std::vector<std::uint32_t>{2, 2, 1, 1, 0}));
}

// A path so long that a recursive search would overflow the stack, closed to one cycle or not.
TEST(Graph, LongPathsNeedNoRecursion) {
  constexpr State n = 1'000'000;
  for (const bool closed : {false, true}) {
    MdpArrays a;
    a.choice_begin.resize(n + 1);
    for (State s = 0; s < n; ++s) {
      a.choice_begin[s + 1] = a.choice_begin[s];
      if (s + 1 == n && !closed) continue;
      ++a.choice_begin[s + 1];
      a.next.push_back((s + 1) % n);
      a.reward.push_back(-1.0);
      a.action.push_back(0);
    }
    a.state_names = Names::numbered("", n);
    a.action_names.push_back("go");
    a.start = {0};
    const auto mdp = Mdp::make(std::move(a));
    ASSERT_TRUE(mdp) << message(mdp.error());
    const auto component = strongly_connected(*mdp);
    EXPECT_EQ(component[0], closed ? 0u : n - 1);
    EXPECT_EQ(maximal_end_components(*mdp).count, closed ? 1u : 0u);
    EXPECT_EQ(moves_to_end(*mdp)[0], closed ? unreached : n - 1);
  }
}

// Up to 6 states, up to 3 actions with up to 3 outcomes, rewards -2 .. 2.
Mdp random_model(Rng& rng, bool deterministic) {
  MdpBuilder builder(1.0);
  const std::uint32_t states = 2 + rng.below(5);
  for (State s = 0; s < states; ++s) builder.state(std::to_string(s));
  for (std::uint32_t a = 0; a < 3; ++a) builder.action(std::to_string(a));
  builder.move(0, 0, rng.below(states), 0.0, 1.0);
  for (State s = 0; s < states; ++s) {
    const std::uint32_t actions = rng.below(4);
    for (std::uint32_t a = s == 0 ? 1 : 0; a < actions; ++a) {
      const double reward = static_cast<double>(rng.below(5)) - 2.0;
      const std::uint32_t outcomes = deterministic ? 1 : 1 << rng.below(3);
      for (std::uint32_t o = 0; o < outcomes; ++o) {
        builder.move(s, a, rng.below(states), reward, 1.0 / outcomes);
      }
    }
  }
  return built(builder.start("0"));
}

// paths[a][b]: b can be reached from a by one move or more.
std::vector<std::vector<bool>> paths_of(const Mdp& mdp) {
  const std::size_t n = mdp.states();
  std::vector<std::vector<bool>> path(n, std::vector<bool>(n, false));
  for (State s = 0; s < n; ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      for (auto o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) path[s][mdp.next(o)] = true;
    }
  }
  for (State k = 0; k < n; ++k) {
    for (State i = 0; i < n; ++i) {
      for (State j = 0; j < n; ++j) path[i][j] = path[i][j] || (path[i][k] && path[k][j]);
    }
  }
  return path;
}

TEST(Graph, StronglyConnectedAgreesWithPaths) {
  Rng rng = stream(1, "graph");
  for (int trial = 0; trial < 2000; ++trial) {
    const Mdp mdp = random_model(rng, trial % 2 == 0);
    const auto component = strongly_connected(mdp);
    const auto path = paths_of(mdp);
    for (State i = 0; i < mdp.states(); ++i) {
      for (State j = 0; j < mdp.states(); ++j) {
        const bool together = i == j || (path[i][j] && path[j][i]);
        ASSERT_EQ(component[i] == component[j], together) << trial;
        ASSERT_TRUE(!path[i][j] || component[i] >= component[j]) << trial;
      }
    }
  }
}

// Is the set of states an end component with all its choices that stay inside?
bool is_end_component(const Mdp& mdp, std::uint32_t set, const std::vector<bool>& allowed) {
  const std::size_t n = mdp.states();
  std::vector<std::uint32_t> reach(n, 0);
  for (State s = 0; s < n; ++s) {
    if ((set >> s & 1) == 0) continue;
    bool any = false;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      std::uint32_t successors = 0;
      for (auto o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        successors |= 1u << mdp.next(o);
      }
      if (!allowed[c] || (successors & ~set) != 0) continue;
      any = true;
      reach[s] |= successors;
    }
    if (!any) return false;
  }
  for (State k = 0; k < n; ++k) {
    for (State i = 0; i < n; ++i) {
      if (reach[i] >> k & 1) reach[i] |= reach[k];
    }
  }
  for (State s = 0; s < n; ++s) {
    if ((set >> s & 1) != 0 && (reach[s] & set) != set) return false;
  }
  return true;
}

TEST(Graph, EndComponentsAgreeWithAllSubsets) {
  Rng rng = stream(2, "graph");
  std::uint64_t found = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Mdp mdp = random_model(rng, false);
    std::vector<bool> allowed(mdp.choices());
    for (std::size_t c = 0; c < allowed.size(); ++c) allowed[c] = rng.below(5) > 0;
    std::vector<std::uint32_t> expected(mdp.states(), 0);  // the largest end component of a state
    for (std::uint32_t set = 1; set < 1u << mdp.states(); ++set) {
      if (!is_end_component(mdp, set, allowed)) continue;
      for (State s = 0; s < mdp.states(); ++s) {
        if ((set >> s & 1) != 0 && std::popcount(set) > std::popcount(expected[s])) {
          expected[s] = set;
        }
      }
    }
    const EndComponents parts = maximal_end_components(mdp, allowed);
    std::uint32_t next_number = 0;
    for (State s = 0; s < mdp.states(); ++s) {
      std::uint32_t set = 0;
      for (State t = 0; t < mdp.states(); ++t) {
        const bool same =
            parts.component[s] != no_component && parts.component[s] == parts.component[t];
        set |= same ? 1u << t : 0;
      }
      ASSERT_EQ(set, expected[s]) << trial << " state " << s;
      if (set != 0 && std::countr_zero(set) == static_cast<int>(s)) {
        ASSERT_EQ(parts.component[s], next_number++);
      }
      for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
        bool stays = allowed[c] && set != 0;
        for (auto o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
          stays = stays && (set >> mdp.next(o) & 1) != 0;
        }
        ASSERT_EQ(parts.inside[c], stays) << trial;
      }
    }
    ASSERT_EQ(parts.count, next_number);
    found += next_number;
  }
  EXPECT_GT(found, 500u);  // the comparison was not idle
}

// A random walk that can fall off its end: the states lose their choices one after the other.
TEST(Graph, EndComponentsPeelALongWalkInLinearTime) {
  constexpr State n = 200'000;
  MdpArrays a;
  a.outcome_begin.push_back(0);
  a.choice_begin = {0, 0};
  for (State s = 1; s < n; ++s) {
    a.next.insert(a.next.end(), {s - 1, std::min(s + 1, n - 1)});
    a.probability.push_back(0.5);
    a.probability.push_back(0.5);
    a.reward.push_back(0.0);
    a.action.push_back(0);
    a.outcome_begin.push_back(a.next.size());
    a.choice_begin.push_back(a.action.size());
  }
  a.state_names = Names::numbered("", n);
  a.action_names.push_back("go");
  const auto mdp = Mdp::make(std::move(a));
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_EQ(maximal_end_components(*mdp).count, 0u);
}

TEST(Undiscounted, NamesStatesThatCannotEnd) {
  MdpBuilder builder(1.0);
  builder.move("A", "go", "END").move("A", "trap", "B").move("B", "on", "C").move("C", "on", "B");
  builder.move("D", "on", "D").start("A");  // D is not reached from the start
  const auto fault = undiscounted_fault(built(builder));
  EXPECT_EQ(fault.kind, UndiscountedFault::Kind::no_end);
  EXPECT_EQ(fault.states, (std::vector<State>{2, 3}));
}

TEST(Undiscounted, FindsACycleOfGain) {
  // A -> B -> C -> A earns 5 - 3 - 1 = 1 a round; B -> A instead earns 5 - 6.
  MdpBuilder builder(1.0);
  builder.move("A", "on", "B", 5.0).move("B", "on", "C", -3.0).move("C", "on", "A", -1.0);
  builder.move("B", "back", "A", -6.0).move("C", "out", "END", 0.0);
  const auto fault = undiscounted_fault(built(builder));
  EXPECT_EQ(fault.kind, UndiscountedFault::Kind::gaining_cycle);
  EXPECT_EQ(fault.states, (std::vector<State>{0, 1, 2}));
}

TEST(Undiscounted, CyclesWithoutGainAreFine) {
  // 0.1 + 0.2 - 0.3 is 5.6e-17 in binary: rounding, not gain.
  MdpBuilder builder(1.0);
  builder.move("A", "on", "B", 0.1).move("B", "on", "C", 0.2).move("C", "on", "A", -0.3);
  builder.move("C", "out", "END", 100.0);
  EXPECT_EQ(undiscounted_fault(built(builder)).kind, UndiscountedFault::Kind::none);
}

TEST(Undiscounted, AnEndStopsTheCycle) {
  MdpBuilder builder(1.0);
  builder.move("A", "on", "B", 5.0).move("B", "on", "A", 5.0).terminal("B");
  EXPECT_EQ(undiscounted_fault(built(builder)).kind, UndiscountedFault::Kind::none);
}

// Longest paths between all pairs (Floyd 1962): rewards are small integers, so sums are exact.
TEST(Undiscounted, AgreesWithAllPairsOnDeterministicModels) {
  Rng rng = stream(3, "graph");
  int gaining = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Mdp mdp = random_model(rng, true);
    const std::size_t n = mdp.states();
    constexpr double none = -1e9;
    std::vector<std::vector<double>> best(n, std::vector<double>(n, none));
    for (State s = 0; s < n; ++s) {
      for (auto c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
        best[s][mdp.next(c)] = std::max(best[s][mdp.next(c)], mdp.reward(c));
      }
    }
    for (State k = 0; k < n; ++k) {
      for (State i = 0; i < n; ++i) {
        for (State j = 0; j < n; ++j) {
          if (best[i][k] == none || best[k][j] == none) continue;
          best[i][j] = std::max(best[i][j], best[i][k] + best[k][j]);
        }
      }
    }
    const auto reached = reachable(mdp, mdp.start());
    const auto ending = can_end(mdp);
    bool gain = false;
    bool endless = false;
    for (State s = 0; s < n; ++s) {
      endless = endless || (reached[s] && !ending[s]);
      gain = gain || (reached[s] && best[s][s] > 0.0);
    }
    using Kind = UndiscountedFault::Kind;
    const UndiscountedFault fault = undiscounted_fault(mdp);
    ASSERT_EQ(fault.kind, endless ? Kind::no_end
                          : gain  ? Kind::gaining_cycle
                                  : Kind::none)
        << trial;
    if (fault.kind != Kind::gaining_cycle) continue;
    ++gaining;
    double sum = 0.0;  // along the best moves of the cycle reported
    for (std::size_t i = 0; i < fault.states.size(); ++i) {
      const State from = fault.states[i];
      const State to = fault.states[(i + 1) % fault.states.size()];
      double reward = none;
      for (auto c = mdp.choice_begin(from); c < mdp.choice_end(from); ++c) {
        if (mdp.next(c) == to) reward = std::max(reward, mdp.reward(c));
      }
      sum += reward;
    }
    ASSERT_GT(sum, 0.0) << trial;
  }
  EXPECT_GT(gaining, 100);
}

TEST(Undiscounted, EndComponentThatGains) {
  // A and B can play for ever without loss, and B's coin gains 1 on average half the time.
  MdpBuilder builder(1.0);
  builder.move("A", "on", "B").move("B", "coin", "A", 2.0, 0.5).move("B", "coin", "B", 0.0, 0.5);
  builder.move("A", "out", "END", -5.0);
  const auto fault = undiscounted_fault(built(builder));
  EXPECT_EQ(fault.kind, UndiscountedFault::Kind::gaining_cycle);
  EXPECT_EQ(fault.states, (std::vector<State>{0, 1}));
}

TEST(Undiscounted, EndComponentOfZeroRewardsIsFine) {
  MdpBuilder builder(1.0);
  builder.move("A", "on", "B").move("B", "coin", "A", 0.0, 0.5).move("B", "coin", "B", 0.0, 0.5);
  builder.move("A", "out", "END", 5.0);
  EXPECT_EQ(undiscounted_fault(built(builder)).kind, UndiscountedFault::Kind::none);
}

TEST(Undiscounted, AChanceOfEndingStopsTheGain) {
  MdpBuilder builder(1.0);
  builder.move("A", "coin", "A", 2.0, 0.5).move("A", "coin", "END", 0.0, 0.5);
  EXPECT_EQ(undiscounted_fault(built(builder)).kind, UndiscountedFault::Kind::none);
}

// Every move earns the rise in height minus nothing: each cycle sums to zero, in the order of
// states that is worst for plain sweeps.
TEST(Undiscounted, LargePotentialsAreDecidedQuickly) {
  constexpr State n = 200'000;
  MdpArrays a;
  a.choice_begin.push_back(0);
  const auto add = [&a](State to, double reward) {
    a.next.push_back(to);
    a.reward.push_back(reward);
    a.action.push_back(static_cast<std::uint32_t>(a.next.size() - 1 - a.choice_begin.back()));
  };
  for (State s = 0; s < n; ++s) {
    if (s > 0) add(s - 1, 1.0);
    if (s + 1 < n) add(s + 1, -1.0);
    if (s == 0) add(n, 0.0);
    a.choice_begin.push_back(a.next.size());
  }
  a.choice_begin.push_back(a.next.size());  // the end
  a.state_names = Names::numbered("", n + 1);
  a.action_names = Names::numbered("a", 3);
  const auto mdp = Mdp::make(std::move(a));
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_EQ(undiscounted_fault(*mdp).kind, UndiscountedFault::Kind::none);
}

}  // namespace
}  // namespace quoll
