#pragma once
// The entries that the rules' files export; learn/registry.cpp lists them.

#include "quoll/learn/learner.hpp"

namespace quoll {

extern const LearnerEntry q_learning_standard;
extern const LearnerEntry q_learning_as_printed;
extern const LearnerEntry q_learning_reward_estimate;
extern const LearnerEntry reverse_replay;
extern const LearnerEntry dyna_q;
extern const LearnerEntry dyna_q_plus;
extern const LearnerEntry prioritised_sweeping;
extern const LearnerEntry empirical_model;
extern const LearnerEntry optimistic_model;
extern const LearnerEntry posterior_sampling;
extern const LearnerEntry sarsa;
extern const LearnerEntry expected_sarsa;
extern const LearnerEntry double_q;
extern const LearnerEntry n_step;
extern const LearnerEntry tree_backup;
extern const LearnerEntry q_lambda;
extern const LearnerEntry ucb_q;

}  // namespace quoll
