#include "quoll/verify/certificate.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/fields.hpp"
#include "quoll/model/name_index.hpp"

namespace quoll {
namespace {

constexpr std::string_view magic = "quoll certificate ";
constexpr std::string_view version = "1";
constexpr std::string_view columns = "state,action,lower,upper";
constexpr std::string_view last_line = "end";
constexpr std::size_t digest_digits = 16;

std::string hexadecimal(std::uint64_t number) {
  std::string text(digest_digits, '0');
  for (std::size_t i = digest_digits; i > 0; number >>= 4) {
    text[--i] = "0123456789abcdef"[number & 15];
  }
  return text;
}

std::optional<std::uint64_t> parse_hexadecimal(std::string_view text) {
  if (text.size() != digest_digits) return std::nullopt;
  std::uint64_t number = 0;
  for (const char letter : text) {
    const std::size_t digit = std::string_view("0123456789abcdef").find(letter);
    if (digit == std::string_view::npos) return std::nullopt;
    number = number << 4 | digit;
  }
  return number;
}

/// The lines before the states, one key at a time.
class HeadReader {
 public:
  explicit HeadReader(OpenCertificate& open) : open_(open) {}

  Result<void> read() {
    std::string_view line;
    while (open_.lines.next(line)) {
      if (line == columns) return complete();
      const std::size_t sign = line.find('=');
      if (sign == std::string_view::npos) {
        return wrong("key = value or the line '" + std::string(columns) + "' expected");
      }
      const Result<void> taken = take(trim(line.substr(0, sign)), trim(line.substr(sign + 1)));
      if (!taken) return taken;
    }
    if (!open_.lines.error().empty()) return wrong(open_.lines.error());
    return Error{open_.path, 0, 0, "truncated: it ends before its states", ""};
  }

 private:
  static constexpr std::array<std::string_view, 7> keys{
      "world", "parameter", "model", "discount", "objective", "method", "states"};

  Result<void> take(std::string_view key, std::string_view text) {
    Certificate& content = open_.content;
    const auto at = std::find(keys.begin(), keys.end(), key);
    if (at == keys.end()) {
      return wrong("unknown key '" + std::string(key) + "'", nearest(key, keys));
    }
    bool& seen = seen_[static_cast<std::size_t>(at - keys.begin())];
    if (seen && key != "parameter") return wrong(std::string(key) + " stands twice");
    seen = true;
    if (key == "world") content.world = text;
    if (key == "method") content.method = text;
    if (key == "parameter") return take_parameter(text);
    if (key == "model") return take_digest(text);
    if (key == "discount") return take_discount(text);
    if (key == "objective") return take_objective(text);
    if (key == "states") return take_states(text);
    return {};
  }

  Result<void> take_parameter(std::string_view text) {
    const std::size_t sign = text.find('=');
    if (sign == std::string_view::npos) return wrong("parameter = key=value expected");
    open_.content.parameters.emplace_back(trim(text.substr(0, sign)), trim(text.substr(sign + 1)));
    return {};
  }

  Result<void> take_digest(std::string_view text) {
    const auto number = parse_hexadecimal(text);
    if (!number) return wrong("model: 16 digits of 0-9 and a-f expected");
    open_.content.digest = *number;
    return {};
  }

  Result<void> take_discount(std::string_view text) {
    const auto number = parse_number(text);
    if (!number || !(*number > 0.0 && *number <= 1.0)) {
      return wrong("discount: a number above 0 and at most 1 expected, not '" + std::string(text) +
                   "'");
    }
    open_.content.discount = *number;
    return {};
  }

  Result<void> take_objective(std::string_view text) {
    if (text != "maximise" && text != "minimise") {
      return wrong("objective: maximise or minimise expected, not '" + std::string(text) + "'");
    }
    open_.content.maximise = text == "maximise";
    return {};
  }

  Result<void> take_states(std::string_view text) {
    const auto number = parse_count(text);
    if (!number) return wrong("states: a whole number expected, not '" + std::string(text) + "'");
    open_.states = *number;
    return {};
  }

