// Parallelised Q-network: many lanes, returns that mix all lengths, no replay, no target network.
// Gallici et al. 2025 ("Simplifying deep temporal difference learning"), algorithm 1; its returns
// are Peng's Q(lambda) (Peng, Williams 1994): actions that were not greedy are not corrected for.
//
//   for each iteration:
//   1   for t = 1 .. T, in every lane:  choose a_t by Q(s_t,.), take it, see r_t, s_{t+1}
//   2   for t = T .. 1:
//         G_t <- r_t + g_t V(s_{t+1})                                  at the end or a cut
//         G_t <- r_t + g_t (lambda G_{t+1} + (1 - lambda) V(s_{t+1}))  otherwise, V = max_a Q(.,a)
//   3   K times: shuffle the T x N steps into M parts; for each part
//   4     a step down the gradient of mean L(Q(s,a), G)
//
// Q(s_t,.) as it was while walking -> values_; T -> rollout; N -> walkers; M, K -> minibatches,
// epochs; lambda -> return_decay; g, 0 after the end, negative when the turn passes -> carries_.
// Where an episode was only cut off, V(s') counts.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "quoll/learn/deep/choose.hpp"
#include "quoll/learn/deep/frames.hpp"
#include "quoll/learn/deep/learners.hpp"
#include "quoll/learn/deep/network_learner.hpp"
#include "quoll/learn/deep/q_network.hpp"

namespace quoll {
namespace {

constexpr DeepHabits habits{.hidden = "128,128",
                            .filters = "16x3",
                            .layer_norm = true,
                            .initial = nn::Initial::orthogonal,
                            .optimiser = nn::OptimiserKind::radam,
                            .learning_rate = "0.001:0.00001:500000",
                            .loss = nn::LossKind::half_squared,
                            .loss_of_states = nn::LossKind::half_squared,
                            .clip_gradient = 10.0,
                            .walkers = 16};

class Pqn final : public NetworkLearner {
 public:
  Pqn(const LearnSetup& setup, const DeepSetup& deep, std::unique_ptr<QFunction> q)
      : NetworkLearner(setup, deep, std::move(q)),
        how_(deep_.settings),
        steps_(how_.rollout * walkers_.count()),
        shuffle_(stream(setup.seed, "shuffle")),
        seen_(deep.spaces, steps_),
        chosen_(steps_),
        rewards_(steps_),
        carries_(steps_),
        over_(steps_),
        values_(steps_),
        returns_(steps_),
        order_(steps_),
        part_((steps_ + how_.minibatches - 1) / how_.minibatches),
        inputs_part_(part_ * inputs_.size()),
        chosen_part_(part_),
        predicted_(part_),
        slopes_(part_),
        row_(inputs_.size()),
        row_outputs_(actions_),
        observation_(deep.spaces.observation) {}

 private:
  void round() override;
  void persist_own(Archive& archive) override;
  void walk();
  float value_of_next(std::size_t lane);
  void find_returns();
  void learn();
  void learn_from(std::span<const std::uint32_t> steps);

  const DeepSettings& how_;
  std::size_t steps_;        // of an iteration, all lanes
  std::uint64_t at_ = 0;     // rounds of this iteration that are walked
  std::uint64_t begun_ = 0;  // steps of the run before this iteration
  Rng shuffle_;
  // Per step t and lane, at t * lanes + lane:
  Frames seen_;
  std::vector<Action> chosen_;
  std::vector<float> rewards_, carries_;
  std::vector<std::uint8_t> over_;
  std::vector<float> values_;  // max Q(s_t,.)
  std::vector<float> returns_;
  std::vector<std::uint32_t> order_;
  std::size_t part_;
  nn::Floats inputs_part_;
  std::vector<Action> chosen_part_;
  nn::Floats predicted_, slopes_, row_, row_outputs_;
  std::vector<float> observation_;
};

void Pqn::round() {
  if (at_ == 0) begun_ = walkers_.progress().steps;
  walk();
  if (++at_ < how_.rollout) return;
  find_returns();
  learn();
  at_ = 0;
}

float Pqn::value_of_next(std::size_t lane) {
  inputs_.write(walkers_.now().next, walkers_.now().next_observation, lane, row_.span());
  q_->values(QFunction::Weights::online, row_.data(), 1, row_outputs_.data());
  put_in_order(walkers_.now().next[lane], row_outputs_.data());
  const std::span<const float> q = row_outputs_.span().first(walkers_.actions_next(lane));
  return q[greedy(q)];
}

// 1
void Pqn::walk() {
  const std::size_t lanes = walkers_.count(), first = at_ * lanes;
  const std::size_t numbers = deep_.spaces.observation;
  const Experience& now = walkers_.now();
  choose_actions(true);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::size_t i = first + lane;
    seen_.write(i, now.state[lane], now.observation.subspan(lane * numbers, numbers));
    const std::span<const float> q =
        outputs_.span().subspan(lane * actions_, walkers_.actions_now(lane));
    values_[i] = q[greedy(q)];
  }
  walkers_.step();
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::size_t i = first + lane;
    const Feedback& feedback = now.feedback[lane];
    chosen_[i] = output_of(now.state[lane], now.action[lane]);
    rewards_[i] = static_cast<float>(feedback.reward * how_.reward_scale);
    carries_[i] = carry_of(feedback.terminated, feedback.turn_passes);
    over_[i] = feedback.over();
    // What follows a cut, or the last step, is worth what the network says now.
    const bool cut = feedback.truncated || (at_ + 1 == how_.rollout && !feedback.over());
    returns_[i] = cut && !feedback.terminated ? value_of_next(lane) : 0.0F;
  }
  walkers_.go_on();
}

