#include "quoll/report/json_tree.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace quoll {
namespace {

using Json = nlohmann::json;
constexpr int deepest = 100;

void write(JsonWriter& json, std::nullptr_t) {
  json.null();
}
template <class T>
void write(JsonWriter& json, const T& value) {
  json.value(value);
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

// Builds a tree from the parser's events, so that depth and the place of an error are known.
class Builder : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return add(Tree()); }
  bool boolean(bool value) override { return add(Tree(value)); }
  bool number_integer(std::int64_t value) override { return add(Tree(value)); }
  bool number_unsigned(std::uint64_t value) override {
    return value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())
               ? add(Tree(static_cast<std::int64_t>(value)))
               : add(Tree(static_cast<double>(value)));
  }
  bool number_float(double value, const std::string&) override { return add(Tree(value)); }
  bool string(std::string& value) override { return add(Tree(std::move(value))); }
  bool binary(Json::binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Tree(Tree::Object{})); }
  bool start_array(std::size_t) override { return open(Tree(Tree::List{})); }
  bool key(std::string& name) override {
    keys_.back() = std::move(name);
    return true;
  }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception&) override {
    failed_at = position;
    return false;
  }

  Tree root;
  std::size_t failed_at = 0;
  bool too_deep = false;

 private:
  bool open(Tree tree) {
    if (open_.size() == deepest) {
      too_deep = true;
      return false;
    }
    open_.push_back(std::move(tree));
    keys_.emplace_back();
    return true;
  }
  bool close() {
    Tree done = std::move(open_.back());
    open_.pop_back();
    keys_.pop_back();
    return add(std::move(done));
  }
  bool add(Tree tree) {
    if (open_.empty()) {
      root = std::move(tree);
    } else if (auto* const list = std::get_if<Tree::List>(&open_.back().value)) {
      list->push_back(std::move(tree));
    } else {
      std::get<Tree::Object>(open_.back().value).emplace_back(keys_.back(), std::move(tree));
    }
    return true;
  }

  std::vector<Tree> open_;
  std::vector<std::string> keys_;
};

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
  Builder builder;
  if (Json::sax_parse(text.begin(), text.end(), &builder)) return std::move(builder.root);
  if (builder.too_deep) return Error{place, 0, 0, "JSON nested at most 100 deep expected", ""};
  const std::string_view before = text.substr(0, std::min(builder.failed_at, text.size()));
  const std::size_t line_begin = before.rfind('\n');
  const auto line = static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n'));
  return Error{place, line + 1,
               before.size() - (line_begin == std::string_view::npos ? 0 : line_begin + 1),
               "JSON expected", ""};
}

}  // namespace quoll
