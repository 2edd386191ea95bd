#include "quoll/solve/moves_left.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "quoll/solve/components.hpp"
#include "quoll/solve/rounding.hpp"
#include "quoll/solve/wavefront.hpp"

// w <- max(w, 1 + max over allowed choices of P w), in place from 0, until a sweep adds no more
// than a quarter.

namespace quoll {

namespace {

class Count {
 public:
  Count(const Mdp& mdp, const std::vector<std::uint8_t>& live, const std::vector<bool>& allowed,
        const EndComponents& parts)
      : mdp_(mdp),
        live_(live),
        allowed_(allowed),
        parts_(parts),
        moves_(mdp.states(), 0.0),
        greatest_(parts.count, 0.0) {}

  std::optional<std::vector<double>> run() {
    if (Components::many(mdp_)) {
      if (!by_components()) return std::nullopt;
    } else if (parts_.count == 0 && !along_wave()) {
      return std::nullopt;
    }
    if (!to_and_fro()) return std::nullopt;
    return std::move(moves_);
  }

 private:
  static constexpr double settled = 0.25;  // moves a sweep may still add
  static constexpr double most_moves = 1e9;
  static constexpr unsigned most_sweeps = 200'000;

  double raise(State s) {
    double most = moves_[s];
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      if (!allowed_[c]) continue;
      double mean = 0.0;
      for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
        mean += mdp_.probability(o) * moves_[mdp_.next(o)];
      }
      most = std::max(most, 1.0 + mean);
    }
    const double change = most - moves_[s];
    moves_[s] = most;
    return change;
  }

  // Gives the states of a part the greatest number among them; they stand in `states` together.
  template <class States>
  void share(const States& states) {
    if (parts_.count == 0) return;
    for (const State s : states) {
      const std::uint32_t k = parts_.component[s];
      if (k != no_component) greatest_[k] = std::max(greatest_[k], moves_[s]);
    }
    for (const State s : states) {
      const std::uint32_t k = parts_.component[s];
      if (k != no_component) moves_[s] = greatest_[k];
    }
  }

  bool by_components() {
    for (const std::span<const State> part : Components(mdp_, live_)) {
      double change = 1.0;
      for (unsigned k = 0; k < most_sweeps && change > settled && change < most_moves; ++k) {
        change = 0.0;
        for (std::size_t i = 0; i < part.size(); ++i) {
          change = std::max(change, raise(part[k % 2 == 0 ? part.size() - 1 - i : i]));
        }
        share(part);
      }
      if (change > settled) return false;
    }
    return true;
  }

  // Nearly all of the way; bands it has left behind may still rise a little.
  bool along_wave() {
    constexpr std::uint64_t most_updates_of_each = 200'000;
    for (State s = 0; s < mdp_.states(); ++s) moves_[s] = live_[s] != 0 ? 0.0 : -infinity;
    std::uint64_t updates = 0;
    Wavefront wave(mdp_, moves_);
    for (State s = 0; s < mdp_.states(); ++s) moves_[s] = 0.0;
    const auto count = [&](std::uint64_t updated, double change) {
      updates += updated;
      return change < most_moves && updates / mdp_.states() < most_updates_of_each;
    };
    const auto raise_it = [this](State s) { return raise(s); };
    return wave.follow(settled, count, raise_it, raise_it);
  }

  bool to_and_fro() {
    std::vector<State> all;
    for (State s = 0; s < mdp_.states(); ++s) {
      if (live_[s] != 0) all.push_back(s);
    }
    double change = 1.0;
    for (unsigned k = 0; k < most_sweeps && change > settled && change < most_moves; ++k) {
      change = 0.0;
      for (std::size_t i = 0; i < all.size(); ++i) {
        change = std::max(change, raise(all[k % 2 == 0 ? all.size() - 1 - i : i]));
      }
      share(all);
    }
    return change <= settled;
  }

  const Mdp& mdp_;
  const std::vector<std::uint8_t>& live_;
  const std::vector<bool>& allowed_;
  const EndComponents& parts_;
  std::vector<double> moves_;     // w
  std::vector<double> greatest_;  // per part
};

}  // namespace

std::optional<std::vector<double>> moves_left(const Mdp& mdp, const std::vector<std::uint8_t>& live,
                                              const std::vector<bool>& allowed,
                                              const EndComponents& parts) {
  return Count(mdp, live, allowed, parts).run();
}

}  // namespace quoll
