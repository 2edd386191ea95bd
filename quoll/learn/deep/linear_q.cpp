// Watkins's Q(lambda) with a linear function of tiles. Sutton, Barto 2018: tile coding in section
// 9.5.4, control with binary features and replacing traces in 12.7, the cut in 12.10; the bound of
// the step in Dabney, Barto 2012 ("Adaptive step-size for online temporal difference learning").
//
//   Q(s,a) = sum of w(i,a) over the features i in F(s);  w <- 0
//   for each episode: s <- start(); z <- 0
//     until s is an end or the episode is cut off:
//   1   choose a in A(s);  if Q(s,a) < max_b Q(s,b) then z <- 0   (unless keep_traces)
//   2   take a, see r and s'
//   3   delta <- r + gamma max_b Q(s',b) - Q(s,a)
//   4   z(i,a) <- 1 for i in F(s)
//   5   w <- w + (alpha / |F|) delta z
//   6   z <- gamma lambda z;  entries below 0.01 are dropped
//     s <- s'
//
// w -> weights_; z -> trace_, not 0 where live_ says; F -> LinearFeatures; alpha -> tile_step_size;
// lambda -> trace_decay; gamma, 0 after the end, negative when the turn passes -> carry. Cost:
// about |F| log(0.01) / log(gamma lambda) weights a step. With a feature for each state and lambda
// = 0 it is the table's Q learning.

#include <cmath>
#include <vector>

#include "quoll/learn/deep/choose.hpp"
#include "quoll/learn/deep/learners.hpp"
#include "quoll/learn/deep/linear_features.hpp"
#include "quoll/learn/deep/walkers.hpp"
#include "quoll/learn/tabular/any_source.hpp"

namespace quoll {
namespace {

// Q(s,.) of the features that are on.
void values_of(std::span<const float> weights, std::span<const std::uint32_t> on,
               std::span<float> q) {
  std::fill(q.begin(), q.end(), 0.0F);
  for (const std::uint32_t first : on) {
    for (std::size_t a = 0; a < q.size(); ++a) q[a] += weights[first + a];
  }
}

class LinearPolicy final : public Policy {
 public:
  LinearPolicy(LinearFeatures features, std::vector<float> weights)
      : features_(std::move(features)), weights_(std::move(weights)) {}

  void act(const Experience& now, std::span<Action> out, std::span<Rng>) const override {
    std::uint32_t on[most_on];
    std::vector<float> q(features_.actions());
    const std::span<std::uint32_t> active(on, features_.on());
    for (std::size_t lane = 0; lane < out.size(); ++lane) {
      features_.of(now.state, now.observation, lane, active);
      values_of(weights_, active, q);
      out[lane] = greedy(q);
    }
  }

  static constexpr std::size_t most_on = 1024;

 private:
  LinearFeatures features_;
  std::vector<float> weights_;
};

class LinearQ final : public Learner {
 public:
  LinearQ(const LearnSetup& setup, LinearFeatures features)
      : features_(std::move(features)),
        walkers_(setup, 1),
        exploration_(setup.exploration),
        behaviour_(stream(setup.seed, "behaviour")),
        discount_(setup.discount),
        step_size_(setup.linear.tile_step_size / features_.on()),
        lambda_(setup.of_method.trace_decay),
        cut_(!setup.linear.keep_traces),
        weights_(features_.weights()),
        trace_(features_.weights()),
        row_begin_(features_.numbered() ? AnySource<float>::rows_of(*setup.world)
                                        : std::vector<std::uint64_t>()),
        visits_(features_.numbered() ? features_.weights() : 0),
        q_(features_.actions()),
        here_(features_.on()),
        there_(features_.on()) {}

  LearnProgress advance(std::uint64_t steps, std::span<Update>) override {
    walkers_.forget_finished();
    for (std::uint64_t i = 0; i < steps && halt_ == LearnProgress::Halt::none; ++i) step();
    return progress();
  }
  LearnProgress progress() const override {
    LearnProgress now = walkers_.progress();
    now.halt = halt_;
    return now;
  }
  std::span<const FinishedEpisode> finished() const override { return walkers_.finished(); }
  std::vector<Measure> measures() const override {
    return {{"td_loss", squared_errors_, walkers_.progress().steps},
            {"q_values", values_, walkers_.progress().steps}};
  }
  std::unique_ptr<Policy> policy() const override {
    if (features_.numbered()) return Learner::policy();
    return std::make_unique<LinearPolicy>(features_, weights_);
  }
  Estimates estimates() const override;
  void persist(Archive& archive) override;

 private:
  static constexpr double least = 0.01;  // of a trace

  void step();
  void learn(Action action, double delta, double carry);
  void clear_traces() {
    for (const std::uint32_t i : live_) trace_[i] = 0.0F;
    live_.clear();
  }

