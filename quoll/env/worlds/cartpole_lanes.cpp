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
        limit_(static_cast<std::uint32_t>(lanes.episode_steps)) {
    blocks_.resize((count_ + block_lanes - 1) / block_lanes);
    due_.resize(blocks_.size() * block_lanes);
    ended_.lane.resize(due_.size() + 4);
    for (std::size_t lane = 0; lane < count_; ++lane) {
      streams_.push_back(stream(lanes.seed, "start", lane).state);
      Rng first{streams_[lane]};  // restart() draws it again
      put(lane, dynamics_.start(first));
    }
  }
  Spaces spaces() const override { return dynamics_.spaces(); }

  void restart(std::span<const std::uint8_t> restart, Experience& now) override {
    if (restart.empty()) {
      begin(ended_.lanes(), now.observation);
      ended_.count = 0;
    } else {
      chosen_.clear();
      for (std::uint32_t lane = 0; lane < count_; ++lane) {
        if (restart[lane]) chosen_.push_back(lane);
      }
      begin(chosen_, now.observation);
    }
  }
  void step(Experience& now) override {
    find_resting();
    ++now_;
    const Feedback usual{dynamics_.reward(false)}, end{dynamics_.reward(true), true};
    const std::size_t whole = count_ / block_lanes, first = whole * block_lanes;
    float* const seen = now.next_observation.empty() ? nullptr : now.next_observation.data();
    Ends ends = kernel_.step(
        blocks_.data(), whole,
        {now.action.data(), due_.data(), now.feedback.data(), seen, ended_.lane.data()}, now_,
        usual);
    ended_.count = ends.count;
    if (const std::size_t left = count_ - first; left > 0) {
      // The last lanes by way of a whole block.
      Action action[block_lanes]{};
      Feedback feedback[block_lanes];
      float row[4 * block_lanes];
      std::copy_n(now.action.data() + first, left, action);
      std::uint32_t last[block_lanes + 4];
      const Ends more = kernel_.step(&blocks_[whole], 1,
                                     {action, &due_[first], feedback, row, last}, now_, usual);
      std::copy_n(feedback, left, now.feedback.data() + first);
      if (seen) std::copy_n(row, 4 * left, seen + 4 * first);
      ends.cut |= more.cut;
      for (std::size_t i = 0; i < more.count; ++i) {
        if (last[i] < left)
          ended_.lane[ended_.count++] = static_cast<std::uint32_t>(first + last[i]);
      }
    }
    for (const std::uint32_t lane : ended_.lanes()) {
      const bool cut = ends.cut && due_[lane] == now_;
      now.feedback[lane] = cut && !dynamics_.fallen(at(lane)) ? usual : end;
      now.feedback[lane].truncated = cut;
    }
    for (const auto& [lane, position] : resting_) rest(lane, position, now);
  }
  bool set(std::uint32_t, State) override { return false; }
  void persist(Archive& archive) override {
    std::vector<std::uint8_t> over(count_);
    for (const std::uint32_t lane : ended_.lanes()) over[lane] = 1;
    put_down_.clear();
    ended_.count = 0;
    for (std::uint32_t lane = 0; lane < count_; ++lane) {
      archive("start_dice", streams_[lane]);
      std::uint32_t elapsed = now_ - (due_[lane] - limit_);
      archive("elapsed", elapsed);
      due_[lane] = now_ - elapsed + limit_;
      for (std::size_t i = 0; i < 4; ++i) archive("number", number(i, lane));
      archive("over", over[lane]);
      if (over[lane]) ended_.lane[ended_.count++] = lane;
      if (dynamics_.fallen(at(lane))) put_down_.push_back(lane);
    }
  }
  Inspector* inspector() override { return this; }

 private:
  using Position = typename CartPole<Real>::Position;

  Real& number(std::size_t i, std::size_t lane) {
    return blocks_[lane / block_lanes].number[i][lane % block_lanes];
  }
  Position at(std::size_t lane) const {
    const auto& number = blocks_[lane / block_lanes].number;
    const std::size_t i = lane % block_lanes;
    return {number[0][i], number[1][i], number[2][i], number[3][i]};
  }
  void put(std::size_t lane, const Position& at) {
    for (std::size_t i = 0; i < 4; ++i) number(i, lane) = at[i];
  }
  struct Found {
    std::vector<std::uint32_t> lane;  // longer than count
    std::size_t count = 0;

    std::span<const std::uint32_t> lanes() const { return {lane.data(), count}; }
  };
  void begin(std::span<const std::uint32_t> lanes, std::span<float> seen) {
    const std::size_t groups = (lanes.size() + group - 1) / group;
    drawn_.resize(groups * group);
    starts_.resize(4 * groups * group);
    for (std::size_t i = 0; i < lanes.size(); ++i) drawn_[i] = streams_[lanes[i]];
    kernel_.draw(drawn_.data(), groups, starts_.data());
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      const std::size_t lane = lanes[i];
      const Real* const start = &starts_[i / group * 4 * group + i % group];
      streams_[lane] = drawn_[i];
      due_[lane] = now_ + limit_;
      const Position position{start[0], start[group], start[2 * group], start[3 * group]};
      put(lane, position);
      if (!seen.empty()) dynamics_.observe(position, seen.subspan(4 * lane, 4));
    }
  }
  // The fallen lanes, which a step leaves as they are.
  void find_resting() {
    resting_.clear();
    for (const std::span<const std::uint32_t> lanes : {ended_.lanes(), {put_down_}}) {
      for (const std::uint32_t lane : lanes) {
        if (dynamics_.fallen(at(lane))) resting_.push_back({lane, at(lane)});
      }
    }
    put_down_.clear();
  }
  void rest(std::uint32_t lane, const Position& position, Experience& now) {
    put(lane, position);
    const bool cut = due_[lane] == now_;
    Feedback& feedback = now.feedback[lane];
    if (!cut && !feedback.over()) ended_.lane[ended_.count++] = lane;
    feedback = {0.0, true, cut};
    if (!now.next_observation.empty()) {
      dynamics_.observe(position, now.next_observation.subspan(4 * lane, 4));
    }
  }

  Tree state(std::uint32_t lane, State) const override { return tree_of(at(lane)); }
  Result<void> set(std::uint32_t lane, const Tree& state, State&) override {
    Position position = at(lane);
    if (Result<void> done = assign(position, state); !done) return done;
    put(lane, position);
    due_[lane] = now_ + limit_;
    if (dynamics_.fallen(position)) put_down_.push_back(lane);
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
  std::uint32_t now_ = 0, limit_;  // steps made; a limit of 0 = none
  std::vector<Block<Real>> blocks_;
  std::vector<std::uint64_t> streams_;
  std::vector<std::uint32_t> due_;       // as the kernel has it
  Found ended_;                          // by the last step
  std::vector<std::uint32_t> put_down_;  // lanes set into an end
  std::vector<std::uint32_t> chosen_;
  std::vector<std::pair<std::uint32_t, Position>> resting_;
  std::vector<std::uint64_t> drawn_;
  std::vector<Real> starts_;
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
