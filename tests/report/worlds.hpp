#pragma once
// Small worlds with their exact values, for tests of pictures and tables.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "quoll/model/builder.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll::testing {

struct Solved {
  Mdp mdp;
  std::vector<double> value;
  std::vector<double> q;
  std::vector<Action> policy;
  std::vector<std::uint8_t> optimal;
};

/// Plain value iteration, long enough for the worlds below.
inline Solved solved(Mdp mdp, int sweeps = 3000) {
  Solved out{std::move(mdp), {}, {}, {}, {}};
  const Mdp& m = out.mdp;
  out.value.assign(m.states(), 0.0);
  out.q.assign(m.choices(), 0.0);
  out.policy.assign(m.states(), no_action);
  out.optimal.assign(m.choices(), 0);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double moved = 0;
    for (State s = 0; s < m.states(); ++s) {
      if (m.terminal(s)) continue;
      double best = -HUGE_VAL;
      for (std::uint64_t c = m.choice_begin(s); c < m.choice_end(s); ++c) {
        double q = 0;
        for (std::uint64_t o = m.outcome_begin(c); o < m.outcome_end(c); ++o) {
          q += m.probability(o) * (m.reward(c, o) + m.discount() * out.value[m.next(o)]);
        }
        out.q[c] = q;
        if (q > best) {
          best = q;
          out.policy[s] = static_cast<Action>(c - m.choice_begin(s));
        }
      }
      moved = std::max(moved, std::abs(best - out.value[s]));
      out.value[s] = best;
    }
    if (moved == 0) break;
  }
  for (State s = 0; s < m.states(); ++s) {
    for (std::uint64_t c = m.choice_begin(s); c < m.choice_end(s); ++c) {
      out.optimal[c] = !m.terminal(s) && out.q[c] >= out.value[s] - 1e-9;
    }
  }
  return out;
}

/// The lecture's game: V* = 64, 80, 80, 100, 100, 0.
inline Mdp adventure() {
  MdpBuilder builder(0.8);
  for (const char* room : {"GATE", "HALL", "POOL", "CAVE", "WELL", "GOAL"}) builder.state(room);
  const std::vector<std::pair<std::string, std::string>> ways{
      {"GATE", "POOL"}, {"POOL", "HALL"}, {"HALL", "CAVE"}, {"POOL", "CAVE"}, {"POOL", "WELL"}};
  for (const auto& [a, b] : ways) {
    builder.move(a, "To-" + b, b);
    builder.move(b, "To-" + a, a);
  }
  builder.move("CAVE", "To-GOAL", "GOAL", 100).move("WELL", "To-GOAL", "GOAL", 100);
  return *builder.build();
}

/// Rows of '#', '.', 'S', 'G', 'P': moves N E S W with reward -1 (-20 into P), discount as given.
inline Mdp grid_world(const std::vector<std::string>& rows, double discount = 1.0) {
  MdpBuilder builder(discount);
  Layout layout;
  layout.rows = static_cast<std::uint32_t>(rows.size());
  layout.columns = static_cast<std::uint32_t>(rows[0].size());
  const auto name = [](std::size_t r, std::size_t c) {
    return "r" + std::to_string(r) + "c" + std::to_string(c);
  };
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      if (rows[r][c] == '#') continue;
      builder.state(name(r, c));
      layout.cell.push_back(static_cast<std::uint32_t>(r * rows[0].size() + c));
      if (rows[r][c] == 'S') builder.start(name(r, c));
    }
  }
  layout.direction = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  const std::string actions = "NESW";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      if (std::string("#GP").find(rows[r][c]) != std::string::npos) continue;
      for (std::size_t a = 0; a < 4; ++a) {
        std::size_t to_r = r + static_cast<std::size_t>(layout.direction[a].second);
        std::size_t to_c = c + static_cast<std::size_t>(layout.direction[a].first);
        // Unsigned wrap-around makes "off the grid" one comparison.
        if (to_r >= rows.size() || to_c >= rows[0].size() || rows[to_r][to_c] == '#') {
          to_r = r;
          to_c = c;
        }
        builder.move(name(r, c), std::string(1, actions[a]), name(to_r, to_c),
                     rows[to_r][to_c] == 'P' ? -20.0 : -1.0);
      }
    }
  }
  builder.layout(std::move(layout));
  return *builder.build();
}

/// A maze with loops: pillars at even crossings, a wall beside each in a direction by number.
inline std::vector<std::string> maze_rows(std::size_t side) {
  std::vector<std::string> rows(side, std::string(side, '.'));
  std::uint64_t dice = 7;
  for (std::size_t i = 0; i < side; ++i) {
    rows[0][i] = rows[side - 1][i] = rows[i][0] = rows[i][side - 1] = '#';
  }
  for (std::size_t r = 2; r + 2 < side; r += 2) {
    for (std::size_t c = 2; c + 2 < side; c += 2) {
      dice = dice * 6364136223846793005U + 1442695040888963407U;
      rows[r][c] = '#';
      const std::size_t turn = (dice >> 60) % 4;
      const std::size_t dr[] = {0, 1, 0, 1}, dc[] = {1, 0, 1, 0};
      rows[r + dr[turn]][c + dc[turn]] = '#';
    }
  }
  rows[1][1] = 'S';
  rows[side - 2][side - 2] = 'G';
  return rows;
}

/// `states` rooms, each with `moves` moves to rooms by number; the last is an end. `outcomes` per
/// move.
inline Mdp random_graph(std::uint32_t states, std::uint32_t moves, std::uint32_t outcomes,
                        std::uint64_t seed) {
  MdpBuilder builder(0.9);
  std::uint64_t dice = seed;
  const auto next = [&dice](std::uint32_t below) {
    dice = dice * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::uint32_t>((dice >> 33) % below);
  };
  const auto name = [](std::uint32_t s) { return "room" + std::to_string(s); };
  for (std::uint32_t s = 0; s < states; ++s) builder.state(name(s));
  for (std::uint32_t s = 0; s + 1 < states; ++s) {
    for (std::uint32_t m = 0; m < moves; ++m) {
      for (std::uint32_t o = 0; o < outcomes; ++o) {
        // The first move leads on, so that every room reaches the end.
        const std::uint32_t to = m == 0 && o == 0 ? s + 1 : next(states);
        builder.move(name(s), "a" + std::to_string(m), name(to), to + 1 == states ? 10.0 : 0.0,
                     1.0 / outcomes);
      }
    }
  }
  return *builder.build();
}

}  // namespace quoll::testing
