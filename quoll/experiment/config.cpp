#include "quoll/experiment/config.hpp"

#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"

namespace quoll {
namespace {

// The value as the text a flag would have had.
std::string text_of_node(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (const auto* whole = node.as_integer()) return std::to_string(whole->get());
  if (const auto* number = node.as_floating_point()) return shortest(number->get());
  return "";
}

}  // namespace

Result<void> read_config(const std::string& path, const std::vector<Setting>& settings) {
  const Result<std::string> content = read_file(path);
  if (!content) return content.error();
  const toml::parse_result parsed = toml::parse(*content, path);
  if (!parsed) {
    const auto& where = parsed.error().source().begin;
    return Error{path, where.line, where.column, std::string(parsed.error().description()), ""};
  }
  for (const auto& [key, node] : parsed.table()) {
    const std::string name(key.str());
    const auto& where = key.source().begin;
    const Setting* setting = find(settings, name);
    if (!setting) {
      Nearest nearest(name);
      for (const Setting& one : settings) nearest.offer(one.name);
      return Error{path, where.line, where.column, "no setting '" + name + "'", nearest.best()};
    }
    const std::string place = path + ":" + std::to_string(where.line) + ": " + name;
    const Result<void> assigned = assign(*setting, text_of_node(node), place);
    if (!assigned) return assigned;
  }
  return {};
}

std::string config_text(const std::vector<Setting>& settings) {
  std::string text;
  for (const Setting& setting : settings) {
    const bool words = std::holds_alternative<std::string*>(setting.field) ||
                       std::holds_alternative<Choice>(setting.field);
    const std::string value = text_of(setting);
    text += std::string(setting.name) + " = " + (words ? "'" + value + "'" : value) + "  # " +
            std::string(setting.sentence) + "\n";
  }
  return text;
}

}  // namespace quoll
