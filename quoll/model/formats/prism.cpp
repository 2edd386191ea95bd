// Transitions, and the whole model from its parts.

#include "quoll/model/formats/prism.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/fields.hpp"
#include "quoll/model/formats/numbered.hpp"
#include "quoll/model/formats/words.hpp"

namespace quoll {
namespace {

struct Row {
  std::uint64_t state = 0, choice = 0, next = 0;
  double probability = 0.0;
  std::string_view action;
};

/// A row that waits to be sorted.
struct KeptRow {
  std::uint32_t state, choice, next, action;
  double probability;
  std::uint64_t line;
};

class Transitions {
 public:
  Transitions(Lines& lines, const std::string& path)
      : lines_(lines), path_(path), count_(lines.count()), model_(count_) {
    limit_ = std::min<std::uint64_t>(max_states, 65'536 + 4 * count_);
  }

  Result<MdpArrays> read() {
    if (!read_header() || !read_rows() || !complete()) return error_;
    return model_.finish();
  }
  bool chain() const { return chain_; }

 private:
  bool fail(std::size_t column, std::string expected, std::string near = "") {
    return fail_at(lines_.number(), column, std::move(expected), std::move(near));
  }
  bool fail_at(std::uint64_t line, std::size_t column, std::string expected,
               std::string near = "") {
    error_ = {path_, line, column, std::move(expected), std::move(near)};
    return false;
  }

  // The next line that is neither empty nor a comment.
  bool next_line() {
    while (lines_.next(line_)) {
      words_.split(line_);
      if (words_.count > 0 && words_[0].front() != '#') return true;
    }
    return false;
  }

  bool read_header() {
    if (!next_line()) {
      if (!lines_.error().empty()) return fail(0, lines_.error());
      return fail(0, "expected a first line 'states choices transitions', or 'mdp'");
    }
    header_line_ = lines_.number();
    if (!parse_index(words_[0])) return read_kind();
    if (words_.count != 2 && words_.count != 3) {
      return fail(1,
                  "expected 'states choices transitions' of an MDP or 'states transitions' of a "
                  "DTMC, found " +
                      counted(words_.count, "word"));
    }
    std::array<std::uint64_t, 3> numbers{};
    for (std::size_t i = 0; i < words_.count; ++i) {
      const auto number = parse_index(words_[i]);
      if (!number) return fail(words_.column(line_, i), "expected a number, as in the first line");
      numbers[i] = *number;
    }
    chain_ = words_.count == 2;
    declared_states_ = numbers[0];
    if (!chain_) declared_choices_ = numbers[1];
    declared_outcomes_ = numbers[words_.count - 1];
    if (numbers[0] == 0 || numbers[0] > limit_) {
      return fail(1, "expected a number of states that the " + counted(count_, "line") +
                         " of this file can hold, found " + std::string(words_[0]));
    }
    limit_ = numbers[0];
    return true;
  }

  // The first line of Storm's dialect.
  bool read_kind() {
    static constexpr std::array<std::string_view, 2> kinds = {"mdp", "dtmc"};
    if (words_.count == 1 && (words_[0] == "mdp" || words_[0] == "dtmc")) {
      chain_ = words_[0] == "dtmc";
      return true;
    }
    return fail(1,
                "expected 'mdp', 'dtmc' or 'states choices transitions', found '" +
                    std::string(words_[0]) + "'",
                nearest(words_[0], kinds));
  }

  // Rows in order go straight to the model; from others the file is read again and sorted.
  bool read_rows() {
    while (next_line()) {
      Row row;
      if (!parse(row)) return false;
      if (last_ && std::pair(row.state, row.choice) < *last_) return read_sorted();
      last_ = {row.state, row.choice};
      if (!put(row, lines_.number())) return false;
    }
    return lines_.error().empty() || fail(0, lines_.error());
  }

  bool read_sorted() {
    lines_.count();  // begins at the front again
    next_line();
    NameIndex names;
    names.insert("");
    std::vector<KeptRow> rows;
    while (next_line()) {
      Row row;
      if (!parse(row)) return false;
      rows.push_back({static_cast<std::uint32_t>(row.state), static_cast<std::uint32_t>(row.choice),
                      static_cast<std::uint32_t>(row.next), names.insert(row.action),
                      row.probability, lines_.number()});
    }
    if (!lines_.error().empty()) return fail(0, lines_.error());
    std::stable_sort(rows.begin(), rows.end(), [](const KeptRow& a, const KeptRow& b) {
      return std::pair(a.state, a.choice) < std::pair(b.state, b.choice);
    });
    model_ = NumberedModel(rows.size());
    in_choice_ = false;
    for (const KeptRow& kept : rows) {
      const Row row{kept.state, kept.choice, kept.next, kept.probability, names[kept.action]};
      if (!put(row, kept.line)) return false;
    }
    return true;
  }

  // "state choice successor probability [action]", without the choice in a chain.
  bool parse(Row& row) {
    const std::size_t needed = chain_ ? 3 : 4;
    if (words_.count != needed && words_.count != needed + 1) {
      return fail(1, std::string("expected ") +
                         (chain_ ? "'state successor probability'"
                                 : "'state choice successor probability'") +
                         " and perhaps an action, found " + counted(words_.count, "word"));
    }
    std::size_t at = 0;
    if (!index(at++, limit_, "state", row.state)) return false;
    if (!chain_ && !index(at++, no_action, "choice", row.choice)) return false;
    if (!index(at++, limit_, "successor", row.next)) return false;
    const auto probability = parse_short_number(words_[at]);
    if (!probability) {
      const bool interval = words_[at].front() == '[';
      return fail(words_.column(line_, at),
                  interval ? "expected a probability, found an interval: models of intervals "
                             "cannot be read"
                           : "expected a probability, found '" + std::string(words_[at]) + "'");
    }
    row.probability = *probability;
    row.action = words_.count > needed ? words_[needed] : std::string_view();
    return true;
  }

  bool index(std::size_t word, std::uint64_t end, const char* what, std::uint64_t& value) {
    const auto number = parse_index(words_[word]);
    if (number && *number < end) {
      value = *number;
      return true;
    }
    return fail(words_.column(line_, word), std::string("expected the number of a ") + what +
                                                " below " + std::to_string(end) + ", found '" +
                                                std::string(words_[word]) + "'");
  }

  bool put(const Row& row, std::uint64_t line) {
    const bool same_state = in_choice_ && model_.states() == row.state + 1;
    if (!same_state || row.choice + 1 != model_.choices_of_state()) {
      while (model_.states() <= row.state) model_.open_state();
      if (row.choice != model_.choices_of_state()) {
        return fail_at(line, 0,
                       "expected choice " + std::to_string(model_.choices_of_state()) +
                           " of state " + std::to_string(row.state) + ", found choice " +
                           std::to_string(row.choice));
      }
      model_.open_choice(row.action, line);
      action_ = row.action;
      in_choice_ = true;
    } else if (!chain_ && row.action != action_) {
      return fail_at(line, 0,
                     "expected action '" + action_ + "' as above for choice " +
                         std::to_string(row.choice) + " of state " + std::to_string(row.state) +
                         ", found '" + std::string(row.action) + "'");
    }
    largest_ = std::max({largest_, row.state, row.next});
    model_.add(static_cast<State>(row.next), row.probability);
    return true;
  }

  bool complete() {
    if (model_.outcomes() == 0) return fail(0, "expected at least one transition");
    const std::uint64_t states = declared_states_.value_or(largest_ + 1);
    const auto as_declared = [&](std::optional<std::uint64_t> declared, std::uint64_t found,
                                 const char* noun) {
      if (!declared || *declared == found) return true;
      return fail_at(
          header_line_, 0,
          "expected " + counted(*declared, noun) + " as this line says, found " + grouped(found));
    };
    if (!as_declared(declared_outcomes_, model_.outcomes(), "transition")) return false;
    if (!as_declared(declared_choices_, model_.choices(), "choice")) return false;
    while (model_.states() < states) model_.open_state();
    return true;
  }

  Lines& lines_;
  const std::string& path_;
  std::uint64_t count_;  // lines of the file
  NumberedModel model_;
  std::uint64_t limit_ = 0;  // states the file may have
  std::string_view line_;
  Words words_;
  bool chain_ = false;
  std::uint64_t header_line_ = 0;
  std::optional<std::uint64_t> declared_states_, declared_choices_, declared_outcomes_;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> last_;
  bool in_choice_ = false;
  std::string action_;  // of the last choice
  std::uint64_t largest_ = 0;
  Error error_;
};

// Rewards of states become part of each choice, as R [F goal] counts them.
void place(PrismRewards& rewards, MdpArrays& a, std::vector<double>& reward,
           std::vector<double>& outcome_reward) {
  const std::size_t states = a.choice_begin.size() - 1;
  if (!rewards.state.empty()) {
    rewards.outcome.empty() ? reward.assign(a.action.size(), 0.0) : reward.clear();
    for (std::size_t s = 0; s < states; ++s) {
      const double of_state = rewards.state[s];
      for (std::uint64_t c = a.choice_begin[s]; c < a.choice_begin[s + 1]; ++c) {
        if (rewards.outcome.empty()) reward[c] = of_state;
        for (std::uint64_t o = a.outcome_begin[c];
             o < a.outcome_begin[c + 1] && !rewards.outcome.empty(); ++o) {
          rewards.outcome[o] += of_state;
        }
      }
    }
  }
  if (!rewards.outcome.empty()) reward.clear();
  outcome_reward = std::move(rewards.outcome);
}

void remark_on(const PrismRewards& rewards, MdpArrays& a) {
  if (rewards.state.empty()) return;
  const std::string name = rewards.name.empty() ? "the rewards" : "the rewards " + rewards.name;
  a.remarks.push_back(name + " of states are part of every choice of their state");
  for (std::size_t s = 0; s + 1 < a.choice_begin.size(); ++s) {
    if (rewards.state[s] == 0.0 || a.choice_begin[s] != a.choice_begin[s + 1]) continue;
    a.remarks.push_back(name + " of states without a choice, as of " + a.state_names[s] +
                        ", count for nothing");
    return;
  }
}

void place_all(std::vector<PrismRewards>& gathered, MdpArrays& a) {
  for (std::size_t i = 0; i < gathered.size(); ++i) {
    PrismRewards& rewards = gathered[i];
    remark_on(rewards, a);
    if (i == 0) {
      a.reward_name = rewards.name;
      place(rewards, a, a.reward, a.outcome_reward);
      continue;
    }
    RewardStructure other{rewards.name, std::vector<double>(a.action.size(), 0.0), {}};
    place(rewards, a, other.reward, other.outcome_reward);
    a.other_rewards.push_back(std::move(other));
  }
}

}  // namespace

Result<MdpArrays> read_prism_parts(Lines& transitions, const std::string& path,
                                   std::vector<PrismPart>& parts) {
  Transitions reader(transitions, path);
  Result<MdpArrays> arrays = reader.read();
  if (!arrays) return arrays;
  arrays->state_names = Names::numbered("", arrays->choice_begin.size() - 1);
  arrays->start = {0};
  std::vector<PrismRewards> gathered;
  for (PrismPart& part : parts) {
    const Result<void> read = part.kind == PrismPart::Kind::states
                                  ? read_prism_states(part, *arrays)
                              : part.kind == PrismPart::Kind::labels
                                  ? read_prism_labels(part, *arrays)
                                  : read_prism_rewards(part, *arrays, reader.chain(), gathered);
    if (!read) return read.error();
    if (!part.lines.error().empty()) {
      return Error{part.path, part.lines.number(), 0, part.lines.error(), ""};
    }
  }
  place_all(gathered, *arrays);
  return arrays;
}

Result<MdpArrays> read_prism(std::string_view content, const std::string& path,
                             const Parameters& given) {
  Result<std::vector<PrismPart>> parts = prism_parts(path, given, false);
  if (!parts) return parts.error();
  Lines transitions(content);
  return read_prism_parts(transitions, path, *parts);
}

Result<MdpArrays> read_prism_path(const std::string& path, const Parameters& given) {
  Result<Lines> transitions = Lines::open(path);
  if (!transitions) return transitions.error();
  Result<std::vector<PrismPart>> parts = prism_parts(path, given, true);
  if (!parts) return parts.error();
  return read_prism_parts(*transitions, path, *parts);
}

}  // namespace quoll
