#include "quoll/cli/verbs.hpp"

namespace quoll::cli {
namespace {

constexpr Verb entries[] = {
    {"learn", "learn by experience, with the exact answer beside it", declare_learn},
    {"solve", "the exact answer, with proof", declare_solve},
    {"evaluate", "what a policy is worth, state by state", declare_evaluate},
    {"race", "methods against the lecture's: steps and seconds until within 1 % of optimal",
     declare_race},
    {"distil", "fit a network to a learned or solved table, and judge what it still knows",
     declare_distil},
    {"play", "one episode, step by step, by a policy, given actions or by hand", declare_play},
    {"verify", "what a saved run can lose at most, checked independently", declare_verify},
    {"check", "what is wrong or suspicious in a world", declare_check},
    {"convert", "a world in another format", declare_convert},
    {"new", "a world file to begin with: a maze or a template", declare_new},
    {"list", "what there is to choose from", declare_list},
    {"export", "the policy of a saved run for C, JSON or CSV", declare_export},
    {"explain", "updates, traces and states with their numbers", declare_explain},
    {"show", "tables and pictures of a world, its values, a run", declare_show},
};

}  // namespace

std::span<const Verb> verbs() {
  return entries;
}

}  // namespace quoll::cli
