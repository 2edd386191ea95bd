// quoll solve WORLD: the exact answer, with proof.

#include "quoll/solve/solver.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/certificate.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/exact.hpp"
#include "quoll/cli/explored.hpp"
#include "quoll/cli/infinite.hpp"
#include "quoll/cli/learn_report.hpp"
#include "quoll/cli/solve_exact.hpp"
#include "quoll/cli/solve_task.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/model/goal.hpp"
#include "quoll/report/export_map.hpp"
#include "quoll/report/progress.hpp"
#include "quoll/solve/defined_part.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/rounding.hpp"

namespace quoll::cli {
namespace {

/// What can be asked of a solve.
struct ExactSettings {
  double discount = 0.0;
  double tolerance = 1e-6;
  std::string method = "auto";
  bool minimise = false;
  std::uint64_t horizon = 0;
  bool average = false;

  void describe(Describer& d) {
    d("discount", discount, 0, 1, "discount factor of the future; 0 = the world's own");
    d("tolerance", tolerance, 0, 1e300,
      "largest upper - lower over all states; if not given, also 1e-12 of the largest value will "
      "do");
    d("method", method, "auto, or a name from 'quoll list solvers'");
    d("minimise", minimise, "rewards are costs: find the least");
    d("horizon", horizon, 0, 1e9,
      "the best in so many steps, by a policy that looks at the steps left; 0 = no such limit");
    d("average", average, "the best average reward per step over endless time (gain and bias)");
  }
};

struct SolveOptions {
  WorldOption world;
  ExploreOption explore;
  OutputOption output;
  GivenSettings given;
  unsigned threads = 0;
  bool exact = false;
  std::string certificate;
};

/// An answer with what is needed to report it.
struct Solved {
  const World& world;
  ExactSettings asked;
  Solution solution;
  std::vector<double> shown_lower, shown_upper;  ///< empty = as the solution has them
  std::shared_ptr<const DefinedPart> outside;    ///< of a reward until a goal: where it is infinite
  double seconds = 0.0, seconds_load = 0.0;
  std::optional<RationalSolution> exact{};

