// The TOML world format, specified in docs/worlds.md.

#if defined(__wasi__)
#include <istream>
// The standard library of WebAssembly declares file streams without defining them, and the parser's
// parse_file, which nothing here calls, wants one: this one opens nothing.
template <>
class std::basic_ifstream<char> : public std::istream {
 public:
  basic_ifstream() : std::istream(nullptr) {}
  void open(const std::string&, openmode) {}
  bool is_open() const { return false; }
};
#endif

// Some of the parser's own asserts can be reached by a damaged file ("[=]"); its checks behind them
// answer such a file with an error. Under NDEBUG it would tell the compiler that they hold.
#undef NDEBUG
#define TOML_ASSERT(condition) static_assert(true)
#define TOML_EXCEPTIONS 0
#define TOML_HEADER_ONLY 1
#define TOML_ENABLE_FORMATTERS 0

// Its test for blanks calls most letters beyond ASCII unreachable, which they are not.
// Version 3.4 calls its parts .hpp.
// clang-format off
#if __has_include(<toml++/impl/preprocessor.hpp>)
#include <toml++/impl/preprocessor.hpp>
#include <toml++/impl/std_new.hpp>
#include <toml++/impl/std_string.hpp>
#include <toml++/impl/std_optional.hpp>
#include <toml++/impl/forward_declarations.hpp>
#else
#include <toml++/impl/preprocessor.h>
#include <toml++/impl/std_new.h>
#include <toml++/impl/std_string.h>
#include <toml++/impl/std_optional.h>
#include <toml++/impl/forward_declarations.h>
#endif
// clang-format on
#pragma push_macro("TOML_UNREACHABLE")
#undef TOML_UNREACHABLE
#define TOML_UNREACHABLE return false
#if __has_include(<toml++/impl/unicode.hpp>)
#include <toml++/impl/unicode.hpp>
#else
#include <toml++/impl/unicode.h>
#endif
#pragma pop_macro("TOML_UNREACHABLE")

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/toml_text.hpp"
#include "quoll/model/letters.hpp"

