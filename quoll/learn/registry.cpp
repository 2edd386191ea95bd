// The learners, one line each.

#include <array>

#include "quoll/base/text.hpp"
#include "quoll/learn/deep/learners.hpp"
#include "quoll/learn/greedy_rows.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/learn/tabular/rules.hpp"

namespace quoll {

std::span<const LearnerEntry> learners() {
  static const std::array entries{
      q_learning_standard,
      q_learning_as_printed,
      q_learning_reward_estimate,
      reverse_replay,
      dyna_q,
      dyna_q_plus,
      prioritised_sweeping,
      empirical_model,
      optimistic_model,
      posterior_sampling,
      sarsa,
      expected_sarsa,
      double_q,
      n_step,
      tree_backup,
      q_lambda,
      ucb_q,
      linear_q,
      nfq,
      dqn,
      pqn,
      stream_q,
  };
  return entries;
}

Result<const LearnerEntry*> find_learner(const LearnSettings& settings) {
  if (settings.method == distil.method) return &distil;
  return find_offered(settings);
}

Result<const LearnerEntry*> find_offered(const LearnSettings& settings) {
  Nearest method(settings.method), rule(settings.rule);
  bool method_known = false;
  for (const LearnerEntry& entry : learners()) {
    method.offer(entry.method);
    if (entry.method != settings.method) continue;
    method_known = true;
    if (entry.rule.empty() && settings.rule != "standard") {
      return Error{"--rule", 0, 0,
                   settings.method + " has no choice of rules, but '" + settings.rule +
                       "' is given; only q-learning has",
                   ""};
    }
    if (entry.rule.empty() || entry.rule == settings.rule) return &entry;
    rule.offer(entry.rule);
  }
  if (!method_known) {
    return Error{"--method", 0, 0, "no method '" + settings.method + "'; see 'quoll list methods'",
                 method.best()};
  }
  return Error{"--rule", 0, 0,
               "standard, as-printed or reward-estimate expected, not '" + settings.rule + "'",
               rule.best()};
}

Result<std::unique_ptr<Learner>> make_learner(const LearnSettings& settings, const World& world,
                                              const std::vector<double>& initial_rewards) {
  const Result<const LearnerEntry*> entry = find_learner(settings);
  if (!entry) return entry.error();
  const Result<LearnSetup> setup = resolve(settings, world, initial_rewards);
  if (!setup) return setup.error();
  return (*entry)->make(*setup);
}

std::vector<Action> greedy_policy(const Estimates& estimates) {
  const std::vector<std::uint64_t>& begin = estimates.row_begin;
  if (begin.empty()) return {};
  std::vector<Action> policy(begin.size() - 1, no_action);
  for (std::size_t s = 0; s < policy.size(); ++s) {
    // Nobody acts in an end, so its pairs are never visited.
    const bool foreseen = !estimates.foreseen.empty() && estimates.foreseen[s] != 0;
    policy[s] = best_visited(
        static_cast<Action>(begin[s + 1] - begin[s]),
        [&](Action a) { return estimates.q[begin[s] + a]; },
        [&](Action a) { return foreseen || estimates.visits[begin[s] + a] > 0; });
  }
  return policy;
}

std::unique_ptr<Policy> Learner::policy() const {
  return std::make_unique<TablePolicy>(greedy_policy(estimates()));
}

}  // namespace quoll
