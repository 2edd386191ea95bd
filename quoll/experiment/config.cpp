#include "quoll/experiment/config.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"

namespace quoll {
namespace {

// The value as the text a flag would have had; nothing for a list, a table or a date.
std::optional<std::string> text_of_node(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (const auto* whole = node.as_integer()) return std::to_string(whole->get());
  if (const auto* number = node.as_floating_point()) return shortest(number->get());
  return std::nullopt;
}

// The values of a list with commas between them; nothing if there is none, or one is no text.
std::optional<std::string> text_of_list(const toml::array& list) {
  std::optional<std::string> all;
  for (const toml::node& node : list) {
    const std::optional<std::string> text = text_of_node(node);
    if (!text) return std::nullopt;
    all = all ? *all + "," + *text : *text;
  }
  return all;
}

// A TOML string: literal where that is possible, so that it reads like the word itself.
std::string quoted(const std::string& text) {
  const auto special = [](char letter) { return letter == '\'' || (letter >= 0 && letter < ' '); };
  if (std::none_of(text.begin(), text.end(), special)) return "'" + text + "'";
  constexpr char digits[] = "0123456789abcdef";
  std::string result = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') result += '\\';
    if (letter >= 0 && letter < ' ') {
      result += std::string("\\u00") + digits[letter >> 4] + digits[letter & 15];
    } else {
      result += letter;
    }
  }
  return result + "\"";
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
    const bool words = std::holds_alternative<std::string*>(setting->field);
    const std::optional<std::string> text =
        words && node.is_array() ? text_of_list(*node.as_array()) : text_of_node(node);
    if (!text) {
      return Error{place, 0, 0, "a number, a word or true or false expected: " + range_of(*setting),
                   ""};
    }
    const Result<void> assigned = assign(*setting, *text, place);
    if (!assigned) return assigned;
  }
  return {};
}

std::string config_text(const std::vector<Setting>& settings) {
  std::string text;
  for (const Setting& setting : settings) {
    // TOML's whole numbers end at 2^63; larger ones stand as words.
    const auto* const count = std::get_if<std::uint64_t*>(&setting.field);
    const bool words = std::holds_alternative<std::string*>(setting.field) ||
                       std::holds_alternative<Choice>(setting.field) ||
                       (count && **count > std::uint64_t{INT64_MAX});
    const std::string value = text_of(setting);
    text += std::string(setting.name) + " = " + (words ? quoted(value) : value) + "  # " +
            sentence_of(setting) + "\n";
  }
  return text;
}

}  // namespace quoll
