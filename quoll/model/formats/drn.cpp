// Storm's DRN: one file with everything, https://www.stormchecker.org/documentation/background/drn.

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/fields.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/lines.hpp"
#include "quoll/model/formats/numbered.hpp"
#include "quoll/model/formats/words.hpp"
#include "quoll/model/letters.hpp"

namespace quoll {
namespace {

constexpr std::array<std::string_view, 8> sections = {
    "@type:",         "@value_type:", "@parameters", "@placeholders",
    "@reward_models", "@nr_states",   "@nr_choices", "@model"};

class DrnReader {
 public:
  DrnReader(Lines& lines, const std::string& path)
      : lines_(lines), path_(path), count_(lines.count()), model_(count_) {}

  Result<MdpArrays> read() {
    if (!read_header() || !read_body() || !complete()) return error_;
    return finish();
  }

 private:
  bool fail(std::string expected, std::string near = "") {
    error_ = {path_, lines_.number(), 0, std::move(expected), std::move(near)};
    return false;
  }
  bool fail_at(std::string_view part, std::string expected) {
    fail(std::move(expected));
    error_.column = static_cast<std::size_t>(part.data() - line_.data()) + 1;
    return false;
  }

  // The next line, whatever it holds.
  bool next_line() {
    const bool more = lines_.next(line_);
    text_ = more ? trim(line_) : std::string_view();
    if (!more && !lines_.error().empty()) fail(lines_.error());
    return more;
  }
  bool is_comment() const { return text_.empty() || text_.starts_with("//"); }

  bool read_header() {
    while (next_line()) {
      if (is_comment()) continue;
      if (text_ == "@model") return true;
      if (!read_section()) return false;
    }
    return lines_.error().empty() ? fail("expected @model and the states below it") : false;
  }

  bool read_section() {
    const std::string_view name = text_.substr(0, text_.find_first_of(" \t"));
    if (name == "@type:") return read_type();
    if (name == "@value_type:") return read_value_type();
    if (name == "@parameters") {
      next_line();
      return text_.empty() || fail("expected no parameters: parametric models cannot be read");
    }
    if (name == "@placeholders") return fail("expected numbers instead of placeholders");
    if (name == "@reward_models") return read_reward_names();
    if (name == "@nr_states") return read_count(nr_states_);
    if (name == "@nr_choices") return read_count(nr_choices_);
    return fail(
        "expected one of @type:, @value_type:, @parameters, @reward_models, @nr_states, "
        "@nr_choices and @model, found '" +
            std::string(name) + "'",
        nearest(name, sections));
  }

  bool read_type() {
    std::string type(trim(text_.substr(6)));
    for (char& letter : type) {
      if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    }
    return type == "MDP" || type == "DTMC" ||
           fail("expected @type: MDP or DTMC, found '" + type + "'");
  }

  bool read_value_type() {
    const std::string_view type = trim(text_.substr(12));
    return type == "double" || type == "rational" ||
           fail("expected @value_type: double or rational, found '" + std::string(type) + "'");
  }

  bool read_reward_names() {
    next_line();
    for (std::string_view rest = text_; !rest.empty();) {
      const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
      reward_names_.emplace_back(rest.substr(0, end));
      rest = trim(rest.substr(end));
    }
    return true;
  }

  // Every state and choice takes a line.
  bool read_count(std::optional<std::uint64_t>& count) {
    next_line();
    count = parse_index(text_);
    if (count && *count > 0 && *count <= std::min<std::uint64_t>(count_, max_states)) return true;
    return fail("expected a number that the " + counted(count_, "line") +
                " of this file can hold, found '" + std::string(text_) + "'");
  }

  bool read_body() {
    if (!nr_states_) return fail("expected @nr_states above @model");
    bool after_state = false;
    while (next_line()) {
      if (is_comment()) {
        if (after_state) read_name();
        after_state = false;
        continue;
      }
      after_state = text_.starts_with("state ");
      const bool read = after_state                    ? read_state()
                        : text_.starts_with("action ") ? read_action()
                                                       : read_outcome();
      if (!read) return false;
    }
    return lines_.error().empty();
  }

