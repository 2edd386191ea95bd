#pragma once
// The options of a verb as data: what the parser, --help, completion and the manual page are made
// from.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace quoll::cli {

struct Option {
  /// Receives what was given: a switch, a word (optional: an empty one is told from none), words of
  /// a repeated option, or a call per word.
  using Target = std::variant<bool*, std::string*, std::optional<std::string>*, unsigned*,
                              std::vector<std::string>*, std::function<void(const std::string&)>>;
  std::string names;  ///< "-o,--output"; without dashes: a positional word
  std::string type;   ///< "FILE", "number in [0, 1]"; empty = a switch
  std::string sentence;
  Target target;
  bool required = false;
  bool repeated = false;

  bool positional() const { return names.front() != '-'; }
  bool is_switch() const { return type.empty(); }
};

/// The options of one verb, and what runs when it is called.
class Options {
 public:
  void word(std::string name, std::string& target, std::string sentence, bool required = true) {
    list_.push_back({std::move(name), "WORD", std::move(sentence), &target, required, false});
  }
  void option(std::string names, Option::Target target, std::string type, std::string sentence) {
    const bool repeated = std::holds_alternative<std::vector<std::string>*>(target);
    list_.push_back({std::move(names), std::move(type), std::move(sentence), std::move(target),
                     false, repeated});
  }
  void flag(std::string names, Option::Target target, std::string sentence) {
    list_.push_back({std::move(names), "", std::move(sentence), std::move(target), false, false});
  }
  /// What the verb does; returns the exit status. Keeps the verb's storage alive.
  void run(std::function<int()> action) { action_ = std::move(action); }

  const std::vector<Option>& list() const { return list_; }
  int call() const { return action_(); }

 private:
  std::vector<Option> list_;
  std::function<int()> action_;
};

}  // namespace quoll::cli