  Result<void> complete() const {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const bool needed = keys[i] != "parameter" && keys[i] != "method" && keys[i] != "world";
      if (needed && !seen_[i]) return wrong("no line says " + std::string(keys[i]) + " = ...");
    }
    return {};
  }

  Error wrong(std::string sentence, std::string likely = "") const {
    return Error{open_.path, open_.lines.number(), 0, std::move(sentence), std::move(likely)};
  }

  OpenCertificate& open_;
  std::array<bool, keys.size()> seen_{};
};

/// The lines of the states.
class ClaimReader {
 public:
  ClaimReader(OpenCertificate& open, const Mdp& mdp)
      : open_(open), mdp_(mdp), spoken_of_(mdp.states(), false) {
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    open_.content.lower.assign(mdp.states(), -unbounded);
    open_.content.upper.assign(mdp.states(), unbounded);
    open_.content.policy.assign(mdp.states(), no_action);
  }

  Result<Verdict> read() {
    std::string_view line;
    bool complete = false;
    while (!complete && open_.lines.next(line)) {
      complete = line == last_line;
      if (complete) break;
      const Result<void> taken = take(line);
      if (!taken) return taken.error();
    }
    if (!open_.lines.error().empty()) return wrong(open_.lines.error());
    if (!complete || rows_ < open_.states) return cut(complete);
    if (rows_ > open_.states) {
      return wrong("states = " + std::to_string(open_.states) + ", but " + std::to_string(rows_) +
                   " stand here");
    }
    if (open_.lines.next(line)) return wrong("nothing expected after the line 'end'");
    return verdict();
  }

 private:
  Result<void> take(std::string_view line) {
    if (const auto place = fields_.split(line)) {
      return wrong("a quote without its partner, or followed by text", *place + 1);
    }
    if (fields_.count != 4) {
      return wrong("'" + std::string(columns) + "' expected, found " +
                   counted(fields_.count, "field"));
    }
    ++rows_;
    const std::optional<State> state = find(fields_.text[0]);
    std::array<double, 2> bounds{};
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      const std::string_view text = fields_.text[2 + i];
      const std::optional<double> number = parse_short_number(text);
      if (!number || *number != *number) {
        return wrong("a number expected, not '" + std::string(text) + "'", fields_.at[2 + i] + 1);
      }
      bounds[i] = *number;
    }
    if (!state) {
      note("state " + std::string(fields_.text[0]) + " of the certificate is not in the model",
           std::nullopt);
      return {};
    }
    if (spoken_of_[*state]) return wrong("state " + mdp_.state_name(*state) + " stands twice");
    spoken_of_[*state] = true;
    open_.content.lower[*state] = bounds[0];
    open_.content.upper[*state] = bounds[1];
    take_action(*state, fields_.text[1]);
    return {};
  }

  void take_action(State state, std::string_view name) {
    for (Action a = 0; a < mdp_.actions(state); ++a) {
      if (mdp_.action_name(mdp_.choice_begin(state) + a) != name) continue;
      open_.content.policy[state] = a;
      return;
    }
    if (name.empty()) return;
    note("state " + mdp_.state_name(state) + ": it has no action '" + std::string(name) + "'",
         state);
  }

  // States mostly stand in the order of the model.
  std::optional<State> find(std::string_view name) {
    if (expected_ < mdp_.states() && mdp_.state_name(expected_) == name) return expected_++;
    if (!index_) {
      index_.emplace();
      for (State s = 0; s < mdp_.states(); ++s) index_->insert(mdp_.state_name(s));
    }
    const auto found = index_->find(name);
    if (found) expected_ = *found + 1;
    return found;
  }

  void note(std::string reason, std::optional<State> state) {
    if (!misfit_.reason.empty()) return;
    misfit_.reason = std::move(reason);
    misfit_.state = state;
  }

