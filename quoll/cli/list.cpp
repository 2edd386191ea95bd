// quoll list TOPIC: what there is to choose from.

#include <fmt/format.h>

#include <array>

#include "quoll/act/exploration.hpp"
#include "quoll/act/start.hpp"
#include "quoll/base/json.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll::cli {
namespace {

/// One line of a list; `second` is what its second column says, empty = it has none.
struct Line {
  std::string name, second, summary;
};

struct Topic {
  std::string_view name;
  std::string_view second_key;  ///< key and title of the second column, or empty
  std::vector<Line> (*lines)();
};

/// What `list worlds` says of one world, with its standard parameters.
struct WorldLine {
  const WorldEntry* entry;
  std::string offers;  ///< "16 states" or "4 numbers", "10x10x4 flags"
  std::uint32_t actions = 0;
  std::uint64_t limit = 0;
  double discount = 1.0;
  std::string_view libm;  ///< when bits depend on the C library's functions
};

bool takes(const WorldEntry& entry, std::string_view parameter) {
  for (const ParameterText& one : entry.parameters()) {
    if (one.name == parameter) return true;
  }
  return false;
}

std::string_view when_libm(const WorldEntry& entry, const World& standard) {
  if (standard.traits.libm) return "always";
  if (!takes(entry, "seeding")) return "never";
  const Result<World> gymnasium = entry.make({{"seeding", "gymnasium"}});
  return gymnasium && gymnasium->traits.libm ? "with seeding=gymnasium" : "never";
}

std::string offers(const Spaces& spaces) {
  if (spaces.states > 0) return grouped(spaces.states) + " states";
  if (spaces.shape[0] == 0) return std::to_string(spaces.observation) + " numbers";
  std::string text;
  for (const std::uint32_t size : spaces.shape) {
    if (size > 0) text += (text.empty() ? "" : "x") + std::to_string(size);
  }
  return text + (spaces.whole ? " flags" : " numbers");
}

std::vector<WorldLine> world_lines() {
  std::vector<WorldLine> lines;
  for (const WorldEntry* const entry : worlds()) {
    const Result<World> world = entry->make({});
    if (!world) continue;
    const Spaces spaces = world->make({})->spaces();
    lines.push_back({entry, offers(spaces), spaces.actions, world->episode_steps, world->discount,
                     when_libm(*entry, *world)});
  }
  return lines;
}

std::string worlds_text() {
  using Align = TextTable::Align;
  TextTable table({{"worlds"},
                   {"offers"},
                   {"actions", Align::right},
                   {"limit", Align::right},
                   {"discount", Align::right},
                   {""}});
  std::string libm;
  for (const WorldLine& line : world_lines()) {
    if (line.libm != "never") libm += (libm.empty() ? "" : ", ") + std::string(line.entry->name);
    table.row({std::string(line.entry->name), line.offers, std::to_string(line.actions),
               line.limit == 0 ? "-" : grouped(line.limit), shortest(line.discount),
               std::string(line.entry->summary)});
  }
  return table.text() + "quoll list worlds NAME tells a world's parameters, aliases and source\n" +
         (libm.empty() ? ""
                       : "with seeding=gymnasium the bits of " + libm +
                             " depend on the C library's sin and cos\n");
}

void write_parameters(JsonWriter& json, const WorldEntry& entry) {
  json.key("parameters").begin_array();
  for (const ParameterText& parameter : entry.parameters()) {
    json.begin_object().member("name", parameter.name).member("default", parameter.standard);
    json.member("range", parameter.range).member("sentence", parameter.sentence).end_object();
  }
  json.end_array();
}

void write_worlds(JsonWriter& json) {
  for (const WorldLine& line : world_lines()) {
    json.begin_object().member("name", line.entry->name);
    json.key("aliases").begin_array();
    for (const std::string_view alias : split(line.entry->aliases, ' ')) {
      if (!alias.empty()) json.value(alias.substr(0, alias.find(':')));
    }
    json.end_array().member("summary", line.entry->summary);
    json.member("offers", line.offers).member("actions", line.actions);
    json.member("step_limit", line.limit).member("discount", line.discount);
    json.member("libm", line.libm).member("source", line.entry->source);
    write_parameters(json, *line.entry);
    json.end_object();
  }
}

/// quoll list worlds NAME.
Exit list_world(const std::string& name, bool as_json) {
  const WorldEntry* const entry = find_world_entry(name);
  if (!entry) {
    const Result<World> world = find_world(name);
    if (!world) return fail(world.error());
    return fail({"list", 0, 0, "a built-in world expected, not the file '" + name + "'", ""});
  }
  if (as_json) {
    JsonWriter json(JsonStyle::pretty);
    json.begin_object().member("name", entry->name).member("aliases", entry->aliases);
    json.member("summary", entry->summary).member("source", entry->source);
    write_parameters(json, *entry);
    json.end_object();
    return print(json.text() + "\n") ? done : user_error;
  }
  std::string text = fmt::format("{}   {}\n", entry->name, entry->summary);
  text += fmt::format("source   {}\n", entry->source);
  if (!entry->aliases.empty()) text += fmt::format("aliases  {}\n", entry->aliases);
  TextTable table({{"--with"}, {"default"}, {"takes"}, {""}});
  const std::vector<ParameterText> parameters = entry->parameters();
  for (const ParameterText& one : parameters) {
    table.row({one.name, one.standard, one.range, one.sentence});
  }
  if (!parameters.empty()) text += "\n" + table.text();
  return print(text) ? done : user_error;
}

std::vector<Line> method_lines() {
  std::vector<Line> lines;
  for (const LearnerEntry& entry : learners()) {
    lines.push_back(
        {std::string(entry.method), std::string(entry.rule), std::string(entry.summary)});
  }
  return lines;
}

template <std::size_t n>
std::vector<Line> named(const std::string_view (&names)[n], const std::string_view (&says)[n]) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < n; ++i) {
    lines.push_back({std::string(names[i]), "", std::string(says[i])});
  }
  return lines;
}

