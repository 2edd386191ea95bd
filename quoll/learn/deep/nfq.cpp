// Neural fitted Q iteration: a network that is fitted, again and again, to all that was seen.
// Riedmiller 2005 ("Neural fitted Q iteration: first experiences with a data efficient neural
// reinforcement learning method", figure 1), in its growing batch: what is learned chooses what is
// seen next. The fit is by Rprop (Riedmiller, Braun 1993), whose steps look at signs only and so
// want the gradient of all of D.
//
//   for each step t:
//   1   choose a by Q(s,.);  take it, see r, s';  D <- D + (s, a, r, s')
//   2   every train_every steps, `fits` times:
//   3     for all i in D: y_i <- R_i + g_i max_b Q(s'_i, b)
//   4     Rprop begins anew;  epochs times: a step by the gradient of mean L(Q(s_i, a_i), y_i)
//
// D -> replay_; Q -> QFunction; R, g -> Stretch: g is 0 after the end, negative when the turn
// passes, and of up to multi_step steps. Where an episode was only cut off, s' counts. The weights
// of a fit go on from those of the one before. D goes through the network in parts, whose gradients
// are added. Where Q gives the targets of 3 already, there is nothing to fit until more is seen.

#include <algorithm>
#include <cmath>

#include "quoll/learn/deep/choose.hpp"
#include "quoll/learn/deep/learners.hpp"
#include "quoll/learn/deep/network_learner.hpp"
#include "quoll/learn/deep/q_network.hpp"
#include "quoll/learn/deep/replay.hpp"
#include "quoll/learn/deep/targets.hpp"

namespace quoll {
namespace {

constexpr DeepHabits habits{.hidden = "64",
                            .filters = "16x3",
                            .layer_norm = false,
                            .initial = nn::Initial::uniform,
                            .optimiser = nn::OptimiserKind::rprop,
                            .learning_rate = "0.01",
                            .loss = nn::LossKind::squared,
                            .loss_of_states = nn::LossKind::squared,
                            .clip_gradient = 0.0,
                            .walkers = 1,
                            .replay = 20'000,
                            .train_every = 1000,
                            .epochs = 30,
                            .fits = 20,
                            .activation = nn::Activation::tanh};

// Transitions that go through the network together: what they need stays in the cache.
constexpr std::size_t part_size = 256;
// Q is not fitted to targets that it gives already within that share of their size.
constexpr double settled = 1e-3;

class Nfq final : public NetworkLearner {
 public:
  Nfq(const LearnSetup& setup, const DeepSetup& deep, std::unique_ptr<QFunction> q)
      : NetworkLearner(setup, deep, std::move(q)),
        how_(deep_.settings),
        replay_(deep.spaces, how_.replay, deep.walkers),
        seen_(deep.spaces.observation),
        rows_(part_size * inputs_.size()),
        values_(part_size * actions_),
        predicted_(part_size),
        slopes_(part_size),
        carries_(part_size),
        next_(part_size),
        chosen_(part_size) {}

 private:
  void round() override;
  bool unfinished() const override { return fits_left_ > 0; }
  void persist_own(Archive& archive) override;
  void step();
  void fit();
  void find_targets();
  /// Of all of D but its last part, whose slopes are left. Returns how far Q is from the targets,
  /// of their size.
  double find_gradient();
  /// Calls what(begin, count) for all of D, part by part.
  template <class What>
  void in_parts(What what) {
    for (std::size_t begin = 0; begin < targets_.size(); begin += part_size) {
      what(begin, std::min(part_size, targets_.size() - begin));
    }
  }
  std::span<float> row(std::size_t i) {
    return rows_.span().subspan(i * inputs_.size(), inputs_.size());
  }

