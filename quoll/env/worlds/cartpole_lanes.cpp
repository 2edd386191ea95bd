// Lanes of the cart and pole as columns, behind the border that all environments have.

#include <algorithm>
#include <bit>
#include <cstring>

#include "quoll/env/worlds/cartpole_kernel.hpp"

namespace quoll {
namespace {

using namespace cartpole;

template <class Real>
class CartPoleLanes final : public Environment, private Inspector {
 public:
  CartPoleLanes(CartPole<Real> dynamics, const Lanes& lanes, int most_bytes)
      : dynamics_(dynamics),
        kernel_(kernel<Real>(most_bytes)),
        count_(lanes.count),
        clock_{0, static_cast<std::uint32_t>(lanes.episode_steps)} {
    blocks_.resize((count_ + block_lanes - 1) / block_lanes);
    chosen_.resize(count_);
    for (std::size_t lane = 0; lane < count_; ++lane) {
      streams_.push_back(stream(lanes.seed, "start", lane).state);
      Rng first{streams_[lane]};  // restart() draws it again
      put(lane, dynamics_.start(first));
    }
  }
  Spaces spaces() const override { return dynamics_.spaces(); }

  void restart(std::span<const std::uint8_t> restart, Experience& now) override {
    const std::size_t found = choose(restart);
    float* const seen = now.observation.empty() ? nullptr : now.observation.data();
    alignas(64) std::uint64_t streams[group];
    alignas(64) double starts[4 * group];
    for (std::size_t done = 0; done < found; done += group) {
      const std::size_t some = std::min(group, found - done);
      for (std::size_t i = 0; i < group; ++i)
        streams[i] = i < some ? streams_[chosen_[done + i]] : 0;
      kernel_.draw(streams, starts);
      for (std::size_t i = 0; i < some; ++i) {
        const std::size_t lane = chosen_[done + i], at = lane % block_lanes;
        Block<Real>& block = blocks_[lane / block_lanes];
        streams_[lane] = streams[i];
        block.began[at] = clock_.now;
#pragma GCC unroll 4
        for (std::size_t n = 0; n < 4; ++n) {
          const auto number = static_cast<Real>(starts[n * group + i]);
          block.number[n][at] = number;
          if (seen) seen[4 * lane + n] = static_cast<float>(number);
        }
      }
    }
  }
  void step(Experience& now) override {
    ++clock_.now;
    const Rewards rewards{upper_half(dynamics_.reward(false)), upper_half(dynamics_.reward(true))};
    const std::size_t whole = count_ / block_lanes, first = whole * block_lanes;
    float* const seen = now.next_observation.empty() ? nullptr : now.next_observation.data();
    kernel_.step(blocks_.data(), whole, {now.action.data(), now.feedback.data(), seen}, clock_,
                 rewards);
    const std::size_t rest = count_ - first;
    if (rest == 0) return;
    // The last lanes by way of a whole block.
    Action action[block_lanes]{};
    Feedback feedback[block_lanes];
    float row[4 * block_lanes];
    std::copy_n(now.action.data() + first, rest, action);
    kernel_.step(&blocks_[whole], 1, {action, feedback, row}, clock_, rewards);
    std::copy_n(feedback, rest, now.feedback.data() + first);
    if (seen) std::copy_n(row, 4 * rest, seen + 4 * first);
  }
  bool set(std::uint32_t, State) override { return false; }
  void persist(Archive& archive) override {
    for (std::size_t lane = 0; lane < count_; ++lane) {
      archive("start_dice", streams_[lane]);
      std::uint32_t elapsed = clock_.now - began(lane);
      archive("elapsed", elapsed);
      began(lane) = clock_.now - elapsed;
      for (std::size_t i = 0; i < 4; ++i) archive("number", number(i, lane));
    }
  }
  Inspector* inspector() override { return this; }

 private:
  using Position = typename CartPole<Real>::Position;

  Real& number(std::size_t i, std::size_t lane) {
    return blocks_[lane / block_lanes].number[i][lane % block_lanes];
  }
  std::uint32_t& began(std::size_t lane) {
    return blocks_[lane / block_lanes].began[lane % block_lanes];
  }
  Position at(std::size_t lane) const {
    const auto& number = blocks_[lane / block_lanes].number;
    const std::size_t i = lane % block_lanes;
    return {number[0][i], number[1][i], number[2][i], number[3][i]};
  }
  void put(std::size_t lane, const Position& at) {
    for (std::size_t i = 0; i < 4; ++i) number(i, lane) = at[i];
  }
  // The lanes to restart, found by 64 flags at a time.
  std::size_t choose(std::span<const std::uint8_t> restart) {
    std::size_t found = 0, first = 0;
    for (; first + 64 <= count_; first += 64) found = choose(restart.data() + first, first, found);
    std::uint8_t rest[64]{};
    std::memcpy(rest, restart.data() + first, count_ - first);
    return choose(rest, first, found);
  }
  std::size_t choose(const std::uint8_t* flags, std::size_t first, std::size_t found) {
    std::uint64_t set = 0;
    for (std::size_t i = 0; i < 64; i += 8) {
      std::uint64_t eight;
      std::memcpy(&eight, flags + i, 8);
      // The top bit of each byte that is not 0, gathered into one byte by a product.
      constexpr std::uint64_t tops = 0x8080808080808080ULL;
      eight = (((eight & ~tops) + ~tops) | eight) & tops;
      set |= ((eight >> 7) * 0x0102040810204080ULL >> 56) << i;
    }
    for (; set != 0; set &= set - 1) {
      chosen_[found++] = static_cast<std::uint32_t>(first + std::countr_zero(set));
    }
    return found;
  }

  Tree state(std::uint32_t lane, State) const override { return tree_of(at(lane)); }
  Result<void> set(std::uint32_t lane, const Tree& state, State&) override {
    Position position = at(lane);
    if (Result<void> done = assign(position, state); !done) return done;
    put(lane, position);
    began(lane) = clock_.now;
    return {};
  }
  Tree observation(std::uint32_t lane, State) const override {
    std::vector<float> x(4);
    dynamics_.observe(at(lane), x);
    return observation_tree(dynamics_.spaces(), x);
  }
  std::string text(std::uint32_t lane, State) const override { return dynamics_.text(at(lane)); }
  Drawing drawing(std::uint32_t lane, State) const override { return dynamics_.drawing(at(lane)); }

  CartPole<Real> dynamics_;
  const Kernel<Real>& kernel_;
  std::size_t count_;
  Clock clock_;
  std::vector<Block<Real>> blocks_;
  std::vector<std::uint64_t> streams_;
  std::vector<std::uint32_t> chosen_;
};

}  // namespace

template <class Real>
std::unique_ptr<Environment> cartpole_lanes(CartPole<Real> dynamics, const Lanes& lanes,
                                            int most_bytes) {
  return std::make_unique<CartPoleLanes<Real>>(dynamics, lanes, most_bytes);
}
template std::unique_ptr<Environment> cartpole_lanes(CartPole<double>, const Lanes&, int);
template std::unique_ptr<Environment> cartpole_lanes(CartPole<float>, const Lanes&, int);

}  // namespace quoll
