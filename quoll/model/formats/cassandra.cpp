// Reads Cassandra's format: words between blanks and colons, '#' begins a comment, line ends mean
// nothing. First discount, values, states, actions and observations in any order, then the start
// and the rules T, O and R.

#include "quoll/model/formats/cassandra.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/letters.hpp"
#include "quoll/model/name_index.hpp"

namespace quoll {
namespace {

using cassandra::any;
using cassandra::Rule;
using cassandra::Rules;
using cassandra::Word;
using cassandra::WordStream;

constexpr std::size_t longest_shown = 60;  // of a word, in messages
constexpr std::array<std::string_view, 9> keywords = {
    "discount", "values", "states", "actions", "observations", "start", "T", "O", "R"};

std::optional<double> number_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  return text.find('/') == std::string_view::npos ? parse_number(text) : std::nullopt;
}

/// Names of states, actions or observations, or only their count.
struct Listed {
  std::uint32_t count = 0;
  bool named = false;
  NameIndex index;
};

class CassandraReader {
 public:
  CassandraReader(std::string_view content, const std::string& path)
      : words_(content), path_(path) {
    content_.bytes = content.size();
  }

  Result<MdpArrays> read() {
    while (!words_.peek().text.empty()) {
      if (!read_part()) return error_;
    }
    if (!discount_ || states_.count == 0 || actions_.count == 0) {
      return Error{path_, 0, 0, "expected discount, states and actions", ""};
    }
    content_.states = states_.count;
    content_.actions = actions_.count;
    content_.observations = observations_.count;
    MdpArrays arrays;
    if (const Result<void> done = cassandra::expand(content_, arrays); !done) {
      return Error{path_, 0, 0, done.error().expected, ""};
    }
    arrays.discount = *discount_;
    for (const auto& [state, weight] : start_) {
      arrays.start.push_back(state);
      arrays.start_probability.push_back(weight);
    }
    if (observations_.count > 0) arrays.remarks.push_back(seen());
    arrays.state_names = names(states_);
    arrays.action_names = names(actions_);
    return arrays;
  }

 private:
  bool fail(const Word& at, std::string expected, std::string near = "") {
    error_ = Error{path_, at.line, at.column, std::move(expected), std::move(near)};
    return false;
  }
  static std::string found(const Word& word) {
    if (word.text.empty()) return ", found the end of the file";
    const std::string_view shown = word.text.substr(0, longest_shown);
    return name_fault(shown).empty() ? ", found '" + std::string(shown) + "'" : "";
  }
  // The known name nearest to a word that is not a whole file by mistake.
  template <class Names>
  static std::string near(const Word& word, const Names& names) {
    return word.text.size() <= longest_shown ? nearest(word.text, names) : "";
  }

  bool read_part();
  bool take_colon();
  bool read_values();
  bool read_names(Listed& names);
  bool read_start();
  bool read_chances();
  bool read_listed(bool exclude);
  bool read_rule(char letter);
  bool read_levels(char letter, Rule& rule, int& levels);
  bool read_rule_values(char letter, Rule& rule, int levels);
  bool read_numbers(std::uint64_t count);
  bool read_number(double& number);
  bool read_index(const Listed& names, const char* what, bool wildcard, std::uint32_t& index);
  bool ends_list();

  static Names names(Listed& of) {
    return of.named ? of.index.take({}) : Names::numbered("", of.count);
  }
  std::string seen() {
    std::string text = counted(observations_.count, "observation");
    if (observations_.named) {
      text += " (";
      for (std::uint32_t i = 0; i < observations_.count && i < 10; ++i) {
        text += (i > 0 ? ", " : "") + std::string(observations_.index[i]);
      }
      text += observations_.count > 10 ? ", ...)" : ")";
    }
    return text + ": read as if the state were seen, they are not kept";
  }

