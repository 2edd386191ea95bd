#pragma once
// The solvers of the registry, and what all of them do at their edge.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/solve/ending.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {

std::unique_ptr<Solver> make_value_iteration();
std::unique_ptr<Solver> make_gauss_seidel();
std::unique_ptr<Solver> make_modified_policy_iteration();
std::unique_ptr<Solver> make_wavefront();
std::unique_ptr<Solver> make_topological();
std::unique_ptr<Solver> make_interval_iteration();
std::unique_ptr<Solver> make_optimistic_value_iteration();
std::unique_ptr<Solver> make_policy_iteration();
std::unique_ptr<Solver> make_label_setting();
std::unique_ptr<Solver> make_backward_induction();
std::unique_ptr<Solver> make_game_iteration();

/// The names of the first ten of these states, and how many more there are.
std::string some_names(const Mdp& mdp, const std::vector<State>& states);

/// The discount in use: the settings' or the model's own. Error if outside (0, 1].
Result<double> discount_in_use(const Mdp& mdp, const SolveSettings& settings);
/// The same for methods of one player: Error for models where two move in turn.
Result<double> discount_of_one(const Mdp& mdp, const SolveSettings& settings);

/// The same for methods that need a discount below 1: Error at discount 1, naming the method.
Result<double> discounted_only(const Mdp& mdp, const SolveSettings& settings,
                               std::string_view method);

/// The Error that names what makes total reward undefined at discount 1, if something does.
std::optional<Error> undiscounted_error(const Mdp& mdp);

/// The same model with all rewards negated: its optimum is the least cost.
Result<Mdp> negated_rewards(const Mdp& mdp);
/// Turns bounds on its values into bounds on the costs.
void turn_signs(std::vector<double>& lower, std::vector<double>& upper);
/// Solves for the least cost: the same solver on the model with negated rewards.
Result<Solution> solve_minimised(Solver& solver, const Mdp& mdp, SolveSettings settings);

/// Sets converged and exact from the bounds.
void conclude(const Mdp& mdp, Solution& solution, double width);

/// Largest upper - lower; equal infinite bounds count as 0. States that cannot follow from the
/// start and of which nothing is known, -infinity to infinity, do not count.
double largest_gap(const Mdp& mdp, const Solution& solution);

/// At discount 1: the states that cannot follow from the start and may gain for ever; no other
/// state's value depends on them. Empty = none.
std::vector<bool> unknown_states(const Mdp& mdp);
/// Gives them the bounds -infinity to infinity and concludes anew.
void leave_unknown(const Mdp& mdp, const std::vector<bool>& unknown, double width,
                   Solution& solution);

/// Tells keep_going how far the work is; false = stop.
bool may_continue(const SolveSettings& settings, const Solution& solution, double gap);

/// Solves a deterministic model by certified policy improvement from `policy` (at discount 1 one
/// that ends from every live state), then proves the upper bound. Fills bounds, policy, converged.
void improve_to_optimum(const Mdp& mdp, const SolveSettings& settings, double discount,
                        const std::vector<std::uint8_t>& live, Solution& solution);

/// How a stochastic model is solved at discount 1: by policy iteration on all states or on one
/// strongly connected component after the other, or by the methods of interval_iteration.cpp.
enum class TotalMethod : std::uint8_t { whole, by_components, intervals, optimistic };

/// Solves at discount 1, any model. Errors as Solver::solve.
Result<Solution> solve_undiscounted(const Mdp& mdp, const SolveSettings& settings,
                                    std::string_view method, TotalMethod how = TotalMethod::whole);
/// The same without asking first whether values are defined: states that cannot end with
/// probability 1 get -infinity, bounds that cannot be proved are infinite. Those in `unknown` must
/// not follow from others; they are left unknown.
Solution solve_ending(const Mdp& mdp, const SolveSettings& settings, std::string_view method,
                      const std::vector<bool>& unknown = {}, TotalMethod how = TotalMethod::whole);

/// Interval iteration and optimistic value iteration for a stochastic model at discount 1.
Solution iterate_intervals(const Mdp& mdp, const SolveSettings& settings, Ending ending);
Solution iterate_optimistically(const Mdp& mdp, const SolveSettings& settings, Ending ending);

/// Per state 1 if it is no end and some policy ends from it with probability 1. At discounts below
/// 1 every non-terminal state is live.
std::vector<std::uint8_t> live_states(const Mdp& mdp, double discount);

}  // namespace quoll
