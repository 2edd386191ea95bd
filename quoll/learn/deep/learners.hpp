#pragma once
// The entries of the learners that know no table; learn/registry.cpp lists them.

#include "quoll/learn/learner.hpp"

namespace quoll {

extern const LearnerEntry linear_q;
extern const LearnerEntry nfq;
extern const LearnerEntry dqn;
extern const LearnerEntry pqn;
extern const LearnerEntry stream_q;
/// Not listed: it learns nothing by itself (distil.hpp).
extern const LearnerEntry distil;

}  // namespace quoll