  // The comment below a state: "//[x=1 & y=2]" as Storm writes it, or "// NAME".
  void read_name() {
    if (names_.size() + 1 != model_.states()) return;
    const std::size_t mark = line_.find("//");
    if (mark == std::string_view::npos) return;
    const std::string_view rest = line_.substr(mark + 2);
    std::string name;
    if (rest.starts_with('[') && trim(rest).ends_with(']')) {
      const std::string_view inside = trim(rest).substr(1, trim(rest).size() - 2);
      for (const std::string_view pair : split(inside, '&')) {
        name += (name.empty() ? "(" : ",") + std::string(pair);
      }
      name += ")";
    } else if (rest.starts_with(' ')) {
      name = rest.substr(1);
    }
    if (name_fault(name).empty()) names_.push_back(name);
  }

  // state 0 [1,2] init "my label"
  bool read_state() {
    std::string_view rest = trim(text_.substr(6));
    const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
    const auto number = parse_index(rest.substr(0, end));
    if (!number || *number != model_.states() || *number >= *nr_states_) {
      return fail_at(rest, "expected state " + std::to_string(model_.states()) + " of " +
                               std::to_string(*nr_states_) + ", found '" +
                               std::string(rest.substr(0, end)) + "'");
    }
    model_.open_state();
    in_choice_ = false;
    rest = trim(rest.substr(end));
    if (rest.starts_with('!') || rest.starts_with('{')) {
      return fail_at(rest, "expected rewards in square brackets or labels, found '" +
                               std::string(rest.substr(0, 1)) + "'");
    }
    of_state_.clear();
    return read_rewards(rest, of_state_) && read_labels(rest);
  }

  bool read_labels(std::string_view rest) {
    while (!rest.empty()) {
      std::size_t begin = 0;
      std::size_t end = std::min(rest.find_first_of(" \t\""), rest.size());
      if (rest.front() == '"') {
        begin = 1;
        end = rest.find('"', 1);
        if (end == std::string_view::npos) return fail_at(rest, "expected a second '\"'");
      }
      const std::string_view name = rest.substr(begin, end - begin);
      if (const std::string_view reason = name_fault(name); !reason.empty()) {
        return fail_at(rest, std::string(reason));
      }
      const std::uint32_t label = label_names_.insert(name);
      if (label == labels_.size()) labels_.push_back({std::string(name), {}});
      const auto state = static_cast<State>(model_.states() - 1);
      std::vector<State>& states = labels_[label].states;
      if (states.empty() || states.back() != state) states.push_back(state);
      rest = trim(rest.substr(std::min(end + begin, rest.size())));
    }
    return true;
  }

  // action go [1,2]
  bool read_action() {
    if (model_.states() == 0) return fail("expected a state above the first action");
    std::string_view rest = trim(text_.substr(7));
    const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
    const std::string_view name = rest.substr(0, end);
    if (const std::string_view reason = name_fault(name); !reason.empty()) {
      return fail_at(rest, std::string(reason));
    }
    open_choice(name == "__NOLABEL__" ? std::string_view() : name);
    rest = trim(rest.substr(end));
    of_action_.clear();
    if (!read_rewards(rest, of_action_)) return false;
    if (!rest.empty()) return fail_at(rest, "expected nothing behind the rewards");
    add_rewards(of_action_);
    return true;
  }

  void open_choice(std::string_view name) {
    model_.open_choice(name, lines_.number());
    in_choice_ = true;
    add_rewards(of_state_);
  }

  // Rewards of the last choice. The lists of a structure end at its last choice that has some.
  void add_rewards(const std::vector<double>& rewards) {
    if (rewards.size() > rewards_.size()) rewards_.resize(rewards.size());
    for (std::size_t i = 0; i < rewards.size(); ++i) {
      if (rewards[i] == 0.0) continue;
      rewards_[i].resize(model_.choices(), 0.0);
      rewards_[i].back() += rewards[i];
    }
  }

