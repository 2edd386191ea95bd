// The learners, one line each.

#include <array>

#include "quoll/base/text.hpp"
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
  };
  return entries;
}

Result<const LearnerEntry*> find_learner(const LearnSettings& settings) {
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
  const Result<TabularSetup> setup = resolve(settings, world, initial_rewards);
  if (!setup) return setup.error();
  return (*entry)->make(*setup);
}

std::vector<Action> greedy_policy(const Estimates& estimates) {
  const std::vector<std::uint64_t>& begin = estimates.row_begin;
  std::vector<Action> policy(begin.size() - 1, no_action);
  for (std::size_t s = 0; s < policy.size(); ++s) {
    for (std::uint64_t c = begin[s]; c < begin[s + 1]; ++c) {
      // Nobody acts in an end, so its pairs are never visited.
      if (estimates.visits[c] == 0) continue;
      const Action best = policy[s];
      if (best == no_action || estimates.q[c] > estimates.q[begin[s] + best]) {
        policy[s] = static_cast<Action>(c - begin[s]);
      }
    }
  }
  return policy;
}

}  // namespace quoll
