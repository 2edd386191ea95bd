// Deep Q-learning with a replay and a target network. Mnih et al. 2015 ("Human-level control
// through deep reinforcement learning", algorithm 1); switches: double (van Hasselt, Guez, Silver
// 2016, equation 4), duelling (Wang et al. 2016), prioritised (Schaul et al. 2016, algorithm 1),
// multi-step (Hessel et al. 2018, section 3), categorical (Bellemare et al. 2017, algorithm 1),
// quantile (Dabney et al. 2018, algorithm 1), Munchausen (Vieillard, Pietquin, Geist 2020, section
// 3.1), noisy (Fortunato et al. 2018, algorithm 1). Any of them go together.
//
//   for each step t:
//   1   choose a by Q(s,.);  take it, see r, s';  D <- D + (s, a, r, s')
//       noisy: 1, 5 and 6 look at Q, and 5 at Q', each with noise of its own
//   2   every train_every steps after learning_starts, gradient_steps times:
//   3     draw (s_i, a_i, ...) from D: evenly, or with probability p_i^alpha / sum
//   4     R_i <- r + g r' + g^2 r'' + ... of up to n steps, g_i <- what their end is multiplied by
//   5     a* <- argmax_b Q'(s'_i, b), or of Q with double;  y_i <- R_i + g_i Q'(s'_i, a*)
//         Munchausen: y_i <- R_i + 0.9 [0.03 log pi(a_i|s_i)]_{-1}^0
//                            + g_i sum_b pi(b|s'_i) (Q'(s'_i, b) - 0.03 log pi(b|s'_i)),
//                     pi = softmax(Q' / 0.03); on s', with double, softmax(Q / 0.03)
//   6     a step down the gradient of mean w_i L(Q(s_i, a_i), y_i), w_i = (|D| P(i))^-beta / max w
//   7     p_i <- |error| + 1e-6
//   8   every target_every steps: Q' <- Q, or a part of the way
//
// D -> replay_; Q, Q' -> QFunction; R, g -> Stretch; y -> Targets; P -> priorities_; alpha, beta ->
// priority_exponent, priority_correction; g, 0 after the end, negative when the turn passes ->
// carry. Where an episode was only cut off, s' counts.

#include <algorithm>
#include <cmath>
#include <optional>

#include "quoll/learn/deep/known_values.hpp"
#include "quoll/learn/deep/learners.hpp"
#include "quoll/learn/deep/network_learner.hpp"
#include "quoll/learn/deep/priorities.hpp"
#include "quoll/learn/deep/q_network.hpp"
#include "quoll/learn/deep/replay.hpp"
#include "quoll/learn/deep/targets.hpp"

namespace quoll {
namespace {

constexpr DeepHabits habits{.hidden = "128,128",
                            .filters = "16x3",
                            .layer_norm = true,
                            .initial = nn::Initial::uniform,
                            .optimiser = nn::OptimiserKind::adam,
                            .learning_rate = "0.0005:0.00001:250000",
                            .loss = nn::LossKind::huber,
                            .loss_of_states = nn::LossKind::half_squared,
                            .clip_gradient = 10.0,
                            .walkers = 1,
                            .multi_step = 3};

class Dqn final : public NetworkLearner {
 public:
  Dqn(const LearnSetup& setup, const DeepSetup& deep, std::unique_ptr<QFunction> q)
      : NetworkLearner(setup, deep, std::move(q)),
        how_(deep_.settings),
        replay_(deep.spaces, how_.replay, deep.walkers),
        draw_(stream(setup.seed, "replay")),
        batch_(how_.batch),
        slots_(batch_),
        rewards_(batch_),
        carries_(batch_),
        weights_(batch_, 1.0F),
        chosen_(batch_),
        asked_(batch_),
        here_states_(batch_),
        next_states_(batch_),
        frames_(batch_),
        next_frames_(batch_),
        targets_of_(how_, distribution_, actions_),
        seen_(deep.spaces.observation),
        before_(batch_ * inputs_.size()),
        after_(batch_ * inputs_.size()),
        values_(batch_ * actions_ * distribution_.atoms()),
        online_values_(values_.size()),
        own_values_(values_.size()),
        predicted_(batch_ * distribution_.atoms()),
        targets_(predicted_.size()),
        slopes_(predicted_.size()) {
    if (how_.prioritised) priorities_.emplace(replay_.slots(), how_.priority_exponent);
    // Many numbers a frame would take more memory than what was seen.
    const std::size_t row = actions_ * distribution_.atoms();
    if (!how_.noisy && how_.target_share >= 1.0 && row <= most_known) known_.emplace(row);
    unknown_.reserve(batch_);
    unknown_inputs_ = nn::Floats(known_ ? before_.size() : 0);
    unknown_values_ = nn::Floats(known_ ? values_.size() : 0);
  }

