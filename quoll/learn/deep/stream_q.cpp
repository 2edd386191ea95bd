// Stream Q(lambda): a network that learns from each step once, as it comes: no replay, no batch, no
// target network. Elsayed, Vasan, Mahmood 2024 ("Streaming deep reinforcement learning finally
// works"), stream Q(lambda), with the numbers of its authors' program.
//
//   z <- 0
//   for each step:
//   1   choose a by Q(s,.);  take it, see r and s', both scaled by what was seen so far:
//       s by the mean and deviation of each number, r by the deviation of u <- gamma u + r
//   2   delta <- r + gamma max_b Q(s',b) - Q(s,a)
//   3   z <- gamma lambda z + grad Q(s,a);  M <- alpha kappa max(|delta|, 1) sum |z|
//   4   w <- w + min(1, 1 / M) alpha delta z
//   5   if a was not greedy, or the episode is over, z <- 0
//     s <- s'
//
// z -> the traces of QFunction; alpha -> learning_rate; kappa -> overshoot_bound; lambda ->
// trace_decay; gamma, 0 after the end, negative when the turn passes -> carry. Where an episode was
// only cut off, s' counts, which it does not in the authors' program; nor are inputs told the time.
// The network begins sparse, and its layers are normalised without gains; its units leak.

#include <algorithm>
#include <cmath>

#include "quoll/learn/deep/choose.hpp"
#include "quoll/learn/deep/learners.hpp"
#include "quoll/learn/deep/network_learner.hpp"
#include "quoll/learn/deep/q_network.hpp"

namespace quoll {
namespace {

constexpr DeepHabits habits{.hidden = "32,32",
                            .filters = "16x3",
                            .layer_norm = true,
                            .initial = nn::Initial::sparse,
                            .optimiser = nn::OptimiserKind::sgd,
                            .learning_rate = "1",
                            .loss = nn::LossKind::squared,
                            .loss_of_states = nn::LossKind::squared,
                            .clip_gradient = 0.0,
                            .walkers = 1,
                            .activation = nn::Activation::leaky_relu,
                            .hidden_of_planes = "128",
                            .plain_norm = true,
                            .running = true,
                            .traces = true};

class StreamQ final : public NetworkLearner {
 public:
  StreamQ(const LearnSetup& setup, const DeepSetup& deep, std::unique_ptr<QFunction> q)
      : NetworkLearner(setup, deep, std::move(q)),
        lambda_(setup.of_method.trace_decay),
        observed_(deep.running ? inputs_.size() : 0),
        returns_(1),
        there_(inputs_.size()),
        values_(actions_) {}

 private:
  void round() override;
  void persist_own(Archive& archive) override;
  double value_scale() const override {
    return deep_.settings.reward_scale / returns_.deviation(0);
  }
  void look(std::span<const float> observation);
  float scaled(const Feedback& feedback);
  float best_of_next();

  double lambda_;
  RunningScale observed_;  // per input
  RunningScale returns_;   // of u
  double u_ = 0.0;
  double decay_ = 0.0;  // gamma lambda of the step before
  bool begins_ = true;  // whether what is seen now was not yet the next of a step
  nn::Floats there_, values_;
};

void StreamQ::look(std::span<const float> observation) {
  if (observed_.size() == 0) return;
  observed_.add(observation);
  inputs_.scale_by(observed_);
}

float StreamQ::scaled(const Feedback& feedback) {
  const double reward = feedback.reward * deep_.settings.reward_scale;
  u_ = (feedback.over() ? 0.0 : double{discount_} * u_) + reward;
  returns_.add(std::span<const double>(&u_, 1));
  return static_cast<float>(reward / returns_.deviation(0));
}

float StreamQ::best_of_next() {
  inputs_.write(walkers_.now().next, walkers_.now().next_observation, 0, there_.span());
  q_->values(QFunction::Weights::online, there_.data(), 1, values_.data());
  put_in_order(walkers_.now().next[0], values_.data());
  const std::span<const float> q = values_.span().first(walkers_.actions_next(0));
  return q[greedy(q)];
}

void StreamQ::round() {
  // 1
  if (begins_) look(walkers_.now().observation);
  choose_actions(true);
  const Action action = walkers_.actions()[0];
  const std::span<const float> q = outputs_.span().first(walkers_.actions_now(0));
  const bool explored = q[action] < q[greedy(q)];
  walkers_.step();
  const Feedback feedback = walkers_.now().feedback[0];
  const float reward = scaled(feedback);
  look(walkers_.now().next_observation);
  // 2
  const float carry = carry_of(feedback.terminated, feedback.turn_passes);
  const float next = feedback.terminated ? 0.0F : best_of_next();
  float value = 0.0F;
  const Action asked = output_of(walkers_.now().state[0], action);
  q_->predict(inputs_of(0).data(), 1, &asked, &value);
  const double delta = double{reward} + double{carry} * double{next} - double{value};
  // 3, 4
  const float slope = 1.0F;
  q_->follow_traces(&slope, {.decay = decay_,
                             .delta = delta,
                             .step_size = deep_.learning_rate.at(walkers_.progress().steps),
                             .bound = deep_.settings.overshoot_bound});
  tell(delta * delta, double{value});
  // 5
  decay_ = double{carry} * lambda_;
  begins_ = feedback.over();
  if (explored || begins_) {
    q_->clear_traces();
    decay_ = 0.0;
  }
  walkers_.go_on();
}

void StreamQ::persist_own(Archive& archive) {
  archive("observed", observed_);
  archive("returns", returns_);
  archive("u", u_);
  archive("decay", decay_);
  archive("begins", begins_);
  if (observed_.size() > 0) inputs_.scale_by(observed_);
}

std::unique_ptr<Learner> make(const LearnSetup& setup) {
  const Result<DeepSetup> deep = DeepSetup::make(setup, habits);
  return std::make_unique<StreamQ>(setup, *deep, *make_q_network(*deep, setup.seed, 1, false));
}

Result<void> check(const LearnSetup& setup) {
  return check_network(setup, habits);
}

}  // namespace

const LearnerEntry stream_q{
    .method = "stream-q",
    .rule = "",
    .summary = "a network that learns from each step once, with traces: no memory, no batch",
    .sound = true,
    .make = make,
    .replay = nullptr,
    .traits = {.approximates = true, .networks = true, .epsilon = "1:0.01:25000"},
    .check = check,
    .formula =
        "w := w + step * delta * z, z the trace of the gradients of Q, delta = r + discount * "
        "max Q(s',.) - Q(s,a), the step bounded"};

}  // namespace quoll
