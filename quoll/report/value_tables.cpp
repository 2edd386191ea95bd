#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "quoll/base/text.hpp"
#include "quoll/report/table.hpp"

namespace quoll {

namespace {

using Align = TextTable::Align;

std::uint64_t shown_states(const Mdp& mdp, std::uint64_t limit) {
  return limit == 0 ? mdp.states() : std::min(limit, mdp.states());
}

std::string rest_line(const Mdp& mdp, std::uint64_t shown, std::string_view advice) {
  if (shown == mdp.states()) return "";
  return fmt::format("... and {} more states ({})\n", grouped(mdp.states() - shown), advice);
}

/// q as a person sees it: a float in its own precision first, so that 51.2f is 51.2.
double rounded(double q, bool is_float) {
  return is_float ? static_cast<double>(static_cast<float>(q)) : q;
}

/// Which choices of a state the table stars, and the one it calls best.
struct Best {
  double largest = -HUGE_VAL;
  std::uint64_t choice = ~std::uint64_t{0};  ///< the policy's
};

Best best_of(const QTableView& view, State s) {
  const Mdp& mdp = *view.mdp;
  Best best;
  for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
    if (!view.visits.empty() && view.visits[c] == 0) continue;  // never tried: no estimate
    const double q = rounded(view.q[c], view.q_is_float);
    if (q > best.largest) best = {q, c};
  }
  if (!view.policy.empty()) {
    const bool chosen = view.policy[s] != no_action;
    best.choice = chosen ? mdp.choice_begin(s) + view.policy[s] : ~std::uint64_t{0};
  }
  return best;
}

std::vector<std::string> q_row(const QTableView& view, State s, std::uint64_t c, const Best& best) {
  const Mdp& mdp = *view.mdp;
  const double q = rounded(view.q[c], view.q_is_float);
  const bool visited = view.visits.empty() || view.visits[c] > 0;
  const bool starred = visited && q == best.largest;
  std::vector<std::string> row{c == mdp.choice_begin(s) ? mdp.state_name(s) : "",
                               starred ? "*" : "", mdp.action_name(c), number_text(q)};
  for (const ChoiceColumn& column : view.more) row.push_back(number_text(column.values[c]));
  if (!view.q_star.empty()) row.push_back(number_text(view.q_star[c]));
  if (!view.visits.empty()) row.push_back(grouped(view.visits[c]));
  std::string note = c == best.choice ? "<- best" : starred ? "<- equally good" : "";
  if (view.marked == c) note += (note.empty() ? "" : "  ") + view.mark;
  row.push_back(std::move(note));
  return row;
}

std::string optimal_others(const ValueTableView& view, State s, std::uint64_t chosen) {
  std::string others;
  if (view.optimal.empty()) return others;
  for (std::uint64_t c = view.mdp->choice_begin(s); c < view.mdp->choice_end(s); ++c) {
    if (c == chosen || !view.optimal[c]) continue;
    others += others.empty() ? "or " : ", ";
    others += view.mdp->action_name(c);
  }
  return others;
}

}  // namespace

std::string q_table(const QTableView& view) {
  const Mdp& mdp = *view.mdp;
  std::vector<TextTable::Column> columns{
      {"", Align::left}, {"", Align::left}, {"move", Align::left}, {view.q_title, Align::point}};
  for (const ChoiceColumn& column : view.more) columns.push_back({column.title, Align::point});
  if (!view.q_star.empty()) columns.push_back({"true Q*", Align::point});
  if (!view.visits.empty()) columns.push_back({"visits", Align::right});
  columns.push_back({"", Align::left});
  TextTable table(std::move(columns));
  const std::uint64_t shown = shown_states(mdp, view.states);
  for (State s = 0; s < shown; ++s) {
    if (mdp.actions(s) == 0) {
      table.row({mdp.state_name(s), "", "(end)"});
      continue;
    }
    const Best best = best_of(view, s);
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      table.row(q_row(view, s, c, best));
    }
  }
  return table.text() + rest_line(mdp, shown, view.rest);
}

std::string value_table(const ValueTableView& view) {
  const Mdp& mdp = *view.mdp;
  const std::uint64_t shown = shown_states(mdp, view.states);
  bool interval = false;
  for (State s = 0; s < shown; ++s) {
    interval = interval || number_text(view.lower[s]) != number_text(view.upper[s]);
  }
  std::vector<TextTable::Column> columns{{"state", Align::left}, {view.title, Align::point}};
  if (interval) {
    columns = {{"state", Align::left}, {view.title + " from", Align::point}, {"to", Align::point}};
  }
  columns.push_back({view.policy.empty() ? "" : "best move", Align::left});
  TextTable table(std::move(columns));
  for (State s = 0; s < shown; ++s) {
    std::vector<std::string> row{mdp.state_name(s), number_text(view.lower[s])};
    if (interval) row.push_back(number_text(view.upper[s]));
    std::uint64_t chosen = ~std::uint64_t{0};
    std::string moves;
    if (mdp.terminal(s)) {
      moves = "(end)";
    } else if (!view.policy.empty() && view.policy[s] != no_action) {
      chosen = mdp.choice_begin(s) + view.policy[s];
      moves = mdp.action_name(chosen);
    }
    const std::string others = mdp.terminal(s) ? "" : optimal_others(view, s, chosen);
    if (!others.empty()) moves += (moves.empty() ? "" : " ") + others;
    row.push_back(std::move(moves));
    table.row(std::move(row));
  }
  return table.text() + rest_line(mdp, shown, view.rest);
}

}  // namespace quoll
