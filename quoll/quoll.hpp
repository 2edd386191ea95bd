#pragma once
// Everything a program needs to build worlds, learn in them, ask policies and solve exactly. The
// calls declared in experiment/learn.hpp raise quoll::Exception; all others return Result.

#include "quoll/act/policy.hpp"
#include "quoll/base/raise.hpp"
#include "quoll/env/dynamics.hpp"
#include "quoll/env/world.hpp"
#include "quoll/experiment/learn.hpp"
#include "quoll/experiment/run.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/model/builder.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/solve/solver.hpp"
