// Q-learning with reverse replay of each episode. Lin 1992 ("Self-improving reactive agents based
// on reinforcement learning, planning and teaching"), section 4.
//
//   for each episode: s <- start()
//     for t = 1 .. T, until s is an end or the episode is cut off:
//   1   choose a in A(s), see r and s'; N(s,a) <- N(s,a) + 1
//   2   Q(s,a) <- Q(s,a) + alpha(N(s,a)) (r + gamma max_a' Q(s',a') - Q(s,a));  remember e_t
//   3 for t = T .. 1: the update of step 2 once more with e_t
//
// alpha -> StepSize; gamma, 0 after the end -> carry; e -> episode_. A whole episode's reward
// travels back in one pass, whatever the behaviour. N counts real steps only. Episodes that last
// long are replayed in blocks of four horizons, 64 to 65,536 steps. Memory: 40 bytes a step of it.

#include <algorithm>
#include <vector>

#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/past_step.hpp"
#include "quoll/learn/tabular/rules.hpp"

namespace quoll {
namespace {

template <class V>
class ReverseReplay {
 public:
  using Value = V;
  static constexpr bool looks_ahead = false;

  ReverseReplay(const LearnSetup& setup, const ValueTable<V>& table)
      : step_size_(setup.step_size), begin_(table.begin()), episode_(64) {
    constexpr double least = 64.0, most = 65'536.0;
    const double horizons = setup.discount < 1.0 ? 4.0 / (1.0 - setup.discount) : most;
    block_ = static_cast<std::size_t>(std::clamp(horizons, least, most));
  }

  // 1, 2
  Change learn(const Step& step, ValueTable<V>& table, const ChoiceDraws& draws) {
    PastStep& e = episode_[length_++];
    e = PastStep::of(step, draws);
    const Change learned = update(e, table);
    if (length_ == episode_.size()) make_room(table);
    return learned;
  }

  // 3
  void end_episode(ValueTable<V>& table) {
    while (length_ > 0) update(episode_[--length_], table);
  }

  void persist(Archive& archive) {
    const std::size_t room = episode_.size();
    episode_.resize(length_);
    persist_steps(archive, episode_, begin_, block_);
    length_ = episode_.size();
    episode_.resize(std::min(block_, std::max(room, 2 * length_)));
  }

 private:
  void make_room(ValueTable<V>& table) {
    if (length_ == block_) return end_episode(table);
    episode_.resize(std::min(block_, 2 * length_));
  }

  Change update(const PastStep& e, ValueTable<V>& table) {
    const double best_next = table.best_after(e.carry, e.next);
    const double target = e.reward + e.carry * best_next;
    return {best_next, target, learn_from(e, target, table, step_size_)};
  }

  StepSize step_size_;
  const std::vector<std::uint64_t>& begin_;
  std::size_t block_ = 0, length_ = 0;
  std::vector<PastStep> episode_;  // the steps since the last replay, and room for more
};

}  // namespace

const LearnerEntry reverse_replay{
    .method = "reverse-replay",
    .rule = "",
    .summary = "Q-learning, and each episode once more from its end back to its beginning",
    .sound = true,
    .make = method_learner<ReverseReplay>,
    .replay = nullptr,
    .formula =
        "Q(s,a) := Q(s,a) + step size * (r + discount * max Q(s',.) - Q(s,a)), and at the "
        "end of the episode once more for each of its steps, the last first"};

}  // namespace quoll