  const DeepSettings& how_;
  Replay replay_;
  std::vector<float> seen_;
  // Of the fits that are due.
  std::uint64_t fits_left_ = 0, epoch_ = 0;
  std::vector<float> targets_;  // of all of D
  // Of one part.
  nn::Floats rows_, values_, predicted_, slopes_, carries_;
  std::vector<State> next_;
  std::vector<Action> chosen_;
};

void Nfq::round() {
  if (fits_left_ == 0) step();
  fit();
}

void Nfq::step() {
  const std::uint64_t begun = walkers_.progress().steps;
  // 1
  choose_actions(false);
  walkers_.step();
  replay_.push(walkers_.now());
  walkers_.go_on();
  // 2
  if (walkers_.progress().steps / how_.train_every == begun / how_.train_every) return;
  fits_left_ = how_.fits;
}

// Until all fits that are due are done, or nobody wants to wait for them.
void Nfq::fit() {
  while (fits_left_ > 0 && keep_going()) {
    if (epoch_ == 0) {
      find_targets();
      q_->forget_steps();
    }
    // 4
    const double error = find_gradient();
    const bool rests = epoch_ == 0 && error <= settled;
    if (!rests) q_->update(slopes_.data(), deep_.learning_rate.at(walkers_.progress().steps));
    if (rests || halt_ != LearnProgress::Halt::none) {
      fits_left_ = epoch_ = 0;
    } else if (++epoch_ == how_.epochs) {
      epoch_ = 0;
      --fits_left_;
    }
  }
}

// 3
void Nfq::find_targets() {
  targets_.resize(replay_.size());
  in_parts([&](std::size_t begin, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const Stretch all = stretch(replay_, replay_.slot(begin + i), how_.multi_step, discount_,
                                  static_cast<float>(how_.reward_scale));
      const State next = replay_.next(all.last, seen_);
      inputs_.write(next, seen_, row(i));
      targets_[begin + i] = all.reward;
      carries_[i] = all.carry;
      next_[i] = next;
    }
    q_->values(QFunction::Weights::online, rows_.data(), count, values_.data());
    for (std::size_t i = 0; i < count; ++i) {
      put_in_order(next_[i], values_.data() + i * actions_);
      const std::span<const float> q =
          values_.span().subspan(i * actions_, walkers_.actions_of(next_[i]));
      if (carries_[i] != 0.0F) targets_[begin + i] += carries_[i] * q[greedy(q)];
    }
  });
}

double Nfq::find_gradient() {
  const float share = 1.0F / static_cast<float>(targets_.size());
  double loss_sum = 0.0, value_sum = 0.0, errors = 0.0, squares = 0.0;
  in_parts([&](std::size_t begin, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t slot = replay_.slot(begin + i);
      const State state = replay_.before(slot, seen_);
      chosen_[i] = output_of(state, replay_.action(slot));
      inputs_.write(state, seen_, row(i));
    }
    q_->predict(rows_.data(), count, chosen_.data(), predicted_.data());
    for (std::size_t i = 0; i < count; ++i) {
      const float target = targets_[begin + i], error = predicted_[i] - target;
      const nn::Loss one = nn::loss(deep_.loss, error);
      slopes_[i] = share * one.slope;
      loss_sum += one.value;
      value_sum += double{predicted_[i]};
      errors += double{error} * double{error};
      squares += double{target} * double{target};
    }
    if (begin + count < targets_.size()) q_->add(slopes_.data());
  });
  tell(loss_sum * double{share}, value_sum * double{share});
  return std::sqrt(errors / std::max(squares, 1e-30));
}

void Nfq::persist_own(Archive& archive) {
  archive("replay", replay_);
  archive("fits_left", fits_left_);
  archive("epoch", epoch_);
  std::vector<float> targets = epoch_ > 0 ? targets_ : std::vector<float>();
  archive("targets", targets);
  targets_ = std::move(targets);
  const bool fits = fits_left_ <= how_.fits && epoch_ < how_.epochs &&
                    targets_.size() == (epoch_ > 0 ? replay_.size() : 0) &&
                    (epoch_ == 0 || fits_left_ > 0);
  if (fits) return;
  fits_left_ = epoch_ = 0;
  archive.fail("the fit that was under way does not go with what is remembered");
}

std::unique_ptr<Learner> make(const LearnSetup& setup) {
  const Result<DeepSetup> deep = DeepSetup::make(setup, habits);
  const std::size_t rows = std::max<std::size_t>(part_size, deep->walkers);
  return std::make_unique<Nfq>(setup, *deep, *make_q_network(*deep, setup.seed, rows, false));
}

Result<void> check(const LearnSetup& setup) {
  const Result<void> fits = check_network(setup, habits);
  if (!fits) return fits;
  return check_replay(*DeepSetup::make(setup, habits));
}

}  // namespace

const LearnerEntry nfq{
    .method = "nfq",
    .rule = "",
    .summary = "a network that is fitted, again and again, to all that was seen",
    .sound = true,
    .make = make,
    .replay = nullptr,
    .traits = {.approximates = true,
               .networks = true,
               .epsilon = "1:0.05:5000",
               .optimiser = habits.optimiser_name()},
    .check = check,
    .formula =
        "again and again: y := r + discount * max Q(s',.) of all that was seen, then Q := the "
        "network with the least L(Q(s,a), y)"};

}  // namespace quoll
