// States with the values of their variables, and labels.

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/numbered.hpp"
#include "quoll/model/formats/prism.hpp"
#include "quoll/model/formats/words.hpp"
#include "quoll/model/letters.hpp"

namespace quoll {
namespace {

Error fault(const PrismPart& part, std::size_t column, std::string expected,
            std::string near = "") {
  return {part.path, part.lines.number(), column, std::move(expected), std::move(near)};
}

// What stands between the first '(' and the last ')' of a line.
std::optional<std::string_view> in_brackets(std::string_view line) {
  const std::size_t open = line.find('(');
  const std::size_t close = line.rfind(')');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) {
    return std::nullopt;
  }
  return line.substr(open + 1, close - open - 1);
}

// "7: rest": the number of a state and what follows.
Result<State> leading_state(const PrismPart& part, std::string_view line, std::uint64_t states,
                            std::string_view& rest) {
  const std::size_t end = line.find_first_of(": \t");
  const auto number = parse_index(line.substr(0, end));
  if (!number || *number >= states) {
    return fault(part, 1,
                 "expected the number of a state below " + std::to_string(states) + ", found '" +
                     std::string(line.substr(0, end)) + "'");
  }
  rest = end == std::string_view::npos ? std::string_view() : line.substr(end);
  if (!rest.empty() && rest.front() == ':') rest.remove_prefix(1);
  return static_cast<State>(*number);
}

class Labels {
 public:
  Labels(PrismPart& part, MdpArrays& arrays)
      : part_(part), a_(arrays), states_(arrays.choice_begin.size() - 1) {}

  Result<void> read() {
    std::string_view line;
    bool declared = false, storm = false;
    while (part_.lines.next(line)) {
      const std::string_view text = trim(line);
      if (text.empty()) continue;
      Result<void> read;
      if (text == "#DECLARATION") {
        storm = declared = true;
        read = declare_words();
      } else if (text.front() == '#') {
        continue;
      } else if (!declared) {
        declared = true;
        read = declare(text);
      } else {
        read = storm ? words_of_state(text) : numbers_of_state(text);
      }
      if (!read) return read;
    }
    if (!declared && part_.lines.error().empty()) {
      return fault(part_, 0, "expected labels, as in 0=\"init\" 1=\"goal\"");
    }
    hand_over();
    return {};
  }

 private:
  Result<void> add(std::uint64_t number, std::string_view name) {
    if (const std::string_view reason = name_fault(name); !reason.empty()) {
      return fault(part_, 0, std::string(reason));
    }
    for (const auto& [known, label] : labels_) {
      if (known == number) {
        return fault(part_, 0, "expected one label of number " + std::to_string(number));
      }
      if (label.name == name) {
        return fault(part_, 0, "expected the label " + std::string(name) + " once");
      }
    }
    labels_.push_back({number, {std::string(name), {}}});
    return {};
  }

  // 0="init" 1="deadlock"
  Result<void> declare(std::string_view text) {
    while (!text.empty()) {
      const std::size_t open = text.find("=\"");
      const std::size_t close = open == std::string_view::npos ? open : text.find('"', open + 2);
      const auto number = parse_index(text.substr(0, open));
      if (!number || close == std::string_view::npos) {
        return fault(part_, 0, "expected labels, as in 0=\"init\" 1=\"goal\"");
      }
      const Result<void> added = add(*number, text.substr(open + 2, close - open - 2));
      if (!added) return added;
      text = trim(text.substr(close + 1));
    }
    return {};
  }

  // The names between #DECLARATION and #END.
  Result<void> declare_words() {
    std::string_view line;
    while (part_.lines.next(line)) {
      std::string_view text = trim(line);
      if (text == "#END") return {};
      while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
        const Result<void> added = add(labels_.size(), text.substr(0, end));
        if (!added) return added;
        text = trim(text.substr(end));
      }
    }
    return fault(part_, 0, "expected #END below the labels");
  }

