// What index.json says of types, and the names of states from their valuations: numbers packed bit
// by bit, the first in the lowest bits (spec.md, section 7).

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "quoll/base/bytes.hpp"
#include "quoll/base/text.hpp"
#include "quoll/model/formats/umb.hpp"
#include "quoll/model/letters.hpp"
#include "quoll/model/name_index.hpp"

namespace quoll::umb {
namespace {

constexpr std::uint64_t most_bits = std::uint64_t{1} << 32;

Error error(std::string expected) {
  return Error{"", 0, 0, std::move(expected), ""};
}

std::optional<std::uint64_t> whole(const Tree* tree) {
  const auto* const number = tree ? std::get_if<std::int64_t>(&tree->value) : nullptr;
  if (!number || *number < 0) return std::nullopt;
  return static_cast<std::uint64_t>(*number);
}

/// One variable, or so many bits of padding.
struct Variable {
  std::string name;  ///< empty = padding
  Type type;
  bool optional = false;  ///< one bit before the value says whether it is there
  std::int64_t offset = 0;
};

struct Class {
  std::vector<Variable> variables;
  std::uint64_t bytes = 0;
};

Result<Variable> variable_of(const Tree& tree) {
  Variable variable;
  if (const Tree* const padding = tree.find("padding")) {
    const auto bits = whole(padding);
    if (!bits || *bits >= most_bits) return error("valuations: a padding in bits expected");
    variable.type = {"padding", *bits};
    return variable;
  }
  const Tree* const name = tree.find("name");
  const auto* const text = name ? std::get_if<std::string>(&name->value) : nullptr;
  if (!text || text->empty()) return error("valuations: a variable's name expected");
  variable.name = *text;
  auto type = type_of(tree.find("type"));
  if (!type) return type.error();
  variable.type = *std::move(type);
  if (variable.type.bits > 64) {
    return error("valuations: " + variable.type.name + " of at most 64 bits expected for " + *text);
  }
  const Tree* const optional = tree.find("is-optional");
  variable.optional = optional && optional->value == Tree(true).value;
  if (const Tree* const offset = tree.find("offset")) {
    const auto* const number = std::get_if<std::int64_t>(&offset->value);
    if (!number) return error("valuations: a whole number as offset of " + *text + " expected");
    variable.offset = *number;
  }
  return variable;
}

Result<Class> class_of(const Tree& tree) {
  const Tree* const variables = tree.find("variables");
  const auto* const list = variables ? std::get_if<Tree::List>(&variables->value) : nullptr;
  if (!list) return error("valuations: a list of variables expected");
  Class result;
  std::uint64_t bits = 0;
  for (const Tree& item : *list) {
    auto variable = variable_of(item);
    if (!variable) return variable.error();
    bits += variable->type.bits + (variable->optional ? 1 : 0);
    result.variables.push_back(*std::move(variable));
  }
  if (bits == 0 || bits % 8 != 0) return error("valuations: whole bytes for each state expected");
  result.bytes = bits / 8;
  return result;
}

/// Bits of one valuation, taken from the lowest on.
class Bits {
 public:
  explicit Bits(std::string_view bytes) : bytes_(bytes) {}
  void skip(std::uint64_t count) { at_ += count; }
  /// At most 64.
  std::uint64_t take(std::uint64_t count) {
    std::uint64_t value = 0;
    for (std::uint64_t i = 0; i < count;) {
      const std::uint64_t from = at_ % 8;
      const std::uint64_t some = std::min(count - i, 8 - from);
      const auto byte = static_cast<unsigned char>(bytes_[at_ / 8]);
      value |= (std::uint64_t{byte} >> from & ((std::uint64_t{1} << some) - 1)) << i;
      i += some;
      at_ += some;
    }
    return value;
  }

