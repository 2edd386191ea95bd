#include "quoll/base/text.hpp"
#include "quoll/cli/faces.hpp"
#include "quoll/cli/verb.hpp"

namespace quoll::cli {
namespace {

// Letters that mean something to roff.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char letter : text) {
    if (letter == '\\') {
      out += "\\e";
    } else if (letter == '-') {
      out += "\\-";
    } else if ((letter == '.' || letter == '\'') && out.empty()) {
      out += std::string("\\&") + letter;
    } else {
      out += letter;
    }
  }
  return out;
}

std::string option_entry(const Option& option) {
  std::string names;
  for (const std::string_view name : split(option.names, ',')) {
    names += (names.empty() ? "" : ", ") + ("\\fB" + escaped(name) + "\\fR");
  }
  if (!option.is_switch()) names += " \\fI" + escaped(option.type) + "\\fR";
  return ".TP\n" + names + "\n" + escaped(option.sentence) + "\n";
}

std::string verb_section(const Verb& verb) {
  Options options;
  verb.declare(options);
  std::string words, flags;
  for (const Option& option : options.list()) {
    if (option.positional()) {
      const std::string name = "\\fI" + escaped(option.names) + "\\fR";
      words += option.required ? " " + name : " [" + name + "]";
    } else {
      flags += option_entry(option);
    }
  }
  return ".SS \"quoll " + std::string(verb.name) + "\"\n.B quoll " + std::string(verb.name) + "\n" +
         (words.empty() ? "" : words.substr(1) + "\n") + "[options]\n.PP\n" +
         escaped(verb.summary) + ".\n" + flags;
}

}  // namespace

std::string manual_page() {
  std::string page = ".TH QUOLL 1 \"\" \"quoll " QUOLL_VERSION
                     "\" \"User Commands\"\n"
                     ".SH NAME\nquoll \\- Q\\-learning with the exact answer beside it\n"
                     ".SH SYNOPSIS\n.B quoll\n\\fIverb\\fR [\\fIworld\\fR] [options]\n"
                     ".SH VERBS\n";
  for (const Verb& verb : verbs()) page += verb_section(verb);
  page +=
      ".SH EXIT STATUS\n"
      ".TP\n0\ndone, also when a budget that was given ran out\n"
      ".TP\n1\na user error, or a damaged or foreign file\n"
      ".TP\n2\na stopping goal was not reached\n"
      ".TP\n3\n\\fBverify\\fR refused, or \\fBcheck\\fR found errors\n"
      ".SH ENVIRONMENT\n.TP\nNO_COLOR\nno colours in the terminal\n";
  return page;
}

}  // namespace quoll::cli
