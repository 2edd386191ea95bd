#pragma once
// The verbs, one file each.

#include "quoll/cli/verb.hpp"

namespace quoll::cli {

void declare_check(Options& options);
void declare_convert(Options& options);
void declare_evaluate(Options& options);
void declare_play(Options& options);
void declare_explain(Options& options);
void declare_export(Options& options);
void declare_learn(Options& options);
void declare_list(Options& options);
void declare_new(Options& options);
void declare_race(Options& options);
void declare_distil(Options& options);
void declare_show(Options& options);
void declare_solve(Options& options);
void declare_verify(Options& options);

}  // namespace quoll::cli
