// quoll check WORLD: what a careful reader would ask before trusting an answer.

#include "quoll/model/check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "quoll/base/json.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/explored.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll::cli {
namespace {

struct CheckOptions {
  WorldOption world;
  ExploreOption explore;
  std::string discount;
  bool json = false;
};

/// What is known after a check: sizes come from the arrays, valid or not.
struct Checked {
  std::uint64_t states = 0, choices = 0, outcomes = 0;
  double discount = 1.0;
  bool deterministic = false;
  std::vector<Finding> findings;

  bool ok() const {
    return std::none_of(findings.begin(), findings.end(), [](const Finding& finding) {
      return finding.severity == Finding::Severity::error;
    });
  }
};

/// The arrays of a world, of a file before they are validated.
Result<MdpArrays> open_arrays(const CheckOptions& options) {
  const std::string& name = options.world.name;
  const bool file = name.find('/') != std::string::npos || name.find('.') != std::string::npos;
  if (file && !find_world_entry(name) && !options.world.aimed()) {
    const Result<WorldSource> source = options.world.source();
    return source ? read_model_arrays(name, source->parameters) : source.error();
  }
  const Result<World> world = options.explore.open(options.world);
  if (!world) return world.error();
  return world->mdp->arrays();
}

Result<Checked> examine(MdpArrays arrays) {
  Checked checked;
  checked.states = arrays.choice_begin.empty() ? 0 : arrays.choice_begin.size() - 1;
  checked.choices = arrays.choice_begin.empty() ? 0 : arrays.choice_begin.back();
  checked.outcomes = arrays.next.size();
  checked.discount = arrays.discount;
  checked.findings = check_arrays(arrays);
  if (!checked.findings.empty()) return checked;
  const Result<Mdp> mdp = Mdp::make(std::move(arrays));
  if (!mdp) return mdp.error();
  checked.outcomes = mdp->outcomes();
  checked.deterministic = mdp->deterministic();
  checked.findings = check(*mdp);
  return checked;
}

std::string check_json(const std::string& world, const Checked& checked) {
  JsonWriter json(JsonStyle::pretty);
  json.begin_object();
  json.member("world", world).member("ok", checked.ok()).member("states", checked.states);
  json.member("choices", checked.choices).member("transitions", checked.outcomes);
  json.member("discount", checked.discount).member("deterministic", checked.deterministic);
  json.key("findings").begin_array();
  for (const Finding& finding : checked.findings) {
    json.begin_object();
    json.member("severity", finding.severity == Finding::Severity::error ? "error" : "warning");
    json.member("kind", finding.kind).member("sentence", finding.sentence);
    json.member("count", finding.count);
    json.key("names").begin_array();
    for (const std::string& name : finding.names) json.value(name);
    json.end_array();
    if (finding.line > 0)
      json.member("line", finding.line);
    else
      json.null_member("line");
    json.end_object();
  }
  json.end_array().end_object();
  return json.text() + "\n";
}

std::string check_text(const std::string& world, const Checked& checked) {
  std::string text;
  if (checked.ok()) {
    text = fmt::format("ok  {} states  {} choices  {} outcomes  discount {}{}\n",
                       grouped(checked.states), grouped(checked.choices), grouped(checked.outcomes),
                       shortest(checked.discount), checked.deterministic ? "  deterministic" : "");
  }
  for (const Finding& finding : checked.findings) {
    text += world;
    if (finding.line > 0) text += fmt::format(":{}", finding.line);
    const bool error = finding.severity == Finding::Severity::error;
    text +=
        fmt::format(": {}: {} [{}]\n", error ? "error" : "warning", finding.sentence, finding.kind);
  }
  return text;
}

Exit check_world(const CheckOptions& options) {
  Result<MdpArrays> arrays = open_arrays(options);
  if (!arrays) return fail(arrays.error());
  if (!options.discount.empty()) {
    const Result<double> discount = parse_discount(options.discount);
    if (!discount) return fail(discount.error());
    arrays->discount = *discount;
  }
  const Result<Checked> checked = examine(std::move(*arrays));
  if (!checked) return fail(checked.error());
  const std::string& name = options.world.name;
  if (!print(options.json ? check_json(name, *checked) : check_text(name, *checked))) {
    return user_error;
  }
  return checked->ok() ? done : refused;
}

}  // namespace

void declare_check(Options& options) {
  auto given = std::make_shared<CheckOptions>();
  given->world.declare(options);
  given->explore.declare(options);
  options.option("--discount,--gamma", &given->discount, "number in (0, 1]",
                 "discount factor to check with; without it the world's own");
  options.flag("--json", &given->json, "print one JSON object on stdout");
  options.run([given] { return check_world(*given); });
}

}  // namespace quoll::cli