  WordStream words_;
  const std::string& path_;
  cassandra::Content content_;
  Listed states_, actions_, observations_;
  std::optional<double> discount_;
  std::vector<std::pair<State, double>> start_;
  Error error_;
};

bool CassandraReader::take_colon() {
  const Word word = words_.next();
  return word.text == ":" || fail(word, "expected ':'" + found(word));
}

bool CassandraReader::read_part() {
  const Word word = words_.next();
  const std::string_view key = word.text;
  if (key == "start") return read_start();
  if (std::find(keywords.begin(), keywords.end(), key) == keywords.end()) {
    return fail(
        word,
        "expected discount, values, states, actions, observations, start, T, O or R" + found(word),
        near(word, keywords));
  }
  if (!take_colon()) return false;
  if (key == "values") return read_values();
  if (key == "states") return read_names(states_);
  if (key == "actions") return read_names(actions_);
  if (key == "observations") return read_names(observations_);
  if (key == "discount") {
    double discount = 0.0;
    if (!read_number(discount)) return false;
    discount_ = discount;
    return true;
  }
  if (states_.count == 0 || actions_.count == 0) {
    return fail(word, "expected states and actions before the first rule");
  }
  return read_rule(key.front());
}

bool CassandraReader::read_values() {
  const Word word = words_.next();
  content_.cost = word.text == "cost";
  return content_.cost || word.text == "reward" ||
         fail(word, "expected reward or cost" + found(word));
}

// A keyword with its colon, or the end, ends a list.
bool CassandraReader::ends_list() {
  WordStream ahead = words_;
  const Word word = ahead.next();
  if (word.text.empty()) return true;
  const bool start = word.text == "start";
  const std::string_view after = ahead.next().text;
  return std::find(keywords.begin(), keywords.end(), word.text) != keywords.end() &&
         (after == ":" || (start && (after == "include" || after == "exclude")));
}

bool CassandraReader::read_names(Listed& names) {
  const Word first = words_.peek();
  if (names.count > 0) return fail(first, "expected each list once");
  if (const auto count = parse_count(first.text)) {
    words_.next();
    if (*count == 0 || *count > max_states) {
      return fail(first, "expected a count from 1 to " + std::to_string(max_states) + found(first));
    }
    names.count = static_cast<std::uint32_t>(*count);
    return true;
  }
  names.named = true;
  while (!ends_list()) {
    const Word word = words_.next();
    const std::string_view fault = name_fault(word.text);
    if (!fault.empty()) return fail(word, std::string(fault));
    if (word.text == ":" || number_of(word.text))
      return fail(word, "expected a name" + found(word));
    if (names.index.insert(word.text) != names.count) {
      return fail(word, "expected each name once" + found(word));
    }
    ++names.count;
  }
  return names.count > 0 || fail(first, "expected a count or names" + found(first));
}

bool CassandraReader::read_number(double& number) {
  const Word word = words_.next();
  const auto value = number_of(word.text);
  number = value.value_or(0.0);
  return value.has_value() || fail(word, "expected a number" + found(word));
}

bool CassandraReader::read_index(const Listed& names, const char* what, bool wildcard,
                                 std::uint32_t& index) {
  const Word word = words_.next();
  index = any;
  if (word.text == "*" && wildcard) return true;
  if (const auto known = names.named ? names.index.find(word.text) : std::nullopt) {
    index = *known;
    return true;
  }
  const auto number = parse_count(word.text);
  if (number && *number < names.count) {
    index = static_cast<std::uint32_t>(*number);
    return true;
  }
  Nearest search(word.text.substr(0, longest_shown));
  for (std::uint32_t i = 0; names.named && i < names.count && i < 100'000; ++i)
    search.offer(names.index[i]);
  return fail(word, std::string("expected ") + what + found(word), search.best());
}

// "start: uniform", "start: STATE", "start: 0.5 0.5 ...", "start include: ...", "start exclude:
// ..."
bool CassandraReader::read_start() {
  const Word word = words_.next();
  if (states_.count == 0) return fail(word, "expected states before the start");
  start_.clear();
  if (word.text == "include" || word.text == "exclude") {
    return take_colon() && read_listed(word.text == "exclude");
  }
  if (word.text != ":") return fail(word, "expected ':', include or exclude" + found(word));
  WordStream ahead = words_;
  const std::string_view first = ahead.next().text;
  if (first == "uniform") {
    words_.next();
    return true;
  }
  const bool second = number_of(ahead.next().text).has_value();
  if (number_of(first) &&
      (second || !parse_count(first) || first.find('.') != std::string_view::npos)) {
    return read_chances();
  }
  std::uint32_t state = 0;
  if (!read_index(states_, "a state", false, state)) return false;
  start_.emplace_back(state, 1.0);
  return true;
}

bool CassandraReader::read_chances() {
  const Word at = words_.peek();
  double sum = 0.0;
  for (State s = 0; s < states_.count; ++s) {
    double chance = 0.0;
    if (!read_number(chance)) return false;
    if (!(chance >= 0.0 && chance <= 1.0)) {
      return fail(at, "expected start probabilities from 0 to 1, found " + shortest(chance));
    }
    sum += chance;
    if (chance != 0.0) start_.emplace_back(s, chance);
  }
  if (!(sum >= 1.0 - 1e-5 && sum <= 1.0 + 1e-5)) {
    return fail(at, "expected start probabilities whose sum is 1, found " + shortest(sum));
  }
  const bool exact = sum >= 1.0 - 1e-9 && sum <= 1.0 + 1e-9;
  for (auto& [state, chance] : start_) chance = exact ? chance : chance / sum;
  return true;
}

bool CassandraReader::read_listed(bool exclude) {
  const Word at = words_.peek();
  std::vector<State> listed;
  while (!ends_list()) {
    std::uint32_t state = 0;
    if (!read_index(states_, "a state", false, state)) return false;
    listed.push_back(state);
  }
  std::sort(listed.begin(), listed.end());
  listed.erase(std::unique(listed.begin(), listed.end()), listed.end());
  const std::size_t count = exclude ? states_.count - listed.size() : listed.size();
  if (count == 0) return fail(at, "expected at least one start state");
  if (std::uint64_t{states_.count} > (std::uint64_t{1} << 18) + 16 * content_.bytes) {
    return fail(at, "expected fewer states in a file of this size");
  }
  const double share = 1.0 / static_cast<double>(count);
  if (!exclude) {
    for (const State s : listed) start_.emplace_back(s, share);
    return true;
  }
  auto next = listed.begin();
  for (State s = 0; s < states_.count; ++s) {
    if (next != listed.end() && *next == s) {
      ++next;
    } else {
      start_.emplace_back(s, share);
    }
  }
  return true;
}

bool CassandraReader::read_rule(char letter) {
  Rule rule;
  const Word at = words_.peek();
  rule.line = at.line;
  if (letter == 'O' && observations_.count == 0) {
    return fail(at, "expected observations to be declared before O");
  }
  int levels = 0;
  if (!read_levels(letter, rule, levels) || !read_rule_values(letter, rule, levels)) return false;
  (letter == 'T'   ? content_.transitions
   : letter == 'O' ? content_.outputs
                   : content_.rewards)
      .add(rule);
  return true;
}

// "action", "action : state", ... as far as colons go on.
bool CassandraReader::read_levels(char letter, Rule& rule, int& levels) {
  const bool observed = observations_.count > 0;
  const int most = letter == 'R' && observed ? 4 : 3;
  if (!read_index(actions_, "an action or *", true, rule.action)) return false;
  for (levels = 1; levels < most && words_.peek().text == ":"; ++levels) {
    words_.next();
    const bool last = (letter == 'O' && levels == 2) || levels == 3;
    std::uint32_t& index = levels == 1 ? rule.from : levels == 2 ? rule.to : rule.last;
    if (!read_index(last ? observations_ : states_, last ? "an observation or *" : "a state or *",
                    true, index)) {
      return false;
    }
  }
  return true;
}

bool CassandraReader::read_rule_values(char letter, Rule& rule, int levels) {
  const bool observed_reward = letter == 'R' && observations_.count > 0;
  const int full = observed_reward ? 4 : 3;
  if (levels == full) return read_number(rule.value);
  const Word word = words_.peek();
  if (levels < full - 2) return fail(word, "expected ':' and a state" + found(word));
  const std::uint64_t width =
      letter == 'T' || (letter == 'R' && !observed_reward) ? states_.count : observations_.count;
  const bool matrix = levels == full - 2;
  if (letter != 'R' && word.text == "uniform") {
    words_.next();
    rule.kind = Rule::Kind::uniform;
    return true;
  }
  if (letter == 'T' && matrix && word.text == "identity") {
    words_.next();
    rule.kind = Rule::Kind::identity;
    return true;
  }
  if (!number_of(word.text)) {
    constexpr std::array<std::string_view, 2> words = {"uniform", "identity"};
    return fail(word,
                "expected numbers" + std::string(letter == 'R' ? "" : ", uniform or identity") +
                    found(word),
                letter == 'R' ? "" : near(word, words));
  }
  rule.kind = matrix ? Rule::Kind::matrix : Rule::Kind::row;
  rule.values = content_.numbers.size();
  return read_numbers(matrix ? width * states_.count : width);
}

bool CassandraReader::read_numbers(std::uint64_t count) {
  const Word at = words_.peek();
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto number = number_of(words_.peek().text);
    if (!number) {
      return fail(words_.peek(), "expected " + std::to_string(count) + " numbers from line " +
                                     std::to_string(at.line) + " on, found " + std::to_string(i));
    }
    words_.next();
    content_.numbers.push_back(*number);
  }
  return true;
}

}  // namespace

Result<MdpArrays> read_cassandra(std::string_view content, const std::string& path) {
  return CassandraReader(content, path).read();
}

}  // namespace quoll
