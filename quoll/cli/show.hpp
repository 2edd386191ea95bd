#pragma once
// What `show` shows: a world with values on it, exact or learned.

#include <cstdint>
#include <string>
#include <vector>

#include "quoll/cli/common.hpp"
#include "quoll/report/curve.hpp"

namespace quoll::cli {

/// Everything a table or picture needs; the spans of the views lead into it.
struct Exhibit {
  std::string name;  ///< of the world, as a file name takes it
  std::string title;
  const Mdp* mdp = nullptr;
  std::shared_ptr<const Mdp> states{};  ///< what mdp points to where no model is known
  std::vector<double> value;            ///< per state; nan = not known
  std::vector<double> q;                ///< per choice
  std::vector<double> q_star;           ///< per choice, beside learned values; may be empty
  std::vector<std::uint32_t> visits;    ///< per choice; learned values only
  std::vector<std::uint8_t> best;       ///< per choice: optimal, or greedy among the visited
  std::vector<Action> policy;           ///< per state
  bool learned = false;
  bool q_is_float = false;
  std::vector<Curve> curves;  ///< one per seed of a run
};

/// The exact solution of a model.
Result<Exhibit> exact_exhibit(const World& world, double discount);

/// A world without values, and why there are none.
Exhibit bare_exhibit(const World& world, const std::string& why);

/// The values of a run's first seed, and its curves.
Exhibit learned_exhibit(const Run& run);

}  // namespace quoll::cli
