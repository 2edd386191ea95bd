#pragma once
// Prioritised replay: what surprised is drawn more often. Schaul et al. 2016, algorithm 1, its
// proportional variant, drawn as in appendix B.2.1.

#include <cstdint>
#include <span>

#include "quoll/base/archive.hpp"
#include "quoll/base/random.hpp"
#include "quoll/learn/deep/sum_tree.hpp"

namespace quoll {

class Priorities {
 public:
  /// Of transitions in slots below `slots`, drawn with probability p^alpha / sum.
  Priorities(std::uint64_t slots, double alpha) : alpha_(alpha), tree_(slots) {}

  /// A transition that was never drawn counts as much as any did so far.
  void add(std::uint64_t slot) { tree_.set(slot, largest_); }
  void forget(std::uint64_t slot) { tree_.set(slot, 0.0); }
  /// p <- |error| + 1e-6.
  void set(std::uint64_t slot, double error);
  /// One slot from each of as many equal parts of the sum as there are to fill, and for each of
  /// `remembered` transitions its weight (remembered P)^-beta, of the largest of them.
  void draw(Rng& rng, std::uint64_t remembered, double beta, std::span<std::uint64_t> slots,
            std::span<float> weights) const;

  double total() const { return tree_.total(); }
  double operator[](std::uint64_t slot) const { return tree_[slot]; }

  void persist(Archive& archive);

 private:
  double alpha_;
  double largest_ = 1.0;  // p^alpha so far
  SumTree tree_;
};

}  // namespace quoll
