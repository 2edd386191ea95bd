#pragma once
// Cassandra's text format for (partially observed) decision processes, .pomdp and .mdp: pomdp.org,
// "POMDP File Format" and "POMDP File Grammar". What the lines of a file say, and the arrays that
// follow from them.

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll::cassandra {

struct Word {
  std::string_view text;  ///< ":" is a word of its own; empty = the end of the file
  std::uint64_t line = 0, column = 0;
};

/// The words of a text, between blanks, line ends, colons and comments.
class WordStream {
 public:
  explicit WordStream(std::string_view text) : text_(text) {}

  Word next() {
    bool comment = false;
    while (at_ < text_.size() && (comment || text_[at_] == '#' || blank(text_[at_]))) {
      if (text_[at_] == '\n') {
        ++line_;
        line_begin_ = at_ + 1;
      }
      comment = text_[at_] != '\n' && (comment || text_[at_] == '#');
      ++at_;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != ':' && text_[at_] != '#' && !blank(text_[at_]))
      ++at_;
    if (begin == at_ && at_ < text_.size()) ++at_;  // the colon
    return {text_.substr(begin, at_ - begin), line_, begin - line_begin_ + 1};
  }
  Word peek() const { return WordStream(*this).next(); }

 private:
  static bool blank(char letter) {
    return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n';
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 1;
  std::size_t line_begin_ = 0;
};

inline constexpr std::uint32_t any = std::numeric_limits<std::uint32_t>::max();  ///< '*'

/// "T: action : from : to number", "T: action : from row" or "T: action matrix". Observations have
/// the state that follows as `from`, the observation as `to`. Rewards have one level more, the
/// observation as `last`, and so no form by action alone; without observations they are as T.
struct Rule {
  enum class Kind : std::uint8_t { number, uniform, identity, row, matrix };
  Kind kind = Kind::number;
  std::uint32_t action = any, from = any, to = any, last = any;
  double value = 0.0;        ///< of a number
  std::uint64_t values = 0;  ///< of a row or matrix: where its numbers begin
  std::uint64_t line = 0;
};

/// The rules of one letter in the order of the file; a later one overrides earlier ones.
class Rules {
 public:
  void add(const Rule& rule) { rules_.push_back(rule); }
  /// Makes the rules findable; none may be added afterwards.
  void index();
  /// Those that speak of this action and state, the last one first, until `complete(rule)`: that
  /// one, which leaves nothing to earlier ones, is the last in the list.
  template <class Complete>
  void latest(std::uint32_t action, std::uint32_t from, std::vector<const Rule*>& list,
              Complete complete) const {
    list.clear();
    Range ranges[] = {range(action, from), range(action, any), range(any, from), range(any, any)};
    while (true) {
      Range* best = nullptr;
      for (Range& r : ranges) {
        if (r.first != r.second && (!best || r.second[-1].second > best->second[-1].second))
          best = &r;
      }
      if (!best) return;
      list.push_back(&rules_[(--best->second)->second]);
      if (complete(*list.back())) return;
    }
  }

 private:
  using Key = std::pair<std::uint64_t, std::uint32_t>;  // action and state, number of the rule
  using Range = std::pair<const Key*, const Key*>;
  Range range(std::uint32_t action, std::uint32_t from) const;

  std::vector<Rule> rules_;
  std::vector<Key> keys_;
};

/// What a file says.
struct Content {
  std::uint32_t states = 0, actions = 0;
  std::uint32_t observations = 0;  ///< 0 = not declared
  bool cost = false;
  Rules transitions, outputs, rewards;
  std::vector<double> numbers;  ///< of rows and matrices
  std::uint64_t bytes = 0;      ///< of the file
};

/// Fills the arrays of choices and outcomes; the rewards are expectations over the observations.
/// Rows that sum to 1 only within 1e-5, as files with few digits do, are rescaled with a remark.
/// Fails when wildcards make more of a small file than its size justifies.
Result<void> expand(Content& content, MdpArrays& arrays);

}  // namespace quoll::cassandra
