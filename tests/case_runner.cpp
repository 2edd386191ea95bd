// case_runner [--update] PROGRAM FILE: runs the commands of a case file or of a page of the docs
// and compares what they print. Exit 0: all as expected; 1: a difference, which is printed.
//
// Case file (.case), line by line:
//   # a comment                      @file NAME ... @end   writes a file before the next command
//   $ COMMAND   for sh, in a fresh folder per case file; `quoll` is the program under test
//   < LINE      a line of its input  > LINE   of its output  ! LINE   of its messages (stderr)
//   = N         its exit status, 0 when not given
// Page (.md): a comment alone on a line says what the next fenced block is:
//   <!-- run -->        commands for sh, each must succeed (`<!-- run 2 -->`: must end with status
//   2)
//   <!-- output -->     what the commands before it print on stdout
//   <!-- file NAME -->  a file the later commands find
// An expected line `...` stands for any lines; {number} and {any} in a line for a number and any
// text.
// --update rewrites the expectations that were not met.

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

using Lines = std::vector<std::string>;

// A block of lines expected in one stream; an absent block of a page is not compared.
struct Expected {
  Lines lines;
  bool compared = true;
};

struct Step {
  std::size_t line = 0;       // of the command, from 1
  std::string write_to = {};  // not empty: this step writes `command` to that file
  std::string command = {};
  std::string input = {};
  Expected out = {}, err = {};
  int status = 0;
  std::size_t begin = 0, end = 0;  // lines of the file that --update replaces
};

struct Outcome {
  Lines out, err;
  int status = 0;
};

