// Rewards of states and of transitions.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/fields.hpp"
#include "quoll/model/formats/prism.hpp"
#include "quoll/model/formats/words.hpp"

namespace quoll {
namespace {

class Rewards {
 public:
  Rewards(PrismPart& part, const MdpArrays& arrays, bool chain, std::vector<PrismRewards>& gathered)
      : part_(part),
        a_(arrays),
        states_(arrays.choice_begin.size() - 1),
        of_transition_(chain ? 3 : 4),
        gathered_(gathered) {}

  Result<void> read() {
    std::string_view line;
    bool first = true;
    while (part_.lines.next(line)) {
      line_ = line;
      words_.split(line);
      if (words_.count == 0) continue;
      if (words_[0].front() == '#') {
        if (first) read_comment();
        continue;
      }
      const bool header = first && is_header();
      first = false;
      if (header) continue;
      const Result<void> read = read_row();
      if (!read) return read;
    }
    if (part_.lines.error().empty() && declared_ && *declared_ != rows_) {
      return Error{part_.path, header_line_, 0,
                   "expected " + counted(*declared_, "reward") + " as this line says, found " +
                       grouped(rows_),
                   ""};
    }
    structure();
    return {};
  }

 private:
  Error fault(std::size_t word, std::string expected) const {
    return {part_.path, part_.lines.number(), words_.column(line_, word), std::move(expected), ""};
  }

  // # Reward structure: "time"
  void read_comment() {
    const std::size_t open = line_.find('"');
    const std::size_t close = line_.rfind('"');
    if (line_.find("eward structure") == std::string_view::npos || open == close) return;
    part_.name = std::string(line_.substr(open + 1, close - open - 1));
  }

  // "states rewards" or "states choices rewards": the number of states is the number of none.
  bool is_header() {
    const auto states = parse_index(words_[0]);
    const auto rewards = words_.count <= 3 ? parse_index(words_[words_.count - 1]) : std::nullopt;
    if (!states || *states != states_ || !rewards || words_.count < 2) return false;
    declared_ = *rewards;
    header_line_ = part_.lines.number();
    return true;
  }

  Result<void> read_row() {
    ++rows_;
    if (words_.count != 2 && words_.count != of_transition_) {
      return fault(0, std::string("expected 'state reward' or '") +
                          (of_transition_ == 3 ? "state successor reward"
                                               : "state choice successor reward") +
                          "', found " + counted(words_.count, "word"));
    }
    const auto state = parse_index(words_[0]);
    if (!state || *state >= states_) {
      return fault(0, "expected the number of a state below " + std::to_string(states_) +
                          ", found '" + std::string(words_[0]) + "'");
    }
    const std::size_t last = words_.count - 1;
    const auto reward = parse_short_number(words_[last]);
    if (!reward || !std::isfinite(*reward)) {
      return fault(last, "expected a finite reward, found '" + std::string(words_[last]) + "'");
    }
    PrismRewards& to = structure();
    if (words_.count > 2) return of_transition(to, *state, *reward);
    if (to.state.empty()) to.state.assign(states_, 0.0);
    to.state[*state] += *reward;
    return {};
  }

  Result<void> of_transition(PrismRewards& to, std::uint64_t state, double reward) {
    const bool chain = of_transition_ == 3;
    const auto choice = chain ? std::optional<std::uint64_t>(0) : parse_index(words_[1]);
    const std::uint64_t choices = a_.choice_begin[state + 1] - a_.choice_begin[state];
    if (!choice || *choice >= choices) {
      return fault(1, "expected a choice of state " + std::to_string(state) + ", which has " +
                          std::to_string(choices) + ", found '" + std::string(words_[1]) + "'");
    }
    const auto next = parse_index(words_[chain ? 1 : 2]);
    open(a_.choice_begin[state] + *choice);
    if (to.outcome.empty()) to.outcome.assign(a_.next.size(), 0.0);
    const auto before = [](const auto& one, std::uint64_t wanted) { return one.first < wanted; };
    bool found = false;
    for (auto it = std::lower_bound(successors_.begin(), successors_.end(),
                                    next.value_or(no_action), before);
         it != successors_.end() && it->first == next; ++it) {
      to.outcome[it->second] += reward;
      found = true;
    }
    if (found) return {};
    return fault(chain ? 1 : 2, "expected a successor of state " + std::to_string(state) +
                                    (chain ? "" : ", choice " + std::to_string(*choice)) +
                                    ", found '" + std::string(words_[chain ? 1 : 2]) + "'");
  }

  // The successors of a choice, in order.
  void open(std::uint64_t choice) {
    if (choice == choice_) return;
    choice_ = choice;
    successors_.clear();
    for (std::uint64_t o = a_.outcome_begin[choice]; o < a_.outcome_begin[choice + 1]; ++o) {
      successors_.emplace_back(a_.next[o], o);
    }
    std::sort(successors_.begin(), successors_.end());
  }

  // Where the rewards of this name are gathered.
  PrismRewards& structure() {
    for (PrismRewards& one : gathered_) {
      if (one.name == part_.name) return one;
    }
    gathered_.push_back({part_.name, {}, {}});
    return gathered_.back();
  }

  PrismPart& part_;
  const MdpArrays& a_;
  std::uint64_t states_;
  std::size_t of_transition_;  // words in a row about a transition
  std::vector<PrismRewards>& gathered_;
  std::string_view line_;
  Words words_;
  std::uint64_t choice_ = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::pair<State, std::uint64_t>> successors_;  // of that choice, with outcomes
  std::optional<std::uint64_t> declared_;
  std::uint64_t header_line_ = 0;
  std::uint64_t rows_ = 0;
};

}  // namespace

Result<void> read_prism_rewards(PrismPart& part, const MdpArrays& arrays, bool chain,
                                std::vector<PrismRewards>& gathered) {
  return Rewards(part, arrays, chain, gathered).read();
}

}  // namespace quoll
