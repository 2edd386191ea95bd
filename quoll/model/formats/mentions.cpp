#include "quoll/model/formats/mentions.hpp"

#include <algorithm>
#include <utility>

#include "quoll/base/text.hpp"

namespace quoll {
namespace {

constexpr std::string_view between = " \t,";

// A name in quotes at line[at], and the weight behind it; moves `at` behind both. Nothing on
// success, or what was expected at line[at].
std::optional<std::string> read_quoted(std::string_view line, std::size_t& at, Mention& mention) {
  mention.quoted = true;
  while (true) {
    const std::size_t quote = line.find('"', at + 1);
    if (quote == std::string_view::npos) return "expected a closing quote";
    mention.text += line.substr(at + 1, quote - at - 1);
    at = quote + 1;
    if (at == line.size() || line[at] != '"') break;
    mention.text += '"';
  }
  const std::size_t end = std::min(line.find_first_of(between, at), line.size());
  if (end == at) return std::nullopt;
  if (line[at] == ':') mention.weight = parse_number(line.substr(at + 1, end - at - 1));
  if (!mention.weight) return "expected a blank or :WEIGHT behind the quote";
  at = end;
  return std::nullopt;
}

}  // namespace

Result<void> parse_mentions(std::string_view line, std::size_t from, std::uint64_t number,
                            std::vector<Mention>& to) {
  std::size_t at = from;
  while (true) {
    at = line.find_first_not_of(between, at);
    if (at == std::string_view::npos) return {};
    Mention mention;
    mention.line = number;
    mention.column = at + 1;
    if (line[at] == '"') {
      if (auto expected = read_quoted(line, at, mention)) {
        return Error{"", number, at + 1, std::move(*expected), ""};
      }
    } else {
      const std::size_t end = std::min(line.find_first_of(between, at), line.size());
      mention.text = line.substr(at, end - at);
      at = end;
    }
    to.push_back(std::move(mention));
  }
}

void MentionWriter::add(std::string_view name, std::optional<double> weight) {
  constexpr std::size_t per_line = 20;
  if (count_ % per_line == 0) {
    out_ += count_ == 0 ? "# " : "\n# ";
    out_ += key_;
    out_ += " =";
  }
  ++count_;
  out_ += ' ';
  if (!name.empty() && name.find_first_of(" \t,\":") == std::string_view::npos) {
    out_ += name;
  } else {
    out_ += '"';
    for (const char letter : name) {
      if (letter == '"') out_ += '"';
      out_ += letter;
    }
    out_ += '"';
  }
  if (weight) out_ += ":" + shortest(*weight);
}

void MentionWriter::end() {
  if (count_ > 0) out_ += '\n';
}

}  // namespace quoll
