#pragma once
// Hand-written loops over plain arrays, as one would write them for one model: what the solvers are
// measured against. They certify nothing; each says when it stops.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace yardstick {

/// Compressed rows: a state's choices, a choice's outcomes, 32-bit offsets.
struct Rows {
  std::vector<std::uint32_t> choice, outcome, next;
  std::vector<double> probability, reward;

  explicit Rows(const quoll::Mdp& mdp) {
    choice.push_back(0);
    outcome.push_back(0);
    for (quoll::State s = 0; s < mdp.states(); ++s) {
      for (auto c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
        for (auto o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
          next.push_back(mdp.next(o));
          probability.push_back(mdp.probability(o));
        }
        reward.push_back(mdp.reward(c));
        outcome.push_back(static_cast<std::uint32_t>(next.size()));
      }
      choice.push_back(static_cast<std::uint32_t>(reward.size()));
    }
  }

  std::size_t states() const { return choice.size() - 1; }

  double backup(const double* value, std::size_t s, double discount) const {
    double best = -std::numeric_limits<double>::infinity();
    for (std::uint32_t c = choice[s]; c < choice[s + 1]; ++c) {
      double mean = 0.0;
      for (std::uint32_t o = outcome[c]; o < outcome[c + 1]; ++o) {
        mean += probability[o] * value[next[o]];
      }
      best = std::max(best, reward[c] + discount * mean);
    }
    return best;
  }
};

struct Answer {
  std::vector<double> value;
  std::uint64_t sweeps = 0;
};

/// Value iteration; stops when MacQueen's bounds are `width` apart (Puterman 1994, 6.6) and takes
/// their middle. For models without ends.
inline Answer span_iteration(const Rows& rows, double discount, double width) {
  Answer answer{std::vector<double>(rows.states(), 0.0)};
  std::vector<double> next(rows.states());
  const double factor = discount / (1.0 - discount);
  for (;;) {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (std::size_t s = 0; s < rows.states(); ++s) {
      next[s] = rows.backup(answer.value.data(), s, discount);
      least = std::min(least, next[s] - answer.value[s]);
      greatest = std::max(greatest, next[s] - answer.value[s]);
    }
    answer.value.swap(next);
    ++answer.sweeps;
    if (factor * (greatest - least) > width) continue;
    for (double& v : answer.value) v += 0.5 * factor * (greatest + least);
    return answer;
  }
}

/// Gauss-Seidel in alternating directions from the lower bound least reward / (1 - discount); stops
/// when no value changes by more than `change`. States without choices are worth 0.
inline Answer gauss_seidel(const Rows& rows, double discount, double change) {
  const double low = *std::min_element(rows.reward.begin(), rows.reward.end()) / (1.0 - discount);
  Answer answer{std::vector<double>(rows.states(), std::min(low, 0.0))};
  for (std::size_t s = 0; s < rows.states(); ++s) {
    if (rows.choice[s] == rows.choice[s + 1]) answer.value[s] = 0.0;
  }
  for (double most = change + 1.0; most > change; ++answer.sweeps) {
    most = 0.0;
    for (std::size_t i = 0; i < rows.states(); ++i) {
      const std::size_t s = answer.sweeps % 2 == 0 ? rows.states() - 1 - i : i;
      if (rows.choice[s] == rows.choice[s + 1]) continue;
      const double best = rows.backup(answer.value.data(), s, discount);
      most = std::max(most, std::fabs(best - answer.value[s]));
      answer.value[s] = best;
    }
  }
  return answer;
}

}  // namespace yardstick