// 2
void Pqn::find_returns() {
  const std::size_t lanes = walkers_.count();
  const auto lambda = static_cast<float>(how_.return_decay);
  for (std::size_t i = steps_; i-- > 0;) {
    const bool last = i + lanes >= steps_;
    const float following =
        over_[i] || last ? returns_[i]
                         : lambda * returns_[i + lanes] + (1.0F - lambda) * values_[i + lanes];
    returns_[i] = rewards_[i] + carries_[i] * following;
  }
}

// 3
void Pqn::learn() {
  for (std::uint64_t epoch = 0; epoch < how_.epochs; ++epoch) {
    std::iota(order_.begin(), order_.end(), 0U);
    for (std::uint32_t i = static_cast<std::uint32_t>(steps_); i > 1; --i) {
      std::swap(order_[i - 1], order_[shuffle_.below(i)]);
    }
    for (std::uint64_t m = 0; m < how_.minibatches; ++m) {
      const std::size_t begin = m * steps_ / how_.minibatches;
      const std::size_t end = (m + 1) * steps_ / how_.minibatches;
      if (begin < end) learn_from(std::span(order_).subspan(begin, end - begin));
    }
  }
}

// 4
void Pqn::learn_from(std::span<const std::uint32_t> steps) {
  const std::size_t size = inputs_.size();
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const State state = seen_.read(steps[k], observation_);
    inputs_.write(state, observation_, inputs_part_.span().subspan(k * size, size));
    chosen_part_[k] = chosen_[steps[k]];
  }
  q_->predict(inputs_part_.data(), steps.size(), chosen_part_.data(), predicted_.data());
  const float share = 1.0F / static_cast<float>(steps.size());
  double loss_sum = 0.0, value_sum = 0.0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const nn::Loss one = nn::loss(deep_.loss, predicted_[k] - returns_[steps[k]]);
    slopes_[k] = share * one.slope;
    loss_sum += one.value;
    value_sum += double{predicted_[k]};
  }
  q_->update(slopes_.data(), deep_.learning_rate.at(begun_));
  tell(loss_sum * double{share}, value_sum * double{share});
}

void Pqn::persist_own(Archive& archive) {
  archive("at", at_);
  archive("begun", begun_);
  archive("shuffle", shuffle_);
  seen_.persist(archive);
  std::span<Action> chosen = chosen_;
  std::span<float> rewards = rewards_, carries = carries_, values = values_, returns = returns_;
  std::span<std::uint8_t> over = over_;
  archive("chosen", chosen);
  archive("rewards", rewards);
  archive("carries", carries);
  archive("over", over);
  archive("values", values);
  archive("returns", returns);
  bool fits = at_ < how_.rollout && seen_.size() == steps_ && seen_.fits(deep_.spaces.states);
  for (const Action action : chosen_) fits &= action < actions_;
  if (fits) return;
  at_ = 0;
  std::fill(chosen_.begin(), chosen_.end(), Action{0});
  archive.fail("the steps of the open iteration do not fit");
}

std::unique_ptr<Learner> make(const LearnSetup& setup) {
  const Result<DeepSetup> deep = DeepSetup::make(setup, habits);
  const DeepSettings& how = deep->settings;
  const std::size_t steps = how.rollout * deep->walkers;
  const std::size_t rows =
      std::max<std::size_t>((steps + how.minibatches - 1) / how.minibatches, deep->walkers);
  return std::make_unique<Pqn>(setup, *deep, *make_q_network(*deep, setup.seed, rows, false));
}

Result<void> check(const LearnSetup& setup) {
  const Result<void> fits = check_network(setup, habits);
  if (!fits) return fits;
  constexpr std::uint64_t most_numbers = std::uint64_t{1} << 30;
  const Result<DeepSetup> deep = DeepSetup::make(setup, habits);
  const std::uint64_t steps = deep->settings.rollout * deep->walkers;
  if (steps * deep->input.size() <= most_numbers) return {};
  return Error{"--rollout", 0, 0,
               std::to_string(steps) + " steps of " + std::to_string(deep->input.size()) +
                   " numbers are too many for one iteration; fewer walkers or a shorter rollout",
               ""};
}

}  // namespace

const LearnerEntry pqn{
    .method = "pqn",
    .rule = "",
    .summary =
        "a network with layer normalisation, taught by returns of many lanes: no memory, no "
        "copy",
    .sound = true,
    .make = make,
    .replay = nullptr,
    .traits = {.approximates = true,
               .networks = true,
               .epsilon = "1:0.05:250000",
               .optimiser = habits.optimiser_name()},
    .check = check,
    .formula =
        "a step down the gradient of L(Q(s,a), G), G = r + discount * (lambda * G' + (1 - "
        "lambda) * max Q(s',.))"};

}  // namespace quoll
