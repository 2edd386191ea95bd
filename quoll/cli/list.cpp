// quoll list TOPIC: what there is to choose from.

#include <fmt/format.h>

#include <array>
#include <memory>

#include "quoll/act/exploration.hpp"
#include "quoll/act/start.hpp"
#include "quoll/base/json.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/export_targets.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/solve/average_reward.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll::cli {
namespace {

/// One line of a list; `second` is what its second column says, empty = it has none.
struct Line {
  std::string name, second, summary;
};

/// One thing to list.
class Topic {
 public:
  virtual ~Topic() = default;
  virtual std::string_view name() const = 0;
  virtual std::string text() const = 0;
  /// The members of its list.
  virtual void write(JsonWriter& json) const = 0;
};

bool takes(const WorldEntry& entry, std::string_view parameter) {
  for (const ParameterText& one : entry.parameters()) {
    if (one.name == parameter) return true;
  }
  return false;
}

/// When bits depend on the C library's functions. A model's draws call none.
std::string_view when_libm(const WorldEntry& entry, const Offer& standard) {
  if (standard.libm) return "always";
  if (standard.spaces.observation == 0 || !takes(entry, "seeding")) return "never";
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

void write_parameters(JsonWriter& json, const WorldEntry& entry) {
  json.key("parameters").begin_array();
  for (const ParameterText& parameter : entry.parameters()) {
    json.begin_object().member("name", parameter.name).member("default", parameter.standard);
    json.member("range", parameter.range).member("sentence", parameter.sentence).end_object();
  }
  json.end_array();
}

void write_world(JsonWriter& json, const WorldEntry& entry) {
  const Offer offer = offer_of(entry);
  json.begin_object().member("name", entry.name).key("aliases").begin_array();
  for (const std::string_view alias : split(entry.aliases, ' ')) {
    if (!alias.empty()) json.value(alias);
  }
  json.end_array().member("summary", entry.summary);
  json.member("offers", offers(offer.spaces)).member("actions", offer.spaces.actions);
  json.member("step_limit", offer.episode_steps).member("discount", offer.discount);
  json.member("libm", when_libm(entry, offer)).member("source", entry.source);
  write_parameters(json, entry);
  json.end_object();
}

class Worlds final : public Topic {
 public:
  std::string_view name() const override { return "worlds"; }
  std::string text() const override {
    using Align = TextTable::Align;
    TextTable table({{"worlds"},
                     {"offers"},
                     {"actions", Align::right},
                     {"limit", Align::right},
                     {"discount", Align::right},
                     {""},
                     {"source"}});
    std::string libm;
    for (const WorldEntry* const entry : worlds()) {
      const Offer offer = offer_of(*entry);
      if (when_libm(*entry, offer) != "never") {
        libm += (libm.empty() ? "" : ", ") + std::string(entry->name);
      }
      table.row(
          {std::string(entry->name), offers(offer.spaces), std::to_string(offer.spaces.actions),
           offer.episode_steps == 0 ? "-" : grouped(offer.episode_steps), shortest(offer.discount),
           std::string(entry->summary), std::string(entry->source)});
    }
    std::string text =
        table.text() + "quoll list worlds NAME tells a world's parameters and aliases\n";
    if (libm.empty()) return text;
    return text + "with seeding=gymnasium the bits of " + libm +
           " depend on the C library's sin and cos\n";
  }
  void write(JsonWriter& json) const override {
    for (const WorldEntry* const entry : worlds()) write_world(json, *entry);
  }
};

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
    write_world(json, *entry);
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

std::vector<Line> export_lines() {
  std::vector<Line> lines;
  for (const ExportTarget& target : export_targets()) {
    lines.push_back(
        {std::string(target.name), std::string(target.extension), std::string(target.summary)});
  }
  return lines;
}

std::vector<Line> solver_lines() {
  std::vector<Line> lines;
  for (const SolverEntry& entry : solvers()) {
    lines.push_back({std::string(entry.name), "", std::string(entry.summary)});
  }
  lines.push_back({std::string(average_method), "", std::string(average_summary)});
  return lines;
}

/// A topic of plain lines.
class Lines final : public Topic {
 public:
  using Make = std::vector<Line> (*)();
  /// `second` = key and title of the second column; empty = there is none.
  Lines(std::string_view name, std::string_view second, Make lines)
      : name_(name), second_(second), lines_(lines) {}

  std::string_view name() const override { return name_; }
  std::string text() const override {
    std::vector<TextTable::Column> columns{{std::string(name_)}};
    if (!second_.empty()) columns.push_back({std::string(second_)});
    columns.push_back({""});
    TextTable table(std::move(columns));
    for (const Line& line : lines_()) {
      if (second_.empty())
        table.row({line.name, line.summary});
      else
        table.row({line.name, line.second, line.summary});
    }
    return table.text();
  }
  void write(JsonWriter& json) const override {
    for (const Line& line : lines_()) {
      json.begin_object().member("name", line.name);
      if (!second_.empty()) json.member(second_, line.second);
      json.member("summary", line.summary).end_object();
    }
  }

 private:
  std::string_view name_, second_;
  Make lines_;
};

std::array<std::unique_ptr<Topic>, 7> topics() {
  const auto lines = [](std::string_view name, std::string_view second, Lines::Make make) {
    return std::make_unique<Lines>(name, second, make);
  };
  return {std::make_unique<Worlds>(),
          lines("methods", "rule", method_lines),
          lines("explorations", "", [] { return named(exploration_names, exploration_summaries); }),
          lines("starts", "", [] { return named(start_names, start_summaries); }),
          lines("formats", "extension", format_lines),
          lines("exports", "extension", export_lines),
          lines("solvers", "", solver_lines)};
}

Exit list(const std::string& wanted, bool as_json) {
  Nearest nearest(wanted);
  std::string text;
  JsonWriter json(JsonStyle::pretty);
  json.begin_object();
  bool found = false;
  for (const std::unique_ptr<Topic>& topic : topics()) {
    nearest.offer(topic->name());
    if (!wanted.empty() && wanted != topic->name()) continue;
    if (as_json) {
      json.key(topic->name()).begin_array();
      topic->write(json);
      json.end_array();
    } else {
      text += (found ? "\n" : "") + topic->text();
    }
    found = true;
  }
  json.end_object();
  if (!found) {
    return fail(
        {"list", 0, 0,
         "worlds, methods, explorations, starts, formats, exports or solvers expected, not '" +
             wanted + "'",
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
  options.word(
      "topic", given->topic,
      "worlds, methods, explorations, starts, formats, exports or solvers; without: all of them",
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