std::vector<Line> format_lines() {
  std::vector<Line> lines;
  for (const Format& format : formats()) {
    lines.push_back(
        {std::string(format.name), std::string(format.extension), std::string(format.summary)});
  }
  return lines;
}

std::vector<Line> solver_lines() {
  std::vector<Line> lines;
  for (const SolverEntry& entry : solvers()) {
    lines.push_back({std::string(entry.name), "", std::string(entry.summary)});
  }
  return lines;
}

constexpr std::array<Topic, 6> topics{{
    {"worlds", "", nullptr},
    {"methods", "rule", method_lines},
    {"explorations", "", [] { return named(exploration_names, exploration_summaries); }},
    {"starts", "", [] { return named(start_names, start_summaries); }},
    {"formats", "extension", format_lines},
    {"solvers", "", solver_lines},
}};

std::string topic_text(const Topic& topic) {
  if (!topic.lines) return worlds_text();
  const std::vector<Line> lines = topic.lines();
  bool second = false;
  for (const Line& line : lines) second = second || !line.second.empty();
  std::vector<TextTable::Column> columns{{std::string(topic.name)}};
  if (second) columns.push_back({std::string(topic.second_key)});
  columns.push_back({""});
  TextTable table(std::move(columns));
  for (const Line& line : lines) {
    if (second)
      table.row({line.name, line.second, line.summary});
    else
      table.row({line.name, line.summary});
  }
  return table.text();
}

void write_topic(JsonWriter& json, const Topic& topic) {
  json.key(topic.name).begin_array();
  if (!topic.lines) write_worlds(json);
  for (const Line& line : topic.lines ? topic.lines() : std::vector<Line>()) {
    json.begin_object().member("name", line.name);
    if (!topic.second_key.empty()) {
      json.member(topic.second_key, line.second);
    }
    json.member("summary", line.summary).end_object();
  }
  json.end_array();
}

Exit list(const std::string& wanted, bool as_json) {
  Nearest nearest(wanted);
  std::string text;
  JsonWriter json(JsonStyle::pretty);
  json.begin_object();
  bool found = false;
  for (const Topic& topic : topics) {
    nearest.offer(topic.name);
    if (!wanted.empty() && wanted != topic.name) continue;
    text += (found ? "\n" : "") + topic_text(topic);
    write_topic(json, topic);
    found = true;
  }
  json.end_object();
  if (!found) {
    return fail(
        {"list", 0, 0,
         "worlds, methods, explorations, starts, formats or solvers expected, not '" + wanted + "'",
         nearest.best()});
  }
  return print(as_json ? json.text() + "\n" : text) ? done : user_error;
}

struct ListOptions {
  std::string topic, name;
  bool json = false;
};

}  // namespace

void declare_list(Options& options) {
  auto given = std::make_shared<ListOptions>();
  options.word("topic", given->topic,
               "worlds, methods, explorations, starts, formats or solvers; without: all of them",
               false);
  options.word("name", given->name, "a world, for its parameters, aliases and source", false);
  options.flag("--json", &given->json, "print one JSON object on stdout");
  options.run([given] {
    if (given->name.empty()) return list(given->topic, given->json);
    if (given->topic == "worlds") return list_world(given->name, given->json);
    return fail({"list", 0, 0, "only worlds take a name, not " + given->topic, ""});
  });
}

}  // namespace quoll::cli
