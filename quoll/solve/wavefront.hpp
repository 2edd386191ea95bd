#pragma once
// Sweeps in place over a window that follows the news from the ends: see wavefront.cpp.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "quoll/solve/sweep.hpp"

namespace quoll {

class Wavefront {
 public:
  /// Told how many states were updated and the largest change; false = stop.
  using Count = std::function<bool(std::uint64_t updates, double change)>;

  /// Works on `value`; states worth -infinity are left out. Cost: one reverse search
  /// of the graph, 8 bytes a state.
  Wavefront(const Mdp& mdp, std::vector<double>& value);

  /// Bands of four layers of states, by their least number of moves to an end.
  std::size_t bands() const { return band_begin_.size() - 1; }

  /// Gives each state `per_move` for each move to an end: a first guess without discounting.
  void guess(double per_move);

  /// From the first band to the last, until improve(s), which returns the change of a state,
  /// changes none by more than `aim`; evaluate(s) follows twice. False = stopped.
  template <class Improve, class Evaluate>
  bool follow(double aim, const Count& count, const Improve& improve, const Evaluate& evaluate) {
    std::vector<double> change(bands(), infinity);
    std::size_t rear = 0;
    for (std::size_t front = 1; rear < bands(); front = std::min(front + 1, bands())) {
      double most = 0.0;
      for (std::size_t b = rear; b < front; ++b) {
        change[b] = 0.0;
        for (std::uint64_t i = band_begin_[b]; i < band_begin_[b + 1]; ++i) {
          change[b] = std::max(change[b], improve(order_[i]));
        }
        most = std::max(most, change[b]);
      }
      const std::uint64_t begin = band_begin_[rear], end = band_begin_[front];
      for (std::uint64_t i = end; i > begin; --i) evaluate(order_[i - 1]);
      for (std::uint64_t i = begin; i < end; ++i) evaluate(order_[i]);
      if (!count(3 * (end - begin), most)) return false;
      while (rear < front && change[rear] <= aim) ++rear;
    }
    return true;
  }

  /// Backups and the policy's evaluation: value iteration by the wave. False = stopped.
  bool iterate(double discount, double aim, std::vector<Action>& policy, const Count& count);

 private:
  const Mdp& mdp_;
  std::vector<double>& value_;
  std::vector<State> order_;               // layer by layer
  std::vector<std::uint64_t> band_begin_;  // into order_, and its end
};

}  // namespace quoll