namespace quoll {

namespace {

struct Entry {
  std::string_view key;
  toml::source_position at;  // of the key
  const toml::node* value;
};

// The entries in the order of the file; the parser's tables are sorted by key.
std::vector<Entry> in_order(const toml::table& table) {
  std::vector<Entry> entries;
  for (const auto& [key, value] : table) entries.push_back({key.str(), key.source().begin, &value});
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.at < b.at; });
  return entries;
}

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  Result<MdpArrays> read(const toml::table& file) {
    static constexpr std::array<std::string_view, 9> keys{"name",    "discount", "alternating",
                                                          "start",   "terminal", "reward",
                                                          "actions", "labels",   "states"};
    if (known_keys(file, keys)) {
      if (const toml::node* name = file.get("name")) text(*name, "a name in quotes");
      a_.discount = number(file.get("discount"), 1.0);
      a_.alternating = flag(file.get("alternating"));
      reward_ = number(file.get("reward"), 0.0);
      actions(file.get("actions"));
      states(file.get("states"));
      terminal(file.get("terminal"));
      start(file.get("start"));
      labels(file.get("labels"));
    }
    if (failed_) return error_;
    for (const std::string& name : state_names_) a_.state_names.push_back(name);
    for (const std::string& name : action_names_) a_.action_names.push_back(name);
    return std::move(a_);
  }

 private:
  // The first failure stays; everything after it does nothing of consequence.
  bool fail(toml::source_position at, std::string expected, std::string near = "") {
    if (!failed_) error_ = {path_, at.line, at.column, std::move(expected), std::move(near)};
    failed_ = true;
    return false;
  }
  bool fail(const toml::node& node, std::string expected, std::string near = "") {
    return fail(node.source().begin, std::move(expected), std::move(near));
  }

  bool known_keys(const toml::table& table, std::span<const std::string_view> keys) {
    for (const Entry& entry : in_order(table)) {
      if (std::find(keys.begin(), keys.end(), entry.key) != keys.end()) continue;
      std::string expected = "unknown key '" + std::string(entry.key) + "', expected ";
      for (std::size_t i = 0; i < keys.size(); ++i) {
        expected += std::string(i == 0 ? "" : i + 1 == keys.size() ? " or " : ", ");
        expected += keys[i];
      }
      return fail(entry.at, std::move(expected), nearest(entry.key, keys));
    }
    return true;
  }

  double number(const toml::node* node, double otherwise) {
    if (node == nullptr) return otherwise;
    if (const auto* integer = node->as_integer()) return static_cast<double>(integer->get());
    if (const auto* real = node->as_floating_point()) return real->get();
    fail(*node, "expected a number");
    return otherwise;
  }

  bool flag(const toml::node* node) {
    if (node == nullptr) return false;
    if (const auto* boolean = node->as_boolean()) return boolean->get();
    return fail(*node, "expected true or false");
  }

  std::string_view text(const toml::node& node, const char* expected) {
    if (const auto* string = node.as_string()) return string->get();
    fail(node, std::string("expected ") + expected);
    return "";
  }

  State state(std::string_view name, toml::source_position at) {
    const auto found = state_index_.find(std::string(name));
    if (found != state_index_.end()) return found->second;
    fail(at, "no state '" + std::string(name) + "'", nearest(name, state_names_));
    return 0;
  }
  State state(const toml::node& node) {
    const std::string_view name = text(node, "the name of a state in quotes");
    return failed_ ? 0 : state(name, node.source().begin);
  }

  void check_name(std::string_view name, toml::source_position at) {
    const std::string_view reason = name_fault(name);
    if (!reason.empty()) fail(at, std::string(reason));
  }

  std::uint32_t action(std::string_view name, toml::source_position at) {
    const auto [entry, added] = action_index_.try_emplace(
        std::string(name), static_cast<std::uint32_t>(action_names_.size()));
    if (added) {
      check_name(name, at);
      action_names_.emplace_back(name);
    }
    return entry->second;
  }

  void actions(const toml::node* node) {
    if (node == nullptr) return;
    const toml::array* list = node->as_array();
    if (list == nullptr) {
      fail(*node, "expected a list of action names");
      return;
    }
    for (const toml::node& item : *list) {
      action(text(item, "the name of an action in quotes"), item.source().begin);
    }
  }

  void states(const toml::node* node) {
    if (node == nullptr || node->as_table() == nullptr || node->as_table()->empty()) {
      const toml::source_position top{1, 1};
      fail(node ? node->source().begin : top, "expected states, for example [states.HALL]");
      return;
    }
    const std::vector<Entry> entries = in_order(*node->as_table());
    for (const Entry& entry : entries) {
      check_name(entry.key, entry.at);
      state_index_.emplace(entry.key, static_cast<State>(state_names_.size()));
      state_names_.emplace_back(entry.key);
    }
    a_.choice_begin.push_back(0);
    a_.outcome_begin.push_back(0);
    for (const Entry& entry : entries) {
      const toml::table* moves = entry.value->as_table();
      if (moves == nullptr) fail(*entry.value, "expected a table: action = \"NEXT STATE\"");
      if (failed_) return;
      for (const Entry& move : in_order(*moves)) {
        a_.action.push_back(action(move.key, move.at));
        a_.choice_line.push_back(move.at.line);
        outcomes(*move.value);
        if (failed_) return;
        remark_duplicates(entry.key, move.key);
        a_.outcome_begin.push_back(a_.next.size());
      }
      a_.choice_begin.push_back(a_.action.size());
    }
  }

  // "NEXT" | { to = "NEXT", reward = R } | { to = { A = 0.5, B = 0.5 }, reward = R } | [ ... ]
  void outcomes(const toml::node& move) {
    if (move.is_string()) {
      outcome(state(move), 1.0, reward_);
    } else if (const toml::table* table = move.as_table()) {
      single(*table, false);
    } else if (const toml::array* list = move.as_array(); list != nullptr && !list->empty()) {
      for (const toml::node& item : *list) {
        if (const toml::table* entry = item.as_table()) {
          single(*entry, list->size() > 1);
        } else {
          fail(item, "expected { to = \"STATE\", probability = P, reward = R }");
        }
      }
    } else {
      fail(move,
           "expected the next state in quotes, a table { to = \"STATE\", reward = R }, "
           "or a list of such tables with probabilities");
    }
  }

  void single(const toml::table& table, bool needs_probability) {
    static constexpr std::array<std::string_view, 3> keys{"to", "probability", "reward"};
    if (!known_keys(table, keys)) return;
    const toml::node* to = table.get("to");
    const toml::node* probability = table.get("probability");
    if (to == nullptr) {
      fail(table, "expected 'to', the next state");
      return;
    }
    if (needs_probability && probability == nullptr) {
      fail(table, "expected 'probability', because there are several outcomes");
      return;
    }
    const double share = number(probability, 1.0);
    const double reward = number(table.get("reward"), reward_);
    if (const toml::table* several = to->as_table()) {
      if (several->empty()) fail(*to, "expected at least one state, for example { HALL = 1 }");
      for (const Entry& entry : in_order(*several)) {
        const double part = number(entry.value, 1.0);
        outcome(state(entry.key, entry.at), probability ? share * part : part, reward);
      }
    } else {
      outcome(state(*to), share, reward);
    }
  }

  void outcome(State next, double probability, double reward) {
    a_.next.push_back(next);
    a_.probability.push_back(probability);
    a_.outcome_reward.push_back(reward);
  }

  // Looks at the outcomes after the last complete choice.
  void remark_duplicates(std::string_view from, std::string_view by) {
    std::vector<std::pair<State, double>> seen;
    for (std::size_t o = a_.outcome_begin.back(); o < a_.next.size(); ++o) {
      seen.emplace_back(a_.next[o], a_.outcome_reward[o]);
    }
    std::sort(seen.begin(), seen.end());
    for (auto it = std::adjacent_find(seen.begin(), seen.end()); it != seen.end();
         it = std::adjacent_find(it, seen.end())) {
      const auto [next, reward] = *it;
      a_.remarks.push_back("state " + std::string(from) + ", action " + std::string(by) +
                           ": successor " + state_names_[next] + " stands twice");
      while (it != seen.end() && *it == std::pair(next, reward)) ++it;
    }
  }

  void terminal(const toml::node* node) {
    if (node == nullptr || failed_) return;
    a_.terminal = listed(*node, "a list of states");
    std::sort(a_.terminal.begin(), a_.terminal.end());
  }

  void labels(const toml::node* node) {
    if (node == nullptr || failed_) return;
    if (node->as_table() == nullptr) {
      fail(*node, "expected labels with their states, for example goal = [\"CAVE\"]");
      return;
    }
    for (const Entry& entry : in_order(*node->as_table())) {
      check_name(entry.key, entry.at);
      Label label{std::string(entry.key), listed(*entry.value, "a list of states")};
      std::sort(label.states.begin(), label.states.end());
      a_.labels.push_back(std::move(label));
    }
  }

  // One state or a list of different ones.
  std::vector<State> listed(const toml::node& node, const char* expected) {
    if (node.is_string()) return {state(node)};
    std::vector<State> found;
    const toml::array* list = node.as_array();
    if (list == nullptr) {
      fail(node, std::string("expected ") + expected);
      return found;
    }
    std::vector<bool> met(state_names_.size(), false);
    for (const toml::node& item : *list) {
      const State s = state(item);
      if (failed_) return found;
      if (met[s]) fail(item, "state '" + state_names_[s] + "' stands twice");
      met[s] = true;
      found.push_back(s);
    }
    return found;
  }

  void start(const toml::node* node) {
    if (node == nullptr || failed_) return;
    if (const auto* word = node->as_string(); word != nullptr && word->get() == "uniform") return;
    std::vector<std::pair<State, double>> starts;
    if (const toml::table* table = node->as_table()) {
      for (const Entry& entry : in_order(*table)) {
        starts.emplace_back(state(entry.key, entry.at), number(entry.value, 0.0));
      }
    } else {
      for (const State s : listed(*node,
                                  "\"uniform\", a state, a list of states or a table "
                                  "{ HALL = 0.5, GATE = 0.5 }")) {
        starts.emplace_back(s, 0.0);
      }
    }
    if (starts.empty()) fail(*node, "expected at least one start state");
    std::sort(starts.begin(), starts.end());
    for (const auto& [s, probability] : starts) {
      a_.start.push_back(s);
      if (node->is_table()) a_.start_probability.push_back(probability);
    }
  }

  const std::string& path_;
  MdpArrays a_;
  double reward_ = 0.0;
  std::vector<std::string> state_names_, action_names_;
  std::unordered_map<std::string, std::uint32_t> state_index_, action_index_;
  Error error_;
  bool failed_ = false;
};

