// The policy as a C header.

#include <fmt/format.h>

#include <algorithm>

#include "quoll/base/text.hpp"
#include "quoll/report/c_text.hpp"
#include "quoll/report/export_policy.hpp"

namespace quoll {

namespace {

constexpr std::uint64_t self_test_states = 64;

class CHeader {
 public:
  explicit CHeader(const PolicyExport& policy)
      : policy_(policy),
        mdp_(*policy.mdp),
        name_(c_identifier(policy.name)),
        named_(mdp_.states() <= c_names_limit) {}

  std::string text() {
    head();
    names();
    table();
    functions();
    self_test();
    out_ += "#endif\n";
    return std::move(out_);
  }

 private:
  std::uint64_t action_count() const { return mdp_.arrays().action_names.size(); }

  /// The number of the chosen action among all action names; -1 = none.
  std::int64_t action(State s) const {
    if (policy_.policy[s] == no_action) return -1;
    return mdp_.arrays().action[mdp_.choice_begin(s) + policy_.policy[s]];
  }

  std::string_view type() const {
    return action_count() < 255 ? "uint8_t" : action_count() < 65535 ? "uint16_t" : "uint32_t";
  }
  std::uint64_t none() const {
    return action_count() < 255 ? 255 : action_count() < 65535 ? 65535 : 4294967295U;
  }

  void head() {
    out_ += fmt::format("/* A policy for the world {}, for C99 and C++; needs nothing.\n",
                        c_comment(policy_.name));
    for (const std::string& line : policy_.origin) out_ += " * " + c_comment(line) + "\n";
    out_ += fmt::format(
        " *   int a = {0}_action(state);   number of an action, -1 = none: an end, or never seen\n"
        " * Self-test: cc -DQUOLL_SELF_TEST -x c THIS_FILE && ./a.out\n",
        name_);
    if (!named_) {
      out_ += fmt::format(
          " * Names of states are left out: there are more than {}. States are numbered from 0 in\n"
          " * the order of the world.\n",
          grouped(c_names_limit));
    }
    out_ += fmt::format(" */\n#ifndef QUOLL_{0}_POLICY_H\n#define QUOLL_{0}_POLICY_H\n\n",
                        c_upper(name_));
    out_ += "#include <stdint.h>\n";
    if (named_) out_ += "#include <string.h>\n";
    out_ += "\n";
  }

  void name_array(std::string_view what, std::uint64_t count, const Names& names) {
    out_ += fmt::format("static const char *const {}_{}_names[{}] = {{\n", name_, what, count);
    for (std::uint64_t i = 0; i < count; ++i) out_ += "  " + c_string(names[i]) + ",\n";
    out_ += "};\n\n";
  }

  void names() {
    out_ += fmt::format("enum {{ {0}_states = {1}, {0}_actions = {2} }};\n\n", name_, mdp_.states(),
                        action_count());
    if (named_) name_array("state", mdp_.states(), mdp_.arrays().state_names);
    name_array("action", action_count(), mdp_.arrays().action_names);
  }

  void table() {
    out_ += fmt::format("/* Per state the number of its action; {} = none. */\n", none());
    out_ += fmt::format("static const {} {}_policy[{}] = {{", type(), name_, mdp_.states());
    for (State s = 0; s < mdp_.states(); ++s) {
      const std::int64_t a = action(s);
      out_ += s % 32 == 0 ? "\n  " : "";
      out_ += std::to_string(a < 0 ? none() : static_cast<std::uint64_t>(a));
      out_ += ',';
    }
    out_ += "\n};\n\n";
  }