 private:
  using Weights = QFunction::Weights;
  static constexpr std::size_t most_known = 64;

  void round() override;
  void persist_own(Archive& archive) override;
  void remember();
  void draw();
  void gather(std::size_t i);
  void ask_target(std::span<const std::uint64_t> frames, const nn::Floats& inputs,
                  nn::Floats& values);
  void find_targets();
  void update();

  const DeepSettings& how_;
  Replay replay_;
  std::optional<Priorities> priorities_;
  Rng draw_;
  std::size_t batch_;
  std::vector<std::uint64_t> slots_;
  std::vector<float> rewards_, carries_, weights_;
  std::vector<Action> chosen_, asked_;  // as s numbers them, as the network does
  std::vector<State> here_states_, next_states_;
  std::vector<std::uint64_t> frames_, next_frames_;
  Targets targets_of_;
  std::vector<float> seen_;
  nn::Floats before_, after_;  // inputs of s and s'
  nn::Floats values_, online_values_, own_values_;
  nn::Floats predicted_, targets_, slopes_;
  std::optional<KnownValues> known_;  // of Q', where it stays the same between two copies
  std::vector<std::size_t> unknown_;  // rows of the batch that it has to be asked
  nn::Floats unknown_inputs_, unknown_values_;
};

// How many multiples of `every` lie in (from, to].
std::uint64_t crossed(std::uint64_t from, std::uint64_t to, std::uint64_t every) {
  return to / every - from / every;
}

void Dqn::round() {
  const std::uint64_t begun = walkers_.progress().steps;
  // 1
  choose_actions(false);
  walkers_.step();
  remember();
  walkers_.go_on();
  const std::uint64_t now = walkers_.progress().steps;
  // 2
  if (now > how_.learning_starts) {
    const std::uint64_t times = crossed(begun, now, how_.train_every) * how_.gradient_steps;
    for (std::uint64_t i = 0; i < times; ++i) update();
  }
  // 8
  if (crossed(begun, now, how_.target_every) == 0) return;
  q_->sync(how_.target_share);
  if (known_) known_->forget_all();
}

void Dqn::remember() {
  replay_.push(walkers_.now());
  for (std::uint32_t lane = 0; lane < walkers_.count(); ++lane) {
    if (known_) {
      known_->forget(replay_.frame_before(replay_.newest(lane)));
      known_->forget(replay_.frame_after(replay_.newest(lane)));
    }
    if (!priorities_) continue;
    priorities_->add(replay_.newest(lane));
    priorities_->forget(replay_.forgotten_next(lane));
  }
}

// 3
void Dqn::draw() {
  const std::uint64_t size = replay_.size();
  if (priorities_) {
    const double beta = deep_.priority_correction.at(walkers_.progress().steps);
    return priorities_->draw(draw_, size, beta, slots_, weights_);
  }
  for (std::uint64_t& slot : slots_) {
    slot = replay_.slot(static_cast<std::uint64_t>(draw_.uniform() * static_cast<double>(size)));
  }
}

// 4
void Dqn::gather(std::size_t i) {
  const std::size_t size = inputs_.size();
  const Stretch all = stretch(replay_, slots_[i], how_.multi_step, discount_,
                              static_cast<float>(how_.reward_scale));
  rewards_[i] = all.reward;
  carries_[i] = all.carry;
  chosen_[i] = replay_.action(slots_[i]);
  const State state = replay_.before(slots_[i], seen_);
  inputs_.write(state, seen_, before_.span().subspan(i * size, size));
  const State next = replay_.next(all.last, seen_);
  inputs_.write(next, seen_, after_.span().subspan(i * size, size));
  frames_[i] = replay_.frame_before(slots_[i]);
  next_frames_[i] = replay_.frame_after(all.last);
  asked_[i] = output_of(state, chosen_[i]);
  here_states_[i] = state;
  next_states_[i] = next;
}

// Q' of a batch; only what it was not asked since it changed goes through it.
void Dqn::ask_target(std::span<const std::uint64_t> frames, const nn::Floats& inputs,
                     nn::Floats& values) {
  if (!known_) return q_->values(Weights::target, inputs.data(), batch_, values.data());
  const std::size_t size = inputs_.size(), row = values.size() / batch_;
  unknown_.clear();
  for (std::size_t i = 0; i < batch_; ++i) {
    if (known_->has(frames[i])) continue;
    std::copy_n(inputs.data() + i * size, size, unknown_inputs_.data() + unknown_.size() * size);
    unknown_.push_back(i);
  }
  q_->values(Weights::target, unknown_inputs_.data(), unknown_.size(), unknown_values_.data());
  for (std::size_t k = 0; k < unknown_.size(); ++k) {
    known_->keep(frames[unknown_[k]], unknown_values_.data() + k * row);
  }
  for (std::size_t i = 0; i < batch_; ++i) {
    const std::span<const float> said = (*known_)[frames[i]];
    std::copy_n(said.data(), row, values.data() + i * row);
  }
}

// 5
void Dqn::find_targets() {
  q_->redraw(Weights::target);
  ask_target(next_frames_, after_, values_);
  if (how_.munchausen) ask_target(frames_, before_, own_values_);
  if (how_.double_q) {
    q_->redraw(Weights::online);
    q_->values(Weights::online, after_.data(), batch_, online_values_.data());
  }
  const std::size_t atoms = distribution_.atoms(), row = actions_ * atoms;
  for (std::size_t i = 0; i < batch_; ++i) {
    put_in_order(next_states_[i], values_.data() + i * row);
    if (how_.munchausen) {
      put_in_order(here_states_[i], own_values_.data() + i * row);
    }
    if (how_.double_q) put_in_order(next_states_[i], online_values_.data() + i * row);
    targets_of_.find(
        {values_.data() + i * row, online_values_.data() + i * row, own_values_.data() + i * row,
         walkers_.actions_of(next_states_[i]), walkers_.actions_of(here_states_[i])},
        chosen_[i], rewards_[i], carries_[i], targets_.span().subspan(i * atoms, atoms));
  }
}

void Dqn::update() {
  draw();
  for (std::size_t i = 0; i < batch_; ++i) gather(i);
  find_targets();
  // 6
  q_->redraw(Weights::online);
  q_->predict(before_.data(), batch_, asked_.data(), predicted_.data());
  const std::size_t atoms = distribution_.atoms();
  const float share = 1.0F / static_cast<float>(batch_);
  double loss_sum = 0.0, value_sum = 0.0;
  for (std::size_t i = 0; i < batch_; ++i) {
    const std::span<const float> x = predicted_.span().subspan(i * atoms, atoms);
    const std::span<const float> y = targets_.span().subspan(i * atoms, atoms);
    const std::span<float> slope = slopes_.span().subspan(i * atoms, atoms);
    const float weight = share * weights_[i];
    double surprise = 0.0;
    if (how_.returns == Returns::categorical) {
      surprise = nn::cross_entropy(x, y, weight, slope);
    } else if (how_.returns == Returns::quantile) {
      surprise = nn::quantile_huber(x, y, weight, slope);
    } else {
      const nn::Loss one = nn::loss(deep_.loss, x[0] - y[0]);
      slope[0] = weight * one.slope;
      surprise = std::fabs(double{x[0]} - double{y[0]});
      loss_sum += one.value * double{weights_[i]};
    }
    if (how_.returns != Returns::mean) loss_sum += surprise * double{weights_[i]};
    value_sum += double{distribution_.mean(x)};
    // 7
    if (priorities_) priorities_->set(slots_[i], surprise);
  }
  q_->update(slopes_.data(), deep_.learning_rate.at(walkers_.progress().steps));
  tell(loss_sum * double{share}, value_sum * double{share});
}

void Dqn::persist_own(Archive& archive) {
  archive("replay", replay_);
  archive("draw", draw_);
  if (priorities_) archive("priorities", *priorities_);
}

std::unique_ptr<Learner> make(const LearnSetup& setup) {
  const Result<DeepSetup> deep = DeepSetup::make(setup, habits);
  const std::size_t rows = std::max<std::size_t>(deep->settings.batch, deep->walkers);
  return std::make_unique<Dqn>(setup, *deep, *make_q_network(*deep, setup.seed, rows, true));
}

Result<void> check(const LearnSetup& setup) {
  const Result<void> fits = check_network(setup, habits);
  if (!fits) return fits;
  return check_replay(*DeepSetup::make(setup, habits));
}

}  // namespace

const LearnerEntry dqn{
    .method = "dqn",
    .rule = "",
    .summary = "a network that replays what it remembers, with a slower copy of it for targets",
    .sound = true,
    .make = make,
    .replay = nullptr,
    .traits = {.approximates = true,
               .networks = true,
               .epsilon = "1:0.05:10000",
               .optimiser = habits.optimiser_name()},
    .check = check,
    .formula = "a step down the gradient of L(Q(s,a), r + discount * max Q'(s',.)), Q' the copy"};

}  // namespace quoll