  // "[1, 1/3]" at the front of `rest`, if there is one.
  bool read_rewards(std::string_view& rest, std::vector<double>& rewards) {
    if (!rest.starts_with('[')) return true;
    const std::size_t close = rest.find(']');
    if (close == std::string_view::npos) return fail_at(rest, "expected ']' behind the rewards");
    constexpr std::size_t most = 1000;
    for (const std::string_view word : split(rest.substr(1, close - 1), ',')) {
      const auto number = parse_short_number(word);
      if (!number || !(*number - *number == 0.0) || rewards.size() == most) {
        return fail_at(word, "expected a finite reward, found '" + std::string(word) + "'");
      }
      rewards.push_back(*number);
    }
    rest = trim(rest.substr(close + 1));
    return true;
  }

  // 7 : 0.5
  bool read_outcome() {
    const std::size_t colon = text_.find(':');
    if (colon == std::string_view::npos || model_.states() == 0) {
      return fail_at(
          text_, "expected 'state NUMBER', 'action NAME' or 'SUCCESSOR : PROBABILITY', found '" +
                     std::string(text_.substr(0, 60)) + "'");
    }
    const std::string_view target = trim(text_.substr(0, colon));
    const auto next = parse_index(target);
    if (!next || *next >= *nr_states_) {
      return fail_at(text_, "expected the number of a successor below " +
                                std::to_string(*nr_states_) + ", found '" + std::string(target) +
                                "'");
    }
    const std::string_view value = trim(text_.substr(colon + 1));
    const auto probability = parse_short_number(value);
    if (!probability) {
      return fail_at(value, value.starts_with('[')
                                ? "expected a probability, found an interval: models of "
                                  "intervals cannot be read"
                                : "expected a probability, found '" + std::string(value) + "'");
    }
    if (!in_choice_) open_choice("");
    model_.add(static_cast<State>(*next), *probability);
    return true;
  }

  bool complete() {
    if (model_.states() != *nr_states_) {
      return fail("expected " + counted(*nr_states_, "state") + " as @nr_states says, found " +
                  grouped(model_.states()));
    }
    // A chain may count its states without choices, too.
    if (nr_choices_ && model_.choices() > *nr_choices_) {
      return fail("expected " + counted(*nr_choices_, "choice") + " as @nr_choices says, found " +
                  grouped(model_.choices()));
    }
    return true;
  }

  Result<MdpArrays> finish() {
    MdpArrays a = model_.finish();
    const std::size_t states = a.choice_begin.size() - 1;
    a.state_names = names_.size() == states ? std::move(names_) : Names::numbered("", states);
    a.start = {0};
    for (Label& label : labels_) {
      if (label.name == "init") {
        a.start = std::move(label.states);
      } else {
        a.labels.push_back(std::move(label));
      }
    }
    rewards_.resize(std::max(rewards_.size(), reward_names_.size()));
    for (std::size_t i = 0; i < rewards_.size(); ++i) {
      rewards_[i].resize(a.action.size(), 0.0);
      std::string name = i < reward_names_.size() ? reward_names_[i] : "rew" + std::to_string(i);
      if (i == 0) {
        a.reward_name = std::move(name);
        a.reward = std::move(rewards_[i]);
      } else {
        a.other_rewards.push_back({std::move(name), std::move(rewards_[i]), {}});
      }
    }
    return a;
  }

  Lines& lines_;
  const std::string& path_;
  std::uint64_t count_;  // lines of the file
  NumberedModel model_;
  std::string_view line_, text_;  // the line, and without blanks around it
  std::optional<std::uint64_t> nr_states_, nr_choices_;
  std::vector<std::string> reward_names_;
  std::vector<std::vector<double>> rewards_;  // per structure, per choice
  std::vector<double> of_state_, of_action_;
  bool in_choice_ = false;
  Names names_;
  NameIndex label_names_;
  std::vector<Label> labels_;
  Error error_;
};

}  // namespace

Result<MdpArrays> read_drn(std::string_view content, const std::string& path) {
  Lines lines(content);
  return DrnReader(lines, path).read();
}

Result<MdpArrays> read_drn_path(const std::string& path, const Parameters&) {
  auto lines = Lines::open(path);
  if (!lines) return lines.error();
  return DrnReader(*lines, path).read();
}

}  // namespace quoll