  LinearFeatures features_;
  Walkers walkers_;
  Exploration exploration_;
  Rng behaviour_;
  double discount_, step_size_, lambda_;
  bool cut_;
  std::vector<float> weights_, trace_;
  std::vector<std::uint32_t> live_;       // weights whose trace is not 0
  std::vector<std::uint64_t> row_begin_;  // of the estimates, where states are numbered
  std::vector<std::uint32_t> visits_;     // per weight, there
  std::vector<float> q_;
  std::vector<std::uint32_t> here_, there_;  // features of s and s'
  double squared_errors_ = 0.0, values_ = 0.0;
  LearnProgress::Halt halt_ = LearnProgress::Halt::none;
};

void LinearQ::step() {
  // 1
  const Experience& now = walkers_.now();
  features_.of(now.state, now.observation, 0, here_);
  std::span<float> q = std::span(q_).first(walkers_.actions_now(0));
  values_of(weights_, here_, q);
  const ChoiceDraws draws = ChoiceDraws::of(behaviour_);
  const Action action = choose(exploration_, q, draws, walkers_.progress().steps).action;
  const double value = double{q[action]};
  if (cut_ && q[action] < q[greedy(q)]) clear_traces();
  // 2
  walkers_.actions()[0] = action;
  walkers_.step();
  // 3
  const Feedback& feedback = now.feedback[0];
  double carry = 0.0, best_next = 0.0;
  if (!feedback.terminated) {
    carry = feedback.turn_passes ? -discount_ : discount_;
    features_.of(now.next, now.next_observation, 0, there_);
    q = std::span(q_).first(walkers_.actions_next(0));
    values_of(weights_, there_, q);
    best_next = double{q[greedy(q)]};
  }
  const double delta = feedback.reward + carry * best_next - value;
  if (!(std::fabs(delta) < 1e30)) halt_ = LearnProgress::Halt::diverged;
  squared_errors_ += delta * delta;
  values_ += value;
  if (features_.numbered()) ++visits_[here_[0] + action];
  learn(action, delta, carry);
  if (feedback.over()) clear_traces();
  walkers_.go_on();
}

void LinearQ::learn(Action action, double delta, double carry) {
  // 4
  for (const std::uint32_t first : here_) {
    float& trace = trace_[first + action];
    if (trace == 0.0F) live_.push_back(first + action);
    trace = 1.0F;
  }
  // 5, 6
  const auto change = static_cast<float>(step_size_ * delta);
  const auto decay = static_cast<float>(carry * lambda_);
  std::size_t kept = 0;
  for (const std::uint32_t i : live_) {
    weights_[i] += change * trace_[i];
    trace_[i] *= decay;
    if (std::fabs(trace_[i]) < least)
      trace_[i] = 0.0F;
    else
      live_[kept++] = i;
  }
  live_.resize(kept);
}

Estimates LinearQ::estimates() const {
  Estimates out;
  out.row_begin = row_begin_;
  for (std::size_t s = 0; s + 1 < row_begin_.size(); ++s) {
    const std::uint64_t first = s * features_.actions();
    for (std::uint64_t a = 0; a < row_begin_[s + 1] - row_begin_[s]; ++a) {
      out.q.push_back(double{weights_[first + a]});
      out.visits.push_back(visits_[first + a]);
    }
  }
  return out;
}

void LinearQ::persist(Archive& archive) {
  archive("walkers", walkers_);
  archive("behaviour", behaviour_);
  archive("squared_errors", squared_errors_);
  archive("values", values_);
  archive("halt", halt_);
  std::vector<float> traces;
  for (const std::uint32_t i : live_) traces.push_back(trace_[i]);
  std::vector<std::uint32_t> live = live_;
  const std::size_t weights = weights_.size(), visits = visits_.size();
  archive("weights", weights_);
  archive("visits", visits_);
  archive("live", live);
  archive("traces", traces);
  if (archive.saving()) return;
  bool fits = weights_.size() == weights && visits_.size() == visits &&
              live.size() == traces.size() && halt_ <= LearnProgress::Halt::diverged;
  weights_.resize(weights);
  visits_.resize(visits);
  clear_traces();
  for (std::size_t k = 0; fits && k < live.size(); ++k) {
    fits = live[k] < weights && std::fabs(traces[k]) <= 1.0F && trace_[live[k]] == 0.0F;
    if (!fits) break;
    trace_[live[k]] = traces[k];
    live_.push_back(live[k]);
  }
  if (fits) return;
  halt_ = LearnProgress::Halt::none;
  archive.fail("the saved weights do not fit this world");
}

std::unique_ptr<Learner> make(const LearnSetup& setup) {
  return std::make_unique<LinearQ>(setup, *LinearFeatures::make(setup));
}

Result<void> check(const LearnSetup& setup) {
  using Kind = Exploration::Kind;
  if (setup.exploration.kind == Kind::ucb || setup.exploration.kind == Kind::count_bonus) {
    return Error{"--explore", 0, 0,
                 "linear-q counts no visits of what it observes: no " +
                     std::string(setup.exploration.name()),
                 "epsilon-greedy"};
  }
  const Result<LinearFeatures> features = LinearFeatures::make(setup);
  return features ? Result<void>() : features.error();
}

}  // namespace

const LearnerEntry linear_q{
    .method = "linear-q",
    .rule = "",
    .summary =
        "a linear function of tiles over the observed numbers, with traces: between table "
        "and network",
    .sound = true,
    .make = make,
    .replay = nullptr,
    .traits = {.approximates = true},
    .check = check,
    .formula =
        "w := w + step size / |F| * (r + discount * max Q(s',.) - Q(s,a)) * z, Q(s,a) = sum "
        "of w(i,a) over the tiles i in F(s)"};

}  // namespace quoll