std::string read_all(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_all(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

Lines split(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// Does the expected line, with its wildcards, match?
bool matches(const std::string& expected, const std::string& line) {
  if (expected.find("{number}") == std::string::npos &&
      expected.find("{any}") == std::string::npos) {
    return expected == line;
  }
  static const std::regex special(R"re([.^$|()\[\]{}*+?\\])re");
  std::string pattern = std::regex_replace(expected, special, R"(\$&)");
  static const std::regex number(R"re(\\\{number\\\})re"), any(R"re(\\\{any\\\})re");
  pattern =
      std::regex_replace(pattern, number, R"re([-+]?[0-9][0-9,]*(\.[0-9]+)?([eE][-+]?[0-9]+)?)re");
  pattern = std::regex_replace(pattern, any, ".*");
  return std::regex_match(line, std::regex(pattern));
}

// The same over lists of lines, where "..." stands for any lines: classic matching with one way
// back.
bool matches(const Lines& expected, const Lines& lines) {
  std::size_t e = 0, l = 0;
  std::optional<std::pair<std::size_t, std::size_t>> back;
  while (l < lines.size()) {
    if (e < expected.size() && expected[e] == "...") {
      back = {e++, l};
    } else if (e < expected.size() && matches(expected[e], lines[l])) {
      ++e, ++l;
    } else if (back) {
      e = back->first + 1;
      l = ++back->second;
    } else {
      return false;
    }
  }
  while (e < expected.size() && expected[e] == "...") ++e;
  return e == expected.size();
}

bool starts(const std::string& line, const char* prefix) {
  return line.rfind(prefix, 0) == 0;
}

// What follows "X" or "X " at the head of a line.
std::string rest(const std::string& line) {
  return line.size() > 2 ? line.substr(2) : "";
}

[[noreturn]] void fail(const fs::path& file, std::size_t line, const std::string& what) {
  std::printf("%s:%zu: %s\n", file.c_str(), line, what.c_str());
  std::exit(1);
}

std::vector<Step> parse_case(const fs::path& file, const Lines& lines) {
  std::vector<Step> steps;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    if (line.empty() || line[0] == '#') continue;
    if (starts(line, "@file ")) {
      Step step{.line = i + 1, .write_to = line.substr(6)};
      while (++i < lines.size() && lines[i] != "@end") step.command += lines[i] + "\n";
      steps.push_back(step);
      continue;
    }
    if (starts(line, "$ ")) {
      steps.push_back({.line = i + 1, .command = line.substr(2), .begin = i + 1, .end = i + 1});
      continue;
    }
    if (steps.empty() || !steps.back().write_to.empty()) fail(file, i + 1, "expected '$ COMMAND'");
    Step& step = steps.back();
    switch (line[0]) {
      case '<':
        step.input += rest(line) + "\n";
        if (step.begin != i) fail(file, i + 1, "input lines come right after the command");
        step.begin = i + 1;
        break;
      case '>':
        step.out.lines.push_back(rest(line));
        break;
      case '!':
        step.err.lines.push_back(rest(line));
        break;
      case '=':
        step.status = std::atoi(rest(line).c_str());
        break;
      default:
        fail(file, i + 1, "expected a line that begins with one of # @ $ < > ! =");
    }
    step.end = i + 1;
  }
  return steps;
}

std::vector<Step> parse_page(const fs::path& file, const Lines& lines) {
  static const std::regex mark(R"re(<!-- (run|output|file)( +(\S+))? -->)re");
  std::vector<Step> steps;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::smatch match;
    if (!std::regex_match(lines[i], match, mark)) continue;
    const std::string kind = match[1], argument = match[3];
    const std::size_t open = i + 1;
    if (open >= lines.size() || !starts(lines[open], "```")) fail(file, i + 1, "expected a block");
    std::string text;
    for (i = open + 1; i < lines.size() && lines[i] != "```"; ++i) text += lines[i] + "\n";
    if (i == lines.size()) fail(file, open + 1, "a block without an end");
    if (kind == "file") {
      steps.push_back({.line = open + 1, .write_to = argument, .command = text});
    } else if (kind == "run") {
      steps.push_back({.line = open + 1, .command = "set -e\n" + text});
      steps.back().status = std::atoi(argument.c_str());
      steps.back().out.compared = steps.back().err.compared = false;
    } else {
      if (steps.empty()) fail(file, open, "output without commands");
      steps.back().out = {split(text), true};
      steps.back().begin = open + 1;
      steps.back().end = i;
    }
  }
  return steps;
}

// A fresh folder with copies of the tree's worlds and examples, removed at the end; beside it the
// folder `bin` with the program, first in the path.
class Folder {
 public:
  explicit Folder(const fs::path& program) {
    std::string name = (fs::temp_directory_path() / ("quoll-case-" + std::string(6, 'X'))).string();
    if (mkdtemp(name.data()) == nullptr) fail(name, 0, "cannot make a folder");
    root_ = name;
    fs::create_directories(root_ / "bin");
    fs::create_directories(here());
    fs::create_symlink(fs::absolute(program), root_ / "bin/quoll");
    for (const char* part : {"worlds", "examples"}) {
      const fs::path source = fs::path(QUOLL_SOURCE) / part;
      if (fs::exists(source)) fs::copy(source, here() / part, fs::copy_options::recursive);
    }
    // ./dev run in a page is the program under test, of whatever tree this is.
    write_all(here() / "dev",
              "#!/bin/sh\n[ \"$1\" = run ] && shift && exec quoll \"$@\"\n"
              "exec '" QUOLL_SOURCE "/dev' \"$@\"\n");
    fs::permissions(here() / "dev", fs::perms::owner_all);
    setenv("PATH", ((root_ / "bin").string() + ":" + std::getenv("PATH")).c_str(), 1);
    setenv("QUOLL_SOURCE", QUOLL_SOURCE, 1);
    setenv("QUOLL_QUIET", "1", 1);  // how long something takes is no matter of a case
    for (const char* name_of : {"COLUMNS", "NO_COLOR", "CLICOLOR_FORCE"}) unsetenv(name_of);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path here() const { return root_ / "here"; }

  Outcome run(const Step& step) const {
    write_all(root_ / "command", step.command + "\n");
    write_all(root_ / "in", step.input);
    const std::string at = root_.string();
    const std::string line = "cd '" + at + "/here' && sh '" + at + "/command' <'" + at + "/in' >'" +
                             at + "/out' 2>'" + at + "/err'";
    const int status = std::system(line.c_str());
    return {split(read_all(root_ / "out")), split(read_all(root_ / "err")),
            WIFEXITED(status) ? WEXITSTATUS(status) : 256};
  }

 private:
  fs::path root_;
};

void print_block(const char* title, const Lines& lines) {
  std::printf("  %s\n", title);
  for (const auto& line : lines) std::printf("    |%s\n", line.c_str());
}

bool met(const Step& step, const Outcome& outcome) {
  return step.status == outcome.status &&
         (!step.out.compared || matches(step.out.lines, outcome.out)) &&
         (!step.err.compared || matches(step.err.lines, outcome.err));
}

void report(const fs::path& file, const Step& step, const Outcome& outcome) {
  std::printf("%s:%zu: not as expected: %s\n", file.c_str(), step.line, step.command.c_str());
  if (step.status != outcome.status) {
    std::printf("  status %d, expected %d\n", outcome.status, step.status);
  }
  if (step.out.compared && !matches(step.out.lines, outcome.out)) {
    print_block("expected output:", step.out.lines);
    print_block("output:", outcome.out);
  }
  if (!step.err.compared || !matches(step.err.lines, outcome.err)) {
    if (step.err.compared) print_block("expected messages:", step.err.lines);
    print_block("messages:", outcome.err);
  }
}

// The lines that state this outcome in a file of this kind.
Lines stated(bool page, const Step& step, const Outcome& outcome) {
  Lines lines;
  for (const auto& line : outcome.out)
    lines.push_back(page ? line : line.empty() ? ">" : "> " + line);
  if (page) return lines;
  const bool silent = step.err.lines == Lines{"..."};
  if (silent) lines.push_back("! ...");
  for (const auto& line : outcome.err) {
    if (!silent) lines.push_back(line.empty() ? "!" : "! " + line);
  }
  if (outcome.status != 0) lines.push_back("= " + std::to_string(outcome.status));
  return lines;
}

int run_file(const fs::path& program, const fs::path& file, bool update) {
  Lines lines = split(read_all(file));
  const bool page = file.extension() == ".md";
  const auto steps = page ? parse_page(file, lines) : parse_case(file, lines);
  const Folder folder(program);
  int failures = 0;
  std::vector<std::pair<const Step*, Outcome>> missed;
  for (const Step& step : steps) {
    if (!step.write_to.empty()) {
      write_all(folder.here() / step.write_to, step.command);
      continue;
    }
    Outcome outcome = folder.run(step);
    if (met(step, outcome)) continue;
    const bool mended = update && step.begin != 0 && (!page || step.status == outcome.status);
    if (!mended) report(file, step, outcome), ++failures;
    if (mended) missed.emplace_back(&step, std::move(outcome));
  }
  // From the last to the first, so that the line numbers of the others stay right.
  for (auto it = missed.rbegin(); it != missed.rend(); ++it) {
    const auto& [step, outcome] = *it;
    const auto at = static_cast<std::ptrdiff_t>(step->begin);
    lines.erase(lines.begin() + at, lines.begin() + static_cast<std::ptrdiff_t>(step->end));
    const Lines now = stated(page, *step, outcome);
    lines.insert(lines.begin() + at, now.begin(), now.end());
  }
  if (!missed.empty()) {
    std::string text;
    for (const auto& line : lines) text += line + "\n";
    write_all(file, text);
    std::printf("%s: %zu expectations rewritten\n", file.c_str(), missed.size());
  }
  return failures == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const bool update = argc == 4 && std::string(argv[1]) == "--update";
  if (argc != 3 && !update) {
    std::puts("usage: case_runner [--update] PROGRAM FILE");
    return 1;
  }
  return run_file(argv[argc - 2], fs::absolute(argv[argc - 1]), update);
}
