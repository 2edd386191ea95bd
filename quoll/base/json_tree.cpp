#include "quoll/base/json_tree.hpp"

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <system_error>

#include "quoll/base/json_reader.hpp"
#include "quoll/base/text.hpp"

namespace quoll {
namespace {

void write(JsonWriter& json, std::nullptr_t) {
  json.null();
}
template <class T>
void write(JsonWriter& json, const T& value) {
  json.value(value);
}
// Infinities and nan, which are no numbers in JSON, are written as texts: a state stays whole.
template <std::floating_point T>
void write(JsonWriter& json, const T& value) {
  if (std::isfinite(value))
    json.value(value);
  else
    json.value(shortest(value));
}
void write(JsonWriter& json, const Tree::List& list) {
  json.begin_array();
  for (const Tree& item : list) write_tree(json, item);
  json.end_array();
}
void write(JsonWriter& json, const Tree::Object& object) {
  json.begin_object();
  for (const auto& [name, field] : object) {
    json.key(name);
    write_tree(json, field);
  }
  json.end_object();
}

bool read(JsonReader& json, Tree& tree);

bool read_list(JsonReader& json, Tree& tree) {
  Tree::List& list = tree.value.emplace<Tree::List>();
  json.begin_list();
  while (json.next_item()) read(json, list.emplace_back());
  return json.good();
}

bool read_object(JsonReader& json, Tree& tree) {
  Tree::Object& object = tree.value.emplace<Tree::Object>();
  std::string name;
  json.begin_object();
  while (json.next_member(name)) read(json, object.emplace_back(name, Tree()).second);
  return json.good();
}

// A number without point and exponent that fits is whole.
bool read_number(JsonReader& json, Tree& tree) {
  std::string_view letters;
  if (!json.take_number(letters)) return false;
  std::int64_t whole = 0;
  const char* const end = letters.data() + letters.size();
  const auto parsed = std::from_chars(letters.data(), end, whole);
  if (parsed.ec == std::errc{} && parsed.ptr == end && letters != "-0") {
    tree = Tree(whole);
    return true;
  }
  const auto number = parse_number(letters);
  if (!number) return json.fail("a number that a double can hold expected");
  tree = Tree(*number);
  return true;
}

bool read(JsonReader& json, Tree& tree) {
  switch (json.peek()) {
    case JsonReader::Kind::object:
      return read_object(json, tree);
    case JsonReader::Kind::list:
      return read_list(json, tree);
    case JsonReader::Kind::text:
      return json.take(tree.value.emplace<std::string>());
    case JsonReader::Kind::truth:
      return json.take(tree.value.emplace<bool>());
    case JsonReader::Kind::number:
      return read_number(json, tree);
    case JsonReader::Kind::null:
    case JsonReader::Kind::nothing:
      break;
  }
  return json.skip();
}

}  // namespace

void write_tree(JsonWriter& json, const Tree& tree) {
  std::visit([&json](const auto& value) { write(json, value); }, tree.value);
}

std::string json_text(const Tree& tree) {
  JsonWriter json;
  write_tree(json, tree);
  return json.text();
}

Result<Tree> read_json(std::string_view text, const std::string& place) {
  JsonReader json(text);
  Tree root;
  if (read(json, root) && json.end()) return root;
  return json.error(place);
}

}  // namespace quoll