  template <class Find>
  Result<void> each_word(std::string_view text, Find find) {
    std::string_view rest;
    const Result<State> state = leading_state(part_, text, states_, rest);
    if (!state) return state.error();
    for (rest = trim(rest); !rest.empty();) {
      const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
      Label* const label = find(rest.substr(0, end));
      if (label == nullptr) return unknown(rest.substr(0, end));
      if (label->states.empty() || label->states.back() != *state) label->states.push_back(*state);
      rest = trim(rest.substr(end));
    }
    return {};
  }

  // "3: 0 2", labels by number.
  Result<void> numbers_of_state(std::string_view text) {
    return each_word(text, [&](std::string_view word) -> Label* {
      const auto number = parse_index(word);
      for (auto& [known, label] : labels_) {
        if (number && known == *number) return &label;
      }
      return nullptr;
    });
  }

  // "3 init goal", labels by name.
  Result<void> words_of_state(std::string_view text) {
    return each_word(text, [&](std::string_view word) -> Label* {
      for (auto& [known, label] : labels_) {
        if (label.name == word) return &label;
      }
      return nullptr;
    });
  }

  Result<void> unknown(std::string_view word) const {
    Nearest nearest(word);
    for (const auto& [number, label] : labels_) nearest.offer(label.name);
    return fault(part_, 0, "expected a label declared above, found '" + std::string(word) + "'",
                 nearest.best());
  }

  // The label "init" is the start; an empty "deadlock" says nothing.
  void hand_over() {
    for (auto& [number, label] : labels_) {
      std::vector<State>& states = label.states;
      std::sort(states.begin(), states.end());
      states.erase(std::unique(states.begin(), states.end()), states.end());
      if (label.name == "init") {
        if (!states.empty()) a_.start = std::move(states);
      } else if (label.name != "deadlock" || !states.empty()) {
        a_.labels.push_back(std::move(label));
      }
    }
  }

  PrismPart& part_;
  MdpArrays& a_;
  std::uint64_t states_;
  std::vector<std::pair<std::uint64_t, Label>> labels_;  // number, label
};

}  // namespace

Result<void> read_prism_states(PrismPart& part, MdpArrays& arrays) {
  const std::uint64_t states = arrays.choice_begin.size() - 1;
  std::string_view line;
  std::optional<StateNames> form;
  Names names;
  std::vector<std::string_view> values;
  while (part.lines.next(line)) {
    if (trim(line).empty() || trim(line).front() == '#') continue;
    const auto inside = in_brackets(line);
    if (!inside) return fault(part, 1, "expected names of variables or values in brackets");
    if (!form) {
      std::vector<std::string> variables;
      for (const std::string_view name : split(*inside, ',')) variables.emplace_back(name);
      form.emplace(std::move(variables));
      continue;
    }
    std::string_view rest;
    const Result<State> state = leading_state(part, trim(line), states, rest);
    if (!state) return state.error();
    if (*state != names.size()) {
      return fault(
          part, 1,
          "expected state " + std::to_string(names.size()) + ", found " + std::to_string(*state));
    }
    values = form->plain() ? std::vector<std::string_view>{*inside} : split(*inside, ',');
    if (values.size() != form->variables().size()) {
      return fault(part, 1,
                   "expected " + counted(form->variables().size(), "value") + ", found " +
                       std::to_string(values.size()));
    }
    const std::string name = form->name_of(values);
    if (const std::string_view reason = name_fault(name); !reason.empty()) {
      return fault(part, 1, std::string(reason));
    }
    names.push_back(name);
  }
  if (part.lines.error().empty() && names.size() != states) {
    return fault(part, 0,
                 "expected the values of " + counted(states, "state") + ", found " +
                     std::to_string(names.size()));
  }
  arrays.state_names = std::move(names);
  return {};
}

Result<void> read_prism_labels(PrismPart& part, MdpArrays& arrays) {
  return Labels(part, arrays).read();
}

}  // namespace quoll
