#include "quoll/cli/solve_exact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/exact.hpp"
#include "quoll/report/table.hpp"

namespace quoll::cli {
namespace {

constexpr std::size_t long_fraction = 40;  // letters, above which only their number is told

std::string digits_text(const std::string& number) {
  return fmt::format("({} digits)", number.size() - (number.front() == '-' ? 1 : 0));
}

/// "128/3", "80", or how long it is.
std::string fraction_text(const Fraction& fraction) {
  if (fraction.numerator.empty()) return std::isnan(fraction.rounded) ? "not known" : "none";
  const std::string& above = fraction.numerator;
  const std::string& below = fraction.denominator;
  if (below == "1") return above.size() <= long_fraction ? above : digits_text(above);
  if (above.size() + 1 + below.size() <= long_fraction) return above + "/" + below;
  return digits_text(above) + "/" + digits_text(below);
}

void write_fraction(JsonWriter& json, const Fraction& fraction) {
  if (fraction.numerator.empty()) {
    json.null_member("numerator").null_member("denominator");
  } else {
    json.member("numerator", fraction.numerator).member("denominator", fraction.denominator);
  }
}

}  // namespace

Result<std::optional<RationalSolution>> prove_exactly(const Mdp& mdp, const Solution& solution,
                                                      bool maximise, bool quiet) {
  RationalSettings settings;
  settings.maximise = maximise;
  ProgressDisplay display(quiet, "states");
  const auto begun = std::chrono::steady_clock::now();
  settings.keep_going = [&](std::uint64_t states) {
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begun;
    display.show(states, mdp.states(), time.count(), "in fractions");
    return !interrupted();
  };
  Result<RationalSolution> exact = solve_in_rationals(mdp, solution, settings);
  if (!exact) {
    if (interrupted()) return std::optional<RationalSolution>();
    return exact.error();
  }
  if (exact->outside) {
    const State s = *exact->outside;
    return Error{"--exact", 0, 0,
                 fmt::format("the value of state {} is {} and lies outside the bounds [{}, {}] "
                             "that were to be certain: please report this",
                             mdp.state_name(s), fraction_text(exact->value[s]),
                             shortest(solution.lower[s]), shortest(solution.upper[s])),
                 ""};
  }
  return std::optional(std::move(*exact));
}

std::string exact_table(const Mdp& mdp, const RationalSolution& exact, std::uint64_t states) {
  using Align = TextTable::Align;
  TextTable table({{"state", Align::left},
                   {"V*", Align::point},
                   {"exactly", Align::right},
                   {"best move", Align::left}});
  const std::uint64_t shown = std::min(states, mdp.states());
  for (State s = 0; s < shown; ++s) {
    const bool end = exact.policy[s] == no_action;
    table.row({mdp.state_name(s), number_text(exact.value[s].rounded),
               fraction_text(exact.value[s]),
               end ? "(end)" : mdp.action_name(mdp.choice_begin(s) + exact.policy[s])});
  }
  std::string text = table.text();
  if (shown < mdp.states()) {
    text += fmt::format("... and {} more states (use --json --all or -o FILE)\n",
                        grouped(mdp.states() - shown));
  }
  return text;
}

std::string exact_verdict(const Mdp& mdp, const RationalSolution& exact) {
  std::string text = "exact start value " + fraction_text(exact.start);
  text += fmt::format(": in fractions, none of the {} is better than this policy's",
                      counted(mdp.choices(), "choice"));
  if (exact.switched > 0) {
    text += fmt::format(" (which was changed in {})", counted(exact.switched, "state"));
  }
  return text + "\n";
}

void write_exact(JsonWriter& json, const Mdp& mdp, const RationalSolution& exact, bool all) {
  json.key("exact").begin_object();
  json.key("start").begin_object();
  write_fraction(json, exact.start);
  json.end_object();
  json.member("switched", exact.switched);
  json.rows("values", mdp.states(), all, [&](std::uint64_t i) {
    const auto s = static_cast<State>(i);
    json.begin_object().member("state", mdp.state_name(s));
    write_fraction(json, exact.value[s]);
    write_action(json, "action", mdp, s, exact.policy[s]);
    json.end_object();
  });
  json.end_object();
}

}  // namespace quoll::cli
