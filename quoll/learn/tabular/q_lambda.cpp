// Watkins's Q(lambda) with replacing traces. Watkins 1989 (thesis, section 7.4); Singh, Sutton 1996
// ("Reinforcement learning with replacing eligibility traces"); Sutton, Barto 2018, section 12.10.
//
//   for each episode: s <- start(); e <- 0; choose a in A(s)
//     until s is an end or the episode is cut off:
//   1   take a, see r and s'; N(s,a) <- N(s,a) + 1; choose a' in A(s')
//   2   a* <- a' if it is among the best in s', else argmax_b Q(s',b)
//   3   delta <- r + gamma Q(s',a*) - Q(s,a)
//   4   e(s,b) <- 0 for b /= a;  e(s,a) <- 1
//   5   for all (x,u) with e(x,u) /= 0:
//         Q(x,u) <- Q(x,u) + alpha(N(x,u)) delta e(x,u)
//         e(x,u) <- gamma lambda e(x,u) if a' = a*, else 0;  dropped below 0.001
//     s <- s', a <- a'
//
// e -> live_; lambda -> trace_decay; a' -> next_action; alpha -> StepSize; gamma, 0 after the end,
// negative when the turn passes -> carry. Behaviour that is often not greedy clears the trace each
// time: with uniform actions there is hardly any. Under noise alpha should not be above 1/2. Cost:
// at most log(0.001) / log(gamma lambda) live pairs a step.

#include <algorithm>
#include <cmath>
#include <vector>

#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/rules.hpp"
#include "quoll/learn/tabular/towards.hpp"

namespace quoll {
namespace {

struct Trace {
  std::uint64_t pair = 0;
  State state = 0;
  double weight = 1.0;

  void persist(Archive& archive) {
    archive("pair", pair);
    archive("state", state);
    archive("weight", weight);
  }
};

template <class V>
class QLambda {
 public:
  using Value = V;
  static constexpr bool looks_ahead = true;
  static constexpr double least = 1e-3;

  QLambda(const LearnSetup& setup, const ValueTable<V>& table)
      : step_size_(setup.step_size), begin_(table.begin()), lambda_(setup.of_method.trace_decay) {}

  Change learn(const Step& step, ValueTable<V>& table, const ChoiceDraws& draws) {
    // 2
    const double best_next = table.best_after(step.carry, step.next);
    const bool greedy =
        !step.terminated && double{table[table.pair(step.next, step.next_action)]} == best_next;
    // 3: rounded as the table is, so that what is learned already gives exactly 0.
    const double target = double{static_cast<V>(step.reward + step.carry * best_next)};
    const double delta = target - double{table[step.pair]};
    const double alpha = step_size_.at(step.n);
    // 4
    std::erase_if(live_, [&](const Trace& e) { return e.state == step.state; });
    // 5
    if (delta != 0.0) {
      for (const Trace& e : live_) {
        step_towards(table, e.state, e.pair, double{table[e.pair]} + delta * e.weight,
                     step_size_.at(table.visits(e.pair)), step_size_, draws.own(e.pair));
      }
    }
    step_towards(table, step.state, step.pair, target, alpha, step_size_, draws.rounding());
    live_.push_back({step.pair, step.state, 1.0});
    const double decay = greedy ? step.carry * lambda_ : 0.0;
    for (Trace& e : live_) e.weight *= decay;
    std::erase_if(live_, [](const Trace& e) { return std::fabs(e.weight) < least; });
    return {best_next, target, alpha};
  }

  void end_episode(ValueTable<V>&) { live_.clear(); }

  void persist(Archive& archive) {
    archive("traces", live_);
    for (const Trace& e : live_) {
      if (e.state < begin_.size() - 1 && e.pair >= begin_[e.state] &&
          e.pair < begin_[e.state + 1] && std::fabs(e.weight) <= 1.0) {
        continue;
      }
      live_.clear();
      return archive.fail("traces of another world");
    }
  }

 private:
  StepSize step_size_;
  const std::vector<std::uint64_t>& begin_;
  double lambda_;
  std::vector<Trace> live_;
};

}  // namespace

const LearnerEntry q_lambda{
    .method = "q-lambda",
    .rule = "",
    .summary = "each error changes the pairs on the way there, too, as long as the best was done",
    .sound = true,
    .make = method_learner<QLambda>,
    .replay = nullptr,
    .formula =
        "Q(x,u) := Q(x,u) + step size * e(x,u) * (r + discount * max Q(s',.) - Q(s,a)), "
        "e(s,a) = 1, e = (discount * lambda)^k for pairs k steps back"};

}  // namespace quoll
