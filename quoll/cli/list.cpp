// quoll list TOPIC: what there is to choose from.

#include <array>

#include "quoll/act/exploration.hpp"
#include "quoll/act/start.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/report/json.hpp"
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

std::vector<Line> world_lines() {
  std::vector<Line> lines;
  for (const WorldEntry* const entry : worlds()) {
    lines.push_back(
        {std::string(entry->name), std::string(entry->aliases), std::string(entry->summary)});
  }
  return lines;
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
    {"worlds", "aliases", world_lines},
    {"methods", "rule", method_lines},
    {"explorations", "", [] { return named(exploration_names, exploration_summaries); }},
    {"starts", "", [] { return named(start_names, start_summaries); }},
    {"formats", "extension", format_lines},
    {"solvers", "", solver_lines},
}};

std::string topic_text(const Topic& topic) {
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
  for (const Line& line : topic.lines()) {
    json.begin_object().member("name", line.name);
    if (topic.second_key == "aliases") {
      json.key("aliases").begin_array();
      for (const std::string_view alias : split(line.second, ' ')) {
        if (!alias.empty()) json.value(alias);
      }
      json.end_array();
    } else if (!topic.second_key.empty()) {
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
  std::string topic;
  bool json = false;
};

}  // namespace

void declare_list(Options& options) {
  auto given = std::make_shared<ListOptions>();
  options.word("topic", given->topic,
               "worlds, methods, explorations, starts, formats or solvers; without: all of them",
               false);
  options.flag("--json", &given->json, "print one JSON object on stdout");
  options.run([given] { return list(given->topic, given->json); });
}

}  // namespace quoll::cli