  /// The model that was solved.
  const Mdp& mdp() const { return outside->part ? *outside->part : *world.mdp; }
  /// What the states are worth to people: who stands in a goal has reached it with probability 1.
  std::span<const double> lower() const {
    return shown_lower.empty() ? solution.lower : shown_lower;
  }
  std::span<const double> upper() const {
    return shown_upper.empty() ? solution.upper : shown_upper;
  }
  Interval start() const { return start_value(mdp(), lower(), upper()); }
};

std::string solve_json(const Solved& solved, bool all) {
  const Mdp& mdp = solved.mdp();
  const Solution& solution = solved.solution;
  const OptimalActions optimal(mdp, solution, !solved.asked.minimise);
  JsonWriter json(JsonStyle::pretty);
  json.begin_object();
  const Mdp& whole = *solved.world.mdp;
  json.member("world", solved.world.name).member("states", whole.states());
  json.member("choices", whole.choices()).member("transitions", whole.outcomes());
  json.member("discount", solution.discount);
  json.member("objective", solved.asked.minimise ? "minimise" : "maximise");
  json.member("method", solution.method).member("sweeps", solution.sweeps);
  json.member("seconds", solved.seconds).member("seconds_load", solved.seconds_load);
  write_interval(json, "start", solved.start());
  json.member("gap", largest_gap(mdp, solution)).member("converged", solution.converged);
  json.rows("values", mdp.states(), all, [&](std::uint64_t i) {
    const auto s = static_cast<State>(i);
    json.begin_object().member("state", mdp.state_name(s));
    json.member("lower", solved.lower()[s]).member("upper", solved.upper()[s]);
    write_action(json, "action", mdp, s, solution.policy[s]);
    json.key("optimal").begin_array();
    for (const Action a : optimal.of(s)) json.value(mdp.action_name(mdp.choice_begin(s) + a));
    json.end_array().end_object();
  });
  if (solved.exact) write_exact(json, mdp, *solved.exact, all);
  if (solved.outside->part) {
    const std::vector<State> states = infinite_states(*solved.outside);
    json.rows("infinite", states.size(), all,
              [&](std::uint64_t i) { json.value(mdp.state_name(states[i])); });
  }
  json.end_object();
  return json.text() + "\n";
}

std::string_view objective_text(const Solved& solved) {
  if (!solved.shown_lower.empty()) {
    return solved.asked.minimise ? "least probability" : "largest probability";
  }
  return solved.asked.minimise ? "least cost" : "largest reward";
}

std::string heading(const Solved& solved) {
  const Mdp& mdp = *solved.world.mdp;
  return fmt::format(
      "solve {}   {} states, {} choices, {}, discount {}, {}, method {}\n\n", solved.world.name,
      grouped(mdp.states()), grouped(mdp.choices()),
      mdp.deterministic() ? "deterministic" : grouped(mdp.outcomes()) + " transitions",
      shortest(solved.solution.discount), objective_text(solved), solved.solution.method);
}

/// Q* of every choice beside each other, for worlds that fit on a page; nothing if one of them is
/// not known at all.
std::string q_text(const Solved& solved) {
  std::vector<double> q = q_star_all(solved.mdp(), solved.solution, solved.solution.discount);
  // The middle of an interval around 0 is noise; 0 is as true and says more.
  const double gap = largest_gap(solved.mdp(), solved.solution);
  for (double& x : q) {
    if (std::fabs(x) <= 0.5 * gap) x = 0.0;
  }
  const bool known = std::none_of(q.begin(), q.end(), [](double x) { return std::isnan(x); });
  if (!known) return "";
  QTableView view;
  view.mdp = &solved.mdp();
  view.q = q;
  view.q_is_float = false;
  view.q_title = "Q*";
  view.policy = solved.solution.policy;
  view.states = 0;
  return q_table(view);
}

std::string tables(const Solved& solved, const TerminalStyle& style, bool all) {
  const Mdp& mdp = solved.mdp();
  const Solution& solution = solved.solution;
  if (const auto grid = grid_page(mdp, solution.lower, solution.policy, style, all)) return *grid;
  const std::uint64_t shown = all ? mdp.states() : few_states;
  if (solved.exact) return exact_table(mdp, *solved.exact, shown) + "\n";
  const OptimalActions optimal(mdp, solution, !solved.asked.minimise);
  const std::vector<std::uint8_t> flags = optimal.flags(shown);
  ValueTableView view;
  view.mdp = &mdp;
  view.lower = solved.lower();
  view.upper = solved.upper();
  view.policy = solution.policy;
  view.optimal = flags;
  view.states = all ? 0 : few_states;
  std::string text = value_table(view) + "\n";
  // The table of Q stars the largest number of a state: for costs that would be the worst.
  if (mdp.states() > few_states || solved.asked.minimise) return text;
  const std::string q = q_text(solved);
  return q.empty() ? text : text + q + "\n";
}

std::string verdict(const Solved& solved) {
  const Solution& solution = solved.solution;
  const Interval start = solved.start();
  std::string text;
  if (start.lower == -infinity && start.upper == infinity) {
    text = "no certified value: the total reward could not be bounded";
    if (solution.discount == 1.0) text += "; a discount below 1 makes the values finite";
    text += "\n";
  } else {
    text = "start value " + interval_text(start);
    text += solution.converged ? ", certified: no state of this policy loses more than "
                               : ", not as close as asked: the policy may lose up to ";
    text += number_text(largest_gap(solved.mdp(), solution));
    if (!solution.converged) {
      text += fmt::format(" (--tolerance {})", number_text(solved.asked.tolerance));
    }
    text += "\n";
  }
  text += infinite_text(solved.mdp(), *solved.outside, solved.asked.minimise);
  text += fmt::format("{} sweep{} in {} (loaded in {})\n", grouped(solution.sweeps),
                      solution.sweeps == 1 ? "" : "s", time_text(solved.seconds),
                      time_text(solved.seconds_load));
  return text;
}

bool tolerance_given(const SolveOptions& options, const ExactSettings& asked) {
  return asked_for(options.given, "tolerance") || asked.tolerance != ExactSettings().tolerance;
}

Result<Solution> run_solver(const SolveOptions& options, const ExactSettings& asked,
                            const Mdp& mdp) {
  SolveSettings settings;
  settings.width = asked.tolerance;
  if (asked.discount > 0.0) settings.discount = asked.discount;
  settings.maximise = !asked.minimise;
  settings.threads = options.threads;
  ProgressDisplay display(options.output.quiet, "sweeps");
  const Stopwatch watch;
  settings.keep_going = [&](const SolveProgress& now) {
    display.show(now.sweeps, 0, watch.seconds(), "gap " + number_text(now.gap));
    return !interrupted();
  };
  Result<Solution> solution = quoll::solve(mdp, settings, asked.method);
  if (!solution) return solution;
  const double width = wanted_width(asked.tolerance, tolerance_given(options, asked), 1e-12,
                                    solution->lower, solution->upper);
  solution->converged = largest_gap(mdp, *solution) <= width;
  return solution;
}

/// The cost to go as an image: FILE.yaml and FILE.pgm. An image that stands alone there is
/// somebody's map.
Result<void> write_cost_image(const MapExport& map, const std::string& file,
                              const std::string& world) {
  const std::string stem = file.substr(0, file.size() - std::string_view("yaml").size());
  const std::string image = stem + "pgm";
  const Result<CostImage> written = cost_image(map, image.substr(image.find_last_of('/') + 1));
  if (!written) return written.error();
  if (access(image.c_str(), F_OK) == 0 && access(file.c_str(), F_OK) != 0) {
    return Error{image, 0, 0, "exists already without a " + file + ": give another name", ""};
  }
  const Result<void> first = write_output(file, written->yaml, {world});
  return first ? write_output(image, written->pgm, {world}) : first;
}

/// What -o asks for, by its ending: .csv moves of a map, .yaml an image of one, else JSON.
Result<void> write_answer(const Solved& solved, const std::string& file, const std::string& world) {
  const bool rows = file.ends_with(".csv");
  if (!rows && !file.ends_with(".yaml")) {
    return write_output(file, solve_json(solved, true), {world});
  }
  const Solution& solution = solved.solution;
  std::vector<double> cost = solved.asked.minimise ? solution.upper : solution.lower;
  if (!solved.asked.minimise) {
    for (double& c : cost) c = -c;
  }
  const MapExport map{&solved.mdp(), solution.policy, cost};
  if (!rows) return write_cost_image(map, file, world);
  const Result<std::string> text = moves_csv(map);
  return text ? write_output(file, *text, {world}) : text.error();
}

/// Whether -o can be written in the form its name asks for; told before the work.
Result<void> check_form(const SolveOptions& options, const World& world) {
  const std::string& file = options.output.file;
  const bool plain = file.find('.', file.find_last_of('/') + 1) == std::string::npos;
  if (plain || file.ends_with(".json")) return {};  // such as /dev/stdout
  if (!file.ends_with(".csv") && !file.ends_with(".yaml")) {
    return Error{"-o", 0, 0,
                 "a name that ends in .json, .csv or .yaml expected, not '" + file + "'", ""};
  }
  if (world.mdp->layout()) return {};
  return Error{"-o", 0, 0,
               "a name that ends in .json expected, not '" + file + "': the states of " +
                   world.name + " are no cells of a grid",
               ""};
}

void show_goal(const SolveOptions& options, Solved& solved) {
  if (options.world.goal.empty() || !options.world.rewards.empty()) return;
  const Result<std::vector<State>> goal = states_of(*solved.world.mdp, options.world.goal);
  if (!goal) return;  // cannot happen: the world was made with it
  solved.shown_lower = solved.solution.lower;
  solved.shown_upper = solved.solution.upper;
  for (const State s : *goal) solved.shown_lower[s] = solved.shown_upper[s] = 1.0;
}

/// Solves the part of the world in which what was asked is defined.
Result<Solved> answer(const SolveOptions& options, const ExactSettings& asked, const World& world,
                      double seconds_load) {
  const Stopwatch work;
  DefinedPart outside;
  const double discount = asked.discount > 0.0 ? asked.discount : world.mdp->discount();
  if (!options.world.goal.empty() && !options.world.rewards.empty() && discount == 1.0) {
    Result<DefinedPart> defined = defined_part(*world.mdp, !asked.minimise);
    if (!defined) return defined.error();
    outside = *std::move(defined);
    if (const auto error = infinite_start(*world.mdp, outside, asked.minimise)) return *error;
  }
  Result<Solution> solution = run_solver(options, asked, outside.part ? *outside.part : *world.mdp);
  if (!solution) return solution.error();
  outside.fill(!asked.minimise, *solution);
  const auto part = std::make_shared<const DefinedPart>(std::move(outside));
  return Solved{world, asked, *std::move(solution), {}, {}, part, work.seconds(), seconds_load};
}

Exit solve(const SolveOptions& options) {
  ExactSettings asked;
  const Result<void> applied = options.given.apply(settings_of(asked));
  if (!applied) return fail(applied.error());
  const Stopwatch load;
  const Result<WorldSource> source = options.world.source(asked.minimise);
  if (!source) return fail(source.error());
  const Result<World> world = options.explore.with_model(
      options.world.open(options.given, asked.minimise), *source, options.output.quiet);
  if (!world) return fail(world.error());
  const double seconds_load = load.seconds();
  if (const Result<void> fits = check_form(options, *world); !fits) return fail(fits.error());
  catch_interrupts();
  if (asked.horizon > 0 || asked.average) {
    const std::string_view proof = options.exact                  ? "--exact"
                                   : !options.certificate.empty() ? "--certificate"
                                                                  : "";
    return solve_task({*world, *world->mdp, options.output, options.world.name, asked.discount,
                       asked.tolerance, tolerance_given(options, asked), asked.method,
                       asked.minimise, proof, options.threads, seconds_load},
                      asked.horizon, asked.average);
  }
  Result<Solved> result = answer(options, asked, *world, seconds_load);
  release_interrupts();
  if (!result) return fail(result.error());
  Solved& solved = *result;
  // Before another policy, whose value these bounds do not prove, takes its place.
  if (!options.certificate.empty()) {
    const Result<void> written = write_certificate(options.certificate, *world, solved.solution,
                                                   !asked.minimise, options.world.name);
    if (!written) return fail(written.error());
  }
  if (options.exact) {
    catch_interrupts();
    auto exact =
        prove_exactly(solved.mdp(), solved.solution, !asked.minimise, options.output.quiet);
    release_interrupts();
    if (!exact) return fail(exact.error());
    solved.exact = std::move(*exact);
    if (solved.exact) solved.solution.policy = solved.exact->policy;
  }
  show_goal(options, solved);
  if (!options.output.file.empty()) {
    const Result<void> written = write_answer(solved, options.output.file, options.world.name);
    if (!written) return fail(written.error());
  }
  std::string text;
  if (options.output.json) {
    text = solve_json(solved, options.output.all);
  } else {
    text = heading(solved) + tables(solved, stdout_style(), options.output.all) + verdict(solved);
    if (solved.exact) text += exact_verdict(solved.mdp(), *solved.exact);
  }
  if (!print(text)) return user_error;
  const bool proved = !options.exact || solved.exact;
  return proved && solved.solution.converged ? done : goal_missed;
}

}  // namespace

void declare_solve(Options& options) {
  auto given = std::make_shared<SolveOptions>();
  ExactSettings defaults;
  given->world.declare(options);
  given->explore.declare(options);
  given->given.declare_flags(options, settings_of(defaults));
  options.option("--threads", &given->threads, "N",
                 "processors to use; 0 = all; changes no result");
  options.flag("--exact", &given->exact,
               "value the policy in fractions and prove it optimal without rounding");
  options.option("--certificate", &given->certificate, "FILE",
                 "write bounds and policy for 'quoll verify WORLD FILE'");
  given->output.declare(
      options,
      "also write the JSON object, complete; of a grid as NAME.csv x, y, move and cost, as "
      "NAME.yaml an image of the cost for ROS");
  options.run([given] { return solve(*given); });
}

}  // namespace quoll::cli
