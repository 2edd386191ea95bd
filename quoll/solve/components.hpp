#pragma once
// The strongly connected components of a model, each after all that can follow it.

#include <cstdint>
#include <span>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

class Components {
 public:
  /// Of the states with live[s] != 0; states of one component stand in ascending order. Cost: one
  /// search (strongly_connected), 8 bytes a state.
  Components(const Mdp& mdp, const std::vector<std::uint8_t>& live);

  /// Whether the model has at least 512 states and none of its components more than an eighth of
  /// them. Cost: at most one search, far less where a component is large.
  static bool many(const Mdp& mdp);

  std::size_t count() const { return begin_.size() - 1; }
  std::span<const State> operator[](std::size_t k) const {
    return {states_.data() + begin_[k], states_.data() + begin_[k + 1]};
  }

  class Iterator {
   public:
    Iterator(const Components& all, std::size_t k) : all_(all), k_(k) {}
    std::span<const State> operator*() const { return all_[k_]; }
    Iterator& operator++() {
      ++k_;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return k_ != other.k_; }

   private:
    const Components& all_;
    std::size_t k_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, count()}; }

 private:
  std::vector<State> states_;
  std::vector<std::uint64_t> begin_;  // into states_, and its end
};

}  // namespace quoll