  Verdict verdict() {
    if (!misfit_.reason.empty()) return misfit_;
    const auto silent = std::find(spoken_of_.begin(), spoken_of_.end(), false);
    if (silent != spoken_of_.end()) {
      const auto state = static_cast<State>(silent - spoken_of_.begin());
      note("state " + mdp_.state_name(state) + ": the certificate does not speak of it", state);
      return misfit_;
    }
    misfit_.accepted = true;
    return misfit_;
  }

  Error cut(bool complete) const {
    const std::string sentence = "truncated: " + grouped(rows_) + " of " +
                                 counted(open_.states, "state") +
                                 (complete ? "" : ", and no line 'end'");
    return Error{open_.path, 0, 0, sentence, ""};
  }

  Error wrong(std::string sentence, std::uint64_t column = 0) const {
    return Error{open_.path, open_.lines.number(), column, std::move(sentence), ""};
  }

  OpenCertificate& open_;
  const Mdp& mdp_;
  Fields fields_;
  std::vector<bool> spoken_of_;
  std::optional<NameIndex> index_;
  State expected_ = 0;
  std::uint64_t rows_ = 0;
  Verdict misfit_;
};

}  // namespace

Result<std::string> certificate_text(const Certificate& certificate, const Mdp& mdp) {
  std::string text;
  bool broken = false;
  const auto add = [&](std::string_view piece, char end) {
    broken = broken || piece.find_first_of("\r\n") != std::string_view::npos;
    text.append(piece).push_back(end);
  };
  const auto line = [&](std::string_view key, std::string_view value) {
    text.append(key).append(" = ");
    add(value, '\n');
  };
  text.append(magic).append(version).append("\n");
  line("world", certificate.world);
  for (const auto& [key, value] : certificate.parameters) line("parameter", key + "=" + value);
  line("model", hexadecimal(certificate.digest));
  line("discount", shortest(certificate.discount));
  line("objective", certificate.maximise ? "maximise" : "minimise");
  line("method", certificate.method);
  line("states", std::to_string(mdp.states()));
  add(columns, '\n');
  for (State s = 0; s < mdp.states(); ++s) {
    const Action action = mdp.terminal(s) ? no_action : certificate.policy[s];
    const bool none = action == no_action;
    add(as_field(mdp.state_name(s)), ',');
    add(none ? "" : as_field(mdp.action_name(mdp.choice_begin(s) + action)), ',');
    add(shortest(certificate.lower[s]), ',');
    add(shortest(certificate.upper[s]), '\n');
  }
  if (broken) {
    return Error{"--certificate", 0, 0, "names that go on one line expected, to be written so", ""};
  }
  add(last_line, '\n');
  return text;
}

bool is_certificate(const std::string& path) {
  Result<Lines> lines = Lines::open(path);
  std::string_view line;
  return lines && lines->next(line) && line.starts_with(magic);
}

namespace {

Result<OpenCertificate> open_lines(Lines lines, const std::string& path) {
  OpenCertificate open{path, {}, 0, std::move(lines)};
  std::string_view line;
  if (!open.lines.next(line) || !line.starts_with(magic)) {
    return Error{path, 0, 0,
                 "not a certificate: it does not begin with '" + std::string(magic) +
                     std::string(version) + "'",
                 ""};
  }
  const std::string_view number = trim(line.substr(magic.size()));
  if (number != version) {
    return Error{path, 1, 0,
                 "written by another Quoll (certificate " + std::string(number) +
                     ", this program reads " + std::string(version) + ")",
                 ""};
  }
  const Result<void> head = HeadReader(open).read();
  if (!head) return head.error();
  return open;
}

}  // namespace

Result<OpenCertificate> open_certificate(const std::string& path) {
  Result<Lines> lines = Lines::open(path);
  if (!lines) return Error{path, 0, 0, lines.error().expected, ""};
  return open_lines(std::move(*lines), path);
}

Result<OpenCertificate> open_certificate(std::string_view text, const std::string& path) {
  return open_lines(Lines(text), path);
}

Result<Verdict> read_claims(OpenCertificate& open, const Mdp& mdp) {
  return ClaimReader(open, mdp).read();
}

}  // namespace quoll
