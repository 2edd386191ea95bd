#pragma once
// What a distilled network still knows, judged seed by seed, for people and programs.

#include <optional>
#include <string>
#include <vector>

#include "quoll/experiment/run.hpp"
#include "quoll/learn/deep/learned_network.hpp"

namespace quoll::cli {

/// What a network was taught, and where that comes from.
struct Lesson {
  World world;
  WorldSource source;
  double discount = 1.0;
  Estimates table;
  std::string origin;  ///< one phrase
};

/// Of the states that the table knows: how many, and where the network's action is right.
struct Right {
  std::uint64_t states = 0, right = 0;
};

struct DistilledSeed {
  Right taught, withheld;
  double largest_error = 0.0, mean_error = 0.0;  ///< of Q, over all visited pairs of the table
  std::string worst_pair;                        ///< where it is largest: state, action
};

/// A run of "distil" beside its lesson. Right is: optimal where the model is known and solved, else
/// as good as the best of the table.
struct Distilled {
  const Run& run;
  const Lesson& lesson;
  RunResult result;
  std::shared_ptr<const LearnedNetwork> network;  ///< of the first seed
  std::vector<DistilledSeed> seeds;
};
Result<Distilled> judge_distilled(const Run& run, const Lesson& lesson);

std::string distilled_text(const Distilled& of);
std::string distilled_json(const Distilled& of);

}  // namespace quoll::cli
