#pragma once
// Which pairs were seen to lead to a state, each once.

#include <cstdint>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

class Predecessors {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  struct Pair {
    std::uint64_t pair = 0;
    State state = 0;
    bool turn_passes = false;
    std::uint32_t link = none;
    void persist(Archive& archive) {
      archive("pair", pair);
      archive("state", state);
      archive("turn_passes", turn_passes);
      archive("link", link);
    }
  };

  explicit Predecessors(std::uint64_t states = 0) : first_(states, none) {}

  std::uint64_t states() const { return first_.size(); }

  void add(State next, Pair from) {
    from.link = first_[next];
    pairs_.push_back(from);
    first_[next] = static_cast<std::uint32_t>(pairs_.size() - 1);
  }
  template <class Look>
  void each(State next, const Look& look) const {
    for (std::uint32_t i = first_[next]; i != none; i = pairs_[i].link) look(pairs_[i]);
  }
  void persist(Archive& archive, std::uint64_t pairs) {
    const std::size_t states = first_.size();
    archive("first", first_);
    archive("pairs", pairs_);
    bool fits = first_.size() == states;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const Pair& p = pairs_[i];
      fits = fits && p.pair < pairs && p.state < states && (p.link == none || p.link < i);
    }
    for (const std::uint32_t i : first_) fits = fits && (i == none || i < pairs_.size());
    if (fits) return;
    archive.fail("a model of another world");
    *this = Predecessors(states);
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<Pair> pairs_;
};

}  // namespace quoll
