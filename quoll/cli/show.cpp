// quoll show WORLD [graph|map|q|policy|curve]: in the terminal, or as a picture with -o FILE.svg.

#include "quoll/cli/show.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "quoll/base/text.hpp"
#include "quoll/cli/explored.hpp"
#include "quoll/cli/judged_run.hpp"
#include "quoll/cli/policy_file.hpp"
#include "quoll/cli/same_world.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/report/curve_svg.hpp"
#include "quoll/report/graph_svg.hpp"
#include "quoll/report/grid_svg.hpp"

namespace quoll::cli {
namespace {

constexpr std::string_view kinds[] = {"graph", "map", "q", "policy", "curve"};

struct ShowOptions {
  WorldOption world;
  ExploreOption explore;
  std::string kind, run, file, discount;
  bool all = false;
};

Result<double> discount_of(const std::string& text, double otherwise) {
  if (text.empty()) return otherwise;
  return parse_discount(text);
}

// What is drawn when nobody says.
std::string kind_for(const Mdp& mdp) {
  if (mdp.layout()) return "map";
  return mdp.states() <= graph_states ? "graph" : "q";
}

GridView grid_view(const Exhibit& exhibit, bool heat) {
  GridView view;
  view.mdp = exhibit.mdp;
  if (heat) view.value = exhibit.value;
  view.policy = exhibit.policy;
  view.optimal = exhibit.best;
  view.title = exhibit.title;
  return view;
}

std::string q_text(const Exhibit& exhibit, bool all) {
  QTableView view;
  view.mdp = exhibit.mdp;
  view.q = exhibit.q;
  view.q_is_float = exhibit.q_is_float;
  view.q_star = exhibit.q_star;
  view.visits = exhibit.visits;
  view.policy = exhibit.policy;
  view.q_title = exhibit.learned ? "Q" : "Q*";
  view.states = all ? 0 : 20;
  view.rest = "use --all";
  return q_table(view);
}

// Every move, one line per state: "HALL  To-CAVE -> CAVE, To-POOL -> POOL".
std::string moves_text(const Mdp& mdp) {
  TextTable table({{"state"}, {"moves"}});
  for (State s = 0; s < mdp.states(); ++s) {
    std::string moves = mdp.terminal(s) ? "(end)" : "";
    for (std::uint64_t c = mdp.choice_begin(s); !mdp.terminal(s) && c < mdp.choice_end(s); ++c) {
      moves += (moves.empty() ? "" : ", ") + mdp.action_name(c) + " ->";
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        moves += " " + mdp.state_name(mdp.next(o));
        if (mdp.probability(o) < 1.0)
          moves += fmt::format(" ({})", number_text(mdp.probability(o)));
        if (mdp.reward(c, o) != 0.0) {
          moves += fmt::format(" [reward {}]", number_text(mdp.reward(c, o)));
        }
      }
    }
    table.row({mdp.state_name(s), std::move(moves)});
  }
  return table.text();
}

// The state's value and its best moves.
std::string policy_table(const Exhibit& exhibit, bool all) {
  ValueTableView view;
  view.mdp = exhibit.mdp;
  view.lower = exhibit.value;
  view.upper = exhibit.value;
  view.title = exhibit.learned ? "max Q" : "V*";
  view.policy = exhibit.policy;
  view.optimal = exhibit.best;
  view.states = all ? 0 : 20;
  view.rest = "use --all";
  return value_table(view);
}

Result<std::string> terminal_text(const Exhibit& exhibit, const std::string& kind,
                                  const std::string& world, bool all) {
  const TerminalStyle style = stdout_style();
  std::string text = exhibit.title + "\n\n";
  if (kind == "curve") {
    for (const Curve& curve : exhibit.curves) text += curve_text(curve, style);
    return text;
  }
  if (kind == "map" || (kind == "policy" && exhibit.mdp->layout())) {
    GridView view = grid_view(exhibit, true);
    const Result<std::string> arrows = grid_policy_text(view, style);
    if (!arrows || kind == "policy") return arrows;
    if (exhibit.value.empty()) return arrows;
    view.title = "values";
    const Result<std::string> heat = grid_heat_text(view, style);
    if (!heat) return heat;
    return *arrows + "\n" + *heat;
  }
  if (kind == "policy") return text + policy_table(exhibit, all);
  if (kind == "q") return text + q_text(exhibit, all);
  if (exhibit.mdp->states() > graph_states) {
    GraphView view;
    view.mdp = exhibit.mdp;
    view.world = world;
    return graph_svg(view).error();
  }
  if (!exhibit.q.empty()) text += q_text(exhibit, true) + "\n";
  return text + moves_text(*exhibit.mdp) +
         fmt::format("\nThe picture: quoll show {} -o {}.svg\n", world, exhibit.name);
}

Result<Picture> picture(const Exhibit& exhibit, const std::string& kind, const std::string& world) {
  if (kind == "curve") return curve_svg({exhibit.curves, exhibit.title});
  if (kind == "q") {
    return Error{"-o", 0, 0,
                 "a Q table is a text; for a picture: quoll show " + world +
                     (exhibit.mdp->layout() ? " map" : " graph") + " -o FILE.svg",
                 ""};
  }
  if (kind == "map" || (kind == "policy" && exhibit.mdp->layout())) {
    return grid_svg(grid_view(exhibit, kind == "map"));
  }
  GraphView view;
  view.mdp = exhibit.mdp;
  view.value = exhibit.value;
  view.q = exhibit.q;
  view.optimal = exhibit.best;
  view.title = exhibit.title;
  view.world = world;
  return graph_svg(view);
}

Result<std::string> checked_kind(const ShowOptions& options, const World& world) {
  if (options.kind.empty()) {
    if (world.mdp) return kind_for(*world.mdp);
    if (!options.run.empty()) return std::string(world.traits.states > 0 ? "q" : "curve");
    return Error{"show", 0, 0, "the model of " + world.name + " is not known", ""};
  }
  if (std::find(std::begin(kinds), std::end(kinds), options.kind) == std::end(kinds)) {
    return Error{"show", 0, 0,
                 "graph, map, q, policy or curve expected, not '" + options.kind + "'",
                 nearest(options.kind, std::span<const std::string_view>(kinds))};
  }
  if (options.kind == "curve" && options.run.empty()) {
    return Error{"show", 0, 0,
                 "a curve needs a run: quoll learn " + options.world.name +
                     " --save FILE, then quoll show " + options.world.name + " curve --run FILE",
                 ""};
  }
  if (!world.mdp && !options.run.empty() && options.kind != "curve") {
    if (options.kind == "graph" || options.kind == "map" || !options.file.empty()) {
      return Error{"show", 0, 0,
                   "the model of " + world.name +
                       " is not known: its runs show q and policy as text, and a curve",
                   ""};
    }
  }
  return options.kind;
}

Result<void> checked_file(const std::string& file) {
  if (file.empty() || (file.size() > 4 && file.substr(file.size() - 4) == ".svg")) return {};
  return Error{"-o", 0, 0, "a file that ends in .svg expected, not '" + file + "'", ""};
}

Exit present(const Exhibit& exhibit, const ShowOptions& options, const std::string& kind) {
  if (options.file.empty()) {
    const Result<std::string> text = terminal_text(exhibit, kind, options.world.name, options.all);
    if (!text) return fail(text.error());
    return print(*text) ? done : user_error;
  }
  const Result<Picture> drawn = picture(exhibit, kind, options.world.name);
  if (!drawn) return fail(drawn.error());
  const Result<void> written =
      write_output(options.file, drawn->svg, {options.world.name, options.run});
  return written ? done : fail(written.error());
}

Exit show(const ShowOptions& options) {
  const Result<void> file = checked_file(options.file);
  if (!file) return fail(file.error());
  const bool exact = options.run.empty() && options.kind != "curve";
  const Result<World> world = exact ? options.explore.open(options.world) : options.world.open();
  if (!world) return fail(world.error());
  const Result<std::string> kind = checked_kind(options, *world);
  if (!kind) return fail(kind.error());
  if (!options.run.empty()) {
    const Result<Run> run = Run::load(run_file(options.run));
    if (!run) return fail(run.error());
    const Result<void> same = check_same_world(*run, options.run, *world);
    if (!same) return fail(same.error());
    const std::string missing = no_table(*run);
    if (!missing.empty() && *kind != "curve") return fail({"show", 0, 0, missing, ""});
    const Exhibit exhibit = learned_exhibit(*run);
    if (exhibit.mdp == nullptr && *kind != "curve") {
      return fail({"show", 0, 0, "the states of " + world->name + " cannot be listed", ""});
    }
    return present(exhibit, options, *kind);
  }
  const Result<double> discount = discount_of(options.discount, world->discount);
  if (!discount) return fail(discount.error());
  const Result<Exhibit> exhibit = exact_exhibit(*world, *discount);
  if (exhibit) return present(*exhibit, options, *kind);
  if (*kind != "graph" && *kind != "map") return fail(exhibit.error());
  return present(bare_exhibit(*world, message(exhibit.error())), options, *kind);
}

}  // namespace

void declare_show(Options& options) {
  auto given = std::make_shared<ShowOptions>();
  given->world.declare(options);
  given->explore.declare(options);
  options.word("kind", given->kind,
               "graph, map, q, policy or curve; without it a map for grids, a graph for up to 60 "
               "states, else q",
               false);
  options.option("--run", &given->run, "FILE",
                 "the values of a saved run instead of the exact ones");
  options.option("--discount,--gamma", &given->discount, "number in (0, 1]",
                 "discount of the exact values; without it the world's own");
  options.option("-o,--output", &given->file, "FILE.svg", "write a picture instead");
  options.flag("--all", &given->all, "complete tables, however long");
  options.run([given] { return show(*given); });
}

}  // namespace quoll::cli
