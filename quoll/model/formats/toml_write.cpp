// The TOML world format, specified in docs/worlds.md: writing, and TOML as text.

#include <algorithm>
#include <cmath>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/toml_text.hpp"

namespace quoll {

namespace {

// Behind the string that begins at `at`, or the end of the content.
std::size_t behind_string(std::string_view content, std::size_t at) {
  const char quote = content[at];
  const std::string triple(3, quote);
  const bool long_form = content.substr(at, 3) == triple;
  at += long_form ? 3 : 1;
  while (at < content.size()) {
    if (quote == '"' && content[at] == '\\') {
      at += 2;
    } else if (long_form && content.substr(at, 3) == triple) {
      at += 3;
      while (at < content.size() && content[at] == quote) ++at;
      return at;
    } else if (!long_form && (content[at] == quote || content[at] == '\n')) {
      return at + 1;
    } else {
      ++at;
    }
  }
  return content.size();
}

bool is_bare(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
           (letter >= '0' && letter <= '9') || letter == '_' || letter == '-';
  });
}

std::string outcomes(const Mdp& mdp, std::uint64_t c) {
  const std::uint64_t begin = mdp.outcome_begin(c);
  const std::uint64_t end = mdp.outcome_end(c);
  const auto next = [&](std::uint64_t o) { return mdp.state_name(mdp.next(o)); };
  const std::string reward = toml_number(mdp.reward(c));
  if (end - begin == 1 && mdp.probability(begin) == 1.0) {
    const std::string to = toml_string(next(begin));
    return reward == "0" ? to : "{ to = " + to + ", reward = " + reward + " }";
  }
  bool same_reward = true;
  std::vector<State> successors;
  for (std::uint64_t o = begin; o < end; ++o) {
    same_reward = same_reward && mdp.reward(c, o) == mdp.reward(c);
    successors.push_back(mdp.next(o));
  }
  std::sort(successors.begin(), successors.end());
  const bool distinct =
      std::adjacent_find(successors.begin(), successors.end()) == successors.end();
  std::string text;
  for (std::uint64_t o = begin; o < end; ++o) {
    text += o == begin ? " " : ", ";
    if (same_reward && distinct) {
      text += toml_key(next(o)) + " = " + toml_number(mdp.probability(o));
    } else {
      text += "{ to = " + toml_string(next(o)) +
              ", probability = " + toml_number(mdp.probability(o)) +
              ", reward = " + toml_number(mdp.reward(c, o)) + " }";
    }
  }
  if (!same_reward || !distinct) return "[" + text + " ]";
  return "{ to = {" + text + " }" + (reward == "0" ? "" : ", reward = " + reward) + " }";
}

std::string start(const Mdp& mdp) {
  const std::span<const State> states = mdp.start();
  const bool uniform = mdp.arrays().start_probability.empty();
  std::uint64_t open = 0;  // states that are not ends
  bool all_open = true;
  for (State s = 0; s < mdp.states(); ++s) open += !mdp.terminal(s);
  for (const State s : states) all_open = all_open && !mdp.terminal(s);
  if (uniform && all_open && states.size() == open) return "\"uniform\"";
  std::string text;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const std::string name = mdp.state_name(states[i]);
    if (i > 0) text += ", ";
    text += uniform ? toml_string(name)
                    : toml_key(name) + " = " + toml_number(mdp.start_probability(i));
  }
  return uniform ? "[" + text + "]" : "{ " + text + " }";
}

// Action names are numbered by first mention; a model with another order has to say so.
std::string action_order(const Mdp& mdp) {
  const Names& names = mdp.arrays().action_names;
  std::vector<bool> met(names.size(), false);
  std::uint64_t count = 0;
  bool in_order = true;
  for (const std::uint32_t action : mdp.arrays().action) {
    if (met[action]) continue;
    met[action] = true;
    in_order = in_order && action == count;
    ++count;
  }
  if (in_order && count == names.size()) return "";
  std::string text = "actions = [";
  for (std::uint64_t i = 0; i < names.size(); ++i) {
    text += (i > 0 ? ", " : "") + toml_string(names[i]);
  }
  return text + "]\n";
}

}  // namespace

std::uint64_t line_with_deep_key(std::string_view content) {
  constexpr int most_dots = 99;
  int dots = 0;  // since the last letter that cannot be part of a dotted key
  for (std::size_t i = 0; i < content.size();) {
    const char letter = content[i];
    if (letter == '"' || letter == '\'') {
      i = behind_string(content, i);
      continue;
    }
    if (letter == '#') {
      i = std::min(content.find('\n', i), content.size());
      continue;
    }
    if (std::string_view("=,[]{}\n").find(letter) != std::string_view::npos) dots = 0;
    if (letter == '.' && ++dots > most_dots) {
      return 1 + static_cast<std::uint64_t>(
                     std::count(content.begin(), content.begin() + static_cast<long>(i), '\n'));
    }
    ++i;
  }
  return 0;
}

std::string toml_key(std::string_view name) {
  return is_bare(name) ? std::string(name) : toml_string(name);
}

std::string toml_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\') {
      quoted += '\\';
      quoted += letter;
    } else if (code < 32 || code == 127) {
      constexpr std::string_view digits = "0123456789ABCDEF";
      quoted += "\\u00";
      quoted += digits[code / 16];
      quoted += digits[code % 16];
    } else {
      quoted += letter;
    }
  }
  return quoted + "\"";
}

std::string toml_number(double value) {
  std::string text = shortest(value);
  // An integer of TOML has 64 bits and no negative zero.
  const bool whole = text.find_first_of(".en") == std::string::npos;
  if (whole && (std::fabs(value) >= 1e15 || (value == 0.0 && std::signbit(value)))) text += ".0";
  return text;
}

Result<std::string> write_toml(const Mdp& mdp) {
  const Result<void> proper = proper_names(mdp);
  if (!proper) return proper.error();
  std::string text = "discount = " + toml_number(mdp.discount()) + "\n";
  if (mdp.alternating()) text += "alternating = true\n";
  text += "start = " + start(mdp) + "\n";
  const std::vector<State>& terminal = mdp.arrays().terminal;
  for (std::size_t i = 0; i < terminal.size(); ++i) {
    text += (i == 0 ? "terminal = [" : ", ") + toml_string(mdp.state_name(terminal[i]));
    if (i + 1 == terminal.size()) text += "]\n";
  }
  text += action_order(mdp);
  const std::vector<Label>& labels = mdp.arrays().labels;
  if (!labels.empty()) text += "\n[labels]\n";
  for (const Label& label : labels) {
    text += toml_key(label.name) + " = [";
    for (std::size_t i = 0; i < label.states.size(); ++i) {
      text += (i > 0 ? ", " : "") + toml_string(mdp.state_name(label.states[i]));
    }
    text += "]\n";
  }
  for (State s = 0; s < mdp.states(); ++s) {
    text += "\n[states." + toml_key(mdp.state_name(s)) + "]\n";
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      text += toml_key(mdp.action_name(c)) + " = " + outcomes(mdp, c) + "\n";
    }
  }
  return text;
}

}  // namespace quoll