 private:
  std::string_view bytes_;
  std::uint64_t at_ = 0;
};

std::optional<std::string> text_of(const Variable& variable, std::uint64_t bits,
                                   const Names& strings) {
  const std::string& type = variable.type.name;
  const std::uint64_t size = variable.type.bits;
  if (type == "bool") return bits != 0 ? "true" : "false";
  if (type == "uint" && variable.offset == 0) return std::to_string(bits);
  if (type == "int" || type == "uint") {
    if (type == "int" && size < 64 && (bits >> (size - 1) & 1) != 0)
      bits |= ~std::uint64_t{0} << size;
    // The sum of two's complements without overflow.
    return std::to_string(
        static_cast<std::int64_t>(bits + static_cast<std::uint64_t>(variable.offset)));
  }
  if (type == "double" && size == 64) return shortest(std::bit_cast<double>(bits));
  if (type == "string" && size == 64 && bits < strings.size()) return strings[bits];
  return std::nullopt;
}

/// "(x=2,b=true)"; a text that is all there is stands alone. Nothing when a value cannot be shown.
std::optional<std::string> name_of(const Class& valuation, std::string_view bytes,
                                   const Names& strings) {
  Bits bits(bytes);
  std::string name;
  const bool alone =
      valuation.variables.size() == 1 && valuation.variables[0].type.name == "string";
  for (const Variable& variable : valuation.variables) {
    if (variable.name.empty()) {
      bits.skip(variable.type.bits);
      continue;
    }
    const bool there = !variable.optional || bits.take(1) != 0;
    const std::uint64_t value = bits.take(variable.type.bits);
    const auto text = there ? text_of(variable, value, strings) : "none";
    if (!text) return std::nullopt;
    if (alone) return text;
    name += (name.empty() ? "(" : ",") + variable.name + "=" + *text;
  }
  return name.empty() ? name : name + ")";
}

}  // namespace

const std::string_view* find(const Files& files, std::string_view name) {
  const auto found = files.find(name);
  return found == files.end() ? nullptr : &found->second;
}

const Tree* at(const Tree& tree, std::initializer_list<std::string_view> keys) {
  const Tree* found = &tree;
  for (const std::string_view key : keys) {
    found = found->find(key);
    if (!found) return nullptr;
  }
  return found;
}

Result<Type> type_of(const Tree* tree) {
  const Tree* const name = tree ? tree->find("type") : nullptr;
  const auto* const text = name ? std::get_if<std::string>(&name->value) : nullptr;
  if (!text) return error("index.json: a type such as {\"type\": \"double\"} expected");
  Type type{*text, 64};
  if (*text == "bool") type.bits = 1;
  if (*text == "rational" || text->ends_with("-interval")) type.bits = 128;
  if (*text == "rational-interval") type.bits = 256;
  if (const Tree* const size = tree->find("size")) {
    const auto bits = whole(size);
    if (!bits || *bits == 0 || *bits >= most_bits) {
      return error("index.json: type " + *text + ": a size in bits expected");
    }
    type.bits = *bits;
  }
  return type;
}

Result<Names> state_names(const Tree& description, const Files& files, std::uint64_t states) {
  const std::string folder = "valuations/states/";
  const Tree* const classes = description.find("classes");
  const auto* const list = classes ? std::get_if<Tree::List>(&classes->value) : nullptr;
  if (!list || list->empty()) return error("valuations: a list of classes expected");
  std::vector<Class> known;
  for (const Tree& item : *list) {
    auto valuation = class_of(item);
    if (!valuation) return valuation.error();
    known.push_back(*std::move(valuation));
  }
  Names texts;
  if (const auto count = whole(description.find("#strings"))) {
    auto given = strings(files, folder, std::min<std::uint64_t>(*count, UINT32_MAX));
    if (!given) return given.error();
    texts = *std::move(given);
  }
  const std::string_view* const values = find(files, folder + "valuations.bin");
  const std::string_view* const which = find(files, folder + "valuation-to-class.bin");
  if (!values || (which && which->size() != states * 4)) {
    return error(folder + "valuations.bin: one valuation per state expected");
  }
  // Long names of variables must not blow a small file up.
  const std::uint64_t most = 64 * values->size() + 4 * texts.bytes() + (std::uint64_t{1} << 20);
  NameIndex names;
  std::uint64_t length = 0;
  std::size_t begin = 0;
  for (std::uint64_t s = 0; s < states; ++s) {
    const std::uint32_t number = which ? load_little<std::uint32_t>(which->data() + 4 * s) : 0;
    if (number >= known.size() || values->size() - begin < known[number].bytes) {
      return error(folder + "valuations.bin: one valuation per state expected");
    }
    const auto name = name_of(known[number], values->substr(begin, known[number].bytes), texts);
    begin += known[number].bytes;
    if (!name || !name_fault(*name).empty()) {
      return error("the valuation of state " + std::to_string(s) + " makes no name");
    }
    length += name->size();
    if (length > most) return error("the names of variables are too long");
    if (names.insert(*name) != s) return error("state " + *name + " stands twice");
  }
  return names.take({});
}

}  // namespace quoll::umb
