#pragma once
// Sweeps in place over a window that follows the news from the ends: see wavefront.cpp.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "quoll/base/parallel.hpp"
#include "quoll/solve/sweep.hpp"

namespace quoll {

class Wavefront {
 public:
  /// Told how many states were updated and the largest change; false = stop.
  using Count = std::function<bool(std::uint64_t updates, double change)>;

  /// Works on `value`; states worth -infinity are left out. Cost: one reverse search of the graph,
  /// 8 bytes a state. A layer is shared among `threads` (0 = all processors) where no state of a
  /// layer can lead to another one of its own, as in every grid of four moves: then the bits do not
  /// depend on how many there are.
  Wavefront(const Mdp& mdp, std::vector<double>& value, unsigned threads = 1);

  /// Bands of four layers of states, by their least number of moves to an end.
  std::size_t bands() const { return band_layer_.size() - 1; }

  /// Gives each state `per_move` for each move to an end: a first guess without discounting.
  void guess(double per_move);

  /// From the first band to the last, until improve(s), which returns the change of a state,
  /// changes none by more than `aim`; evaluate(s) follows twice. False = stopped.
  template <class Improve, class Evaluate>
  bool follow(double aim, const Count& count, const Improve& improve, const Evaluate& evaluate) {
    std::vector<std::vector<double>> change;  // per member of the team, per band
    std::size_t rear = 0, front = 1;
    bool going = bands() > 0;
    Team::gather(threads_, [&](Team& team, unsigned member) {
      if (member == 0) change.assign(team.size(), std::vector<double>(bands(), infinity));
      team.meet(member);
      while (going) {
        for (std::size_t b = rear; b < front; ++b) {
          double most = 0.0;
          for (std::size_t layer = band_layer_[b]; layer < band_layer_[b + 1]; ++layer) {
            const auto [begin, end] = share(layer, team, member);
            for (std::uint64_t i = begin; i < end; ++i) most = std::max(most, improve(order_[i]));
            team.meet(member);
          }
          change[member][b] = most;
        }
        const std::size_t first = band_layer_[rear], last = band_layer_[front];
        for (std::size_t layer = last; layer > first; --layer) {
          const auto [begin, end] = share(layer - 1, team, member);
          for (std::uint64_t i = end; i > begin; --i) evaluate(order_[i - 1]);
          team.meet(member);
        }
        for (std::size_t layer = first; layer < last; ++layer) {
          const auto [begin, end] = share(layer, team, member);
          for (std::uint64_t i = begin; i < end; ++i) evaluate(order_[i]);
          team.meet(member);
        }
        if (member == 0) going = move_window(aim, count, change, rear, front);
        team.meet(member);
      }
    });
    return rear == bands();
  }

  /// Backups and the policy's evaluation: value iteration by the wave. False = stopped.
  bool iterate(double discount, double aim, std::vector<Action>& policy, const Count& count);

 private:
  // The states of a layer that are the member's, from and to a place in order_.
  std::pair<std::uint64_t, std::uint64_t> share(std::size_t layer, const Team& team,
                                                unsigned member) const {
    const std::uint64_t begin = layer_begin_[layer];
    const std::uint64_t count = layer_begin_[layer + 1] - begin;
    return {begin + count * member / team.size(), begin + count * (member + 1) / team.size()};
  }
  // After a round: bands that have settled leave at the rear, the next one comes in. False = done,
  // or stopped.
  bool move_window(double aim, const Count& count, const std::vector<std::vector<double>>& change,
                   std::size_t& rear, std::size_t& front) const;
  bool layers_are_free(const std::vector<std::uint32_t>& moves) const;

  const Mdp& mdp_;
  std::vector<double>& value_;
  std::vector<State> order_;                // layer by layer
  std::vector<std::uint64_t> layer_begin_;  // into order_, and its end
  std::vector<std::size_t> band_layer_;     // the first layer of each band, and the end
  unsigned threads_;
};

}  // namespace quoll
