#include "quoll/cli/verbs.hpp"

namespace quoll::cli {
namespace {

constexpr Verb entries[] = {
    {"learn", "learn by experience, with the exact answer beside it", declare_learn},
};

}  // namespace

std::span<const Verb> verbs() { return entries; }

}  // namespace quoll::cli