  void functions() {
    out_ += fmt::format(
        "/* The action to take in a state: a number below {0}_actions, or -1 where there is none.\n"
        " */\n"
        "static inline int {0}_action(int state) {{\n"
        "  if (state < 0 || state >= {0}_states) return -1;\n"
        "  return {0}_policy[state] == {1}u ? -1 : (int){0}_policy[state];\n"
        "}}\n\n"
        "/* The name of an action, or a null pointer. */\n"
        "static inline const char *{0}_action_name(int action) {{\n"
        "  return action < 0 || action >= {0}_actions ? (const char *)0 : {0}_action_names[action];"
        "\n}}\n\n",
        name_, none());
    if (!named_) return;
    out_ += fmt::format(
        "/* The name of a state, or a null pointer. */\n"
        "static inline const char *{0}_state_name(int state) {{\n"
        "  return state < 0 || state >= {0}_states ? (const char *)0 : {0}_state_names[state];\n"
        "}}\n\n"
        "/* The number of a state with this name, or -1. Looks through all of them. */\n"
        "static inline int {0}_find_state(const char *name) {{\n"
        "  int state;\n"
        "  for (state = 0; state < {0}_states; ++state) {{\n"
        "    if (strcmp({0}_state_names[state], name) == 0) return state;\n"
        "  }}\n"
        "  return -1;\n"
        "}}\n\n",
        name_);
  }

  /// The states the self-test asks about: all of them, or 64 spread over them.
  std::vector<State> tested() const {
    std::vector<State> states;
    const std::uint64_t count = std::min(self_test_states, mdp_.states());
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t s =
          mdp_.states() <= count ? i : i * (mdp_.states() - 1) / (self_test_states - 1);
      states.push_back(static_cast<State>(s));
    }
    return states;
  }

  void vectors() {
    const std::vector<State> states = tested();
    out_ += "static const struct {\n  int state;\n";
    if (named_) out_ += "  const char *state_name;\n";
    out_ += "  int action;\n  const char *action_name;\n";
    out_ += fmt::format("}} {}_vectors[{}] = {{\n", name_, states.size());
    for (const State s : states) {
      const std::int64_t a = action(s);
      const std::string state = named_ ? c_string(mdp_.state_name(s)) + ", " : "";
      const std::string move =
          a < 0 ? "0" : c_string(mdp_.action_name(mdp_.choice_begin(s) + policy_.policy[s]));
      out_ += fmt::format("  {{{}, {}{}, {}}},\n", s, state, a, move);
    }
    out_ += "};\n\n";
  }

  void self_test() {
    out_ += "#ifdef QUOLL_SELF_TEST\n#include <stdio.h>\n";
    if (!named_) out_ += "#include <string.h>\n";
    out_ += "\n";
    vectors();
    const std::string check_state =
        named_ ? fmt::format(
                     "    right = right && strcmp({0}_state_name(state), "
                     "{0}_vectors[i].state_name) == 0;\n"
                     "    right = right && {0}_find_state({0}_vectors[i].state_name) == "
                     "state;\n",
                     name_)
               : "";
    out_ += fmt::format(
        "int main(void) {{\n"
        "  const int count = (int)(sizeof {0}_vectors / sizeof {0}_vectors[0]);\n"
        "  int i, failures = 0;\n"
        "  for (i = 0; i < count; ++i) {{\n"
        "    const int state = {0}_vectors[i].state;\n"
        "    const int action = {0}_action(state);\n"
        "    int right = action == {0}_vectors[i].action;\n"
        "{1}"
        "    if (right && action >= 0) {{\n"
        "      right = strcmp({0}_action_name(action), {0}_vectors[i].action_name) == 0;\n"
        "    }}\n"
        "    if (!right) printf(\"state %d: wrong\\n\", state);\n"
        "    failures += !right;\n"
        "  }}\n"
        "  failures += {0}_action(-1) != -1 || {0}_action({0}_states) != -1;\n"
        "  failures += {0}_action_name(-1) != 0;\n"
        "  printf(\"%d of %d states as expected\\n\", count - failures, count);\n"
        "  return failures != 0;\n"
        "}}\n"
        "#endif\n\n",
        name_, check_state);
  }

  const PolicyExport& policy_;
  const Mdp& mdp_;
  std::string name_;
  bool named_;
  std::string out_;
};

}  // namespace

std::string policy_c(const PolicyExport& policy) {
  return CHeader(policy).text();
}

}  // namespace quoll