// The parser's own words stand behind ours, which say what to do.
std::string syntax_sentence(std::string_view description) {
  struct Meaning {
    std::string_view sign, sentence;
  };
  static constexpr std::array<Meaning, 6> meanings{
      {{"control characters", "a closing quotation mark on the same line"},
       {"redefine", "every name once"},
       {"tf-8", "text in UTF-8"},
       {"end-of-file", "more than the file holds"},
       {"end-of-line", "the rest of this line"},
       {"", "KEY = VALUE or [TABLE]"}}};
  for (const Meaning& meaning : meanings) {
    if (description.find(meaning.sign) == std::string_view::npos) continue;
    return "expected TOML: " + std::string(meaning.sentence) + " (" + std::string(description) +
           ")";
  }
  return std::string(description);
}

}  // namespace

Result<MdpArrays> read_toml(std::string_view content, const std::string& path) {
  if (const std::uint64_t line = line_with_deep_key(content)) {
    return Error{path, line, 0, "a key of over 100 parts", ""};
  }
  toml::parse_result file = toml::parse(content, path);
  if (!file) {
    const toml::source_position at = file.error().source().begin;
    return Error{path, at.line, at.column, syntax_sentence(file.error().description()), ""};
  }
  return Reader(path).read(file.table());
}

}  // namespace quoll
