#pragma once
// Data as a tree: what a state looks like to people and to JSON. A type that names its fields in a
// templated persist(auto& archive), as it does for saving, becomes an object of those fields;
// arrays become lists.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "quoll/base/error.hpp"

namespace quoll {

struct Tree {
  using List = std::vector<Tree>;
  using Object = std::vector<std::pair<std::string, Tree>>;
  std::variant<std::nullptr_t, bool, std::int64_t, double, float, std::string, List, Object> value;

  Tree() : value(nullptr) {}
  template <class T>
    requires(!std::is_same_v<std::remove_cvref_t<T>, Tree>)
  explicit Tree(T&& of) : value(std::forward<T>(of)) {}

  /// The field of an object, or nullptr.
  const Tree* find(std::string_view key) const;
  bool operator==(const Tree&) const = default;
};

/// Writes fields into a tree.
class TreeWriter {
 public:
  template <class T>
  void operator()(std::string_view name, T& field) {
    object_.emplace_back(std::string(name), to_tree(field));
  }
  /// True, as an Archive that saves says.
  static constexpr bool saving() { return true; }
  void fail(std::string) {}

  template <class T>
  static Tree to_tree(T& field) {
    if constexpr (std::is_same_v<T, bool> || std::is_floating_point_v<T>) {
      return Tree(T{field});
    } else if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) {
      return Tree(static_cast<std::int64_t>(field));
    } else if constexpr (std::is_same_v<T, std::string>) {
      return Tree(std::string(field));
    } else if constexpr (requires(TreeWriter& writer) { field.persist(writer); }) {
      TreeWriter inner;
      field.persist(inner);
      return Tree(std::move(inner.object_));
    } else {
      Tree::List list;
      for (auto& item : field) list.push_back(to_tree(item));
      return Tree(std::move(list));
    }
  }

 private:
  Tree::Object object_;
};

/// Reads fields back; every field must be there, in any order, and no other. The first thing that
/// does not fit is kept as an error whose `expected` says what and where ("x[2]: a number
/// expected").
class TreeReader {
 public:
  /// `root` must outlive the reader.
  explicit TreeReader(const Tree& root) : at_(&root) {}

  template <class T>
  void operator()(std::string_view name, T& field) {
    if (!good()) return;
    const Tree* const found = at_->find(name);
    if (!found) return differs(std::string(name), "expected, but missing");
    ++used_;
    descend(*found, (path_.empty() ? "" : ".") + std::string(name), field);
  }
  static constexpr bool saving() { return false; }
  /// Marks what was read as impossible, with the reason.
  void fail(std::string reason);
  bool good() const { return reason_.empty(); }
  const std::string& reason() const { return reason_; }

  /// Reads `field` from the tree this stands at.
  template <class T>
  void read(T& field) {
    if constexpr (std::is_same_v<T, bool>) {
      take_bool(field);
    } else if constexpr (std::is_floating_point_v<T>) {
      double number = 0;
      take_number(number);
      field = static_cast<T>(number);
    } else if constexpr (std::is_enum_v<T>) {
      auto number = static_cast<std::underlying_type_t<T>>(field);
      read(number);
      field = static_cast<T>(number);
    } else if constexpr (std::is_integral_v<T>) {
      std::int64_t whole = 0;
      constexpr bool wide = sizeof(T) == 8;
      take_whole(whole,
                 wide ? std::numeric_limits<std::int64_t>::min()
                      : static_cast<std::int64_t>(std::numeric_limits<T>::min()),
                 wide ? std::numeric_limits<std::int64_t>::max()
                      : static_cast<std::int64_t>(std::numeric_limits<T>::max()));
      field = static_cast<T>(whole);
    } else if constexpr (std::is_same_v<T, std::string>) {
      take_text(field);
    } else if constexpr (requires { field.persist(*this); }) {
      if (!std::holds_alternative<Tree::Object>(at_->value))
        return differs("", "an object expected");
      const std::size_t outside = std::exchange(used_, 0);
      field.persist(*this);
      if (good() && used_ != std::get<Tree::Object>(at_->value).size()) {
        differs("", "no further field expected");
      }
      used_ = outside;
    } else {
      take_list(field);
    }
  }

 private:
  template <class T>
  void descend(const Tree& into, const std::string& name, T& field) {
    const Tree* const outside = std::exchange(at_, &into);
    const std::size_t length = path_.size();
    path_ += name;
    read(field);
    path_.resize(length);
    at_ = outside;
  }
  template <class Sequence>
  void take_list(Sequence& field) {
    const auto* const list = std::get_if<Tree::List>(&at_->value);
    if (!list) return differs("", "a list expected");
    if constexpr (requires { field.resize(1); }) {
      field.resize(list->size());
    } else if (list->size() != field.size()) {
      return differs("", "a list of " + std::to_string(field.size()) + " expected");
    }
    for (std::size_t i = 0; i < list->size() && good(); ++i) {
      descend((*list)[i], "[" + std::to_string(i) + "]", field[i]);
    }
  }
  void take_bool(bool& field);
  void take_number(double& field);
  void take_whole(std::int64_t& field, std::int64_t low, std::int64_t high);
  void take_text(std::string& field);
  void differs(const std::string& name, const std::string& expected);

  const Tree* at_;
  std::size_t used_ = 0;  // fields read from the object at_
  std::string path_, reason_;
};

/// The tree of any value that an archive can hold.
template <class T>
Tree tree_of(const T& value) {
  T copy = value;
  return TreeWriter::to_tree(copy);
}

/// The value a tree says, or where it does not fit. `value` gives the form and is unchanged on an
/// error.
template <class T>
Result<void> assign(T& value, const Tree& tree) {
  T copy = value;
  TreeReader reader(tree);
  reader.read(copy);
  if (!reader.good()) return Error{"", 0, 0, reader.reason(), ""};
  value = std::move(copy);
  return {};
}

}  // namespace quoll
