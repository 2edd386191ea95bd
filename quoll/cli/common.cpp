#include "quoll/cli/common.hpp"

#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"
#include "quoll/experiment/config.hpp"
#include "quoll/report/progress.hpp"

namespace quoll::cli {

Exit fail(const Error& error) {
  std::fflush(stdout);
  std::fputs(("quoll: " + message(error) + "\n").c_str(), stderr);
  return user_error;
}

void WorldOption::declare(Options& options, bool required) {
  options.word("world", name, "a built-in world (see 'quoll list worlds') or a file", required);
  options.option("--with", &with, "KEY=VALUE", "a parameter of the world; may be repeated");
  options.option("--goal", &goal, "LABEL",
                 "an episode is over where this label holds; also !A, A & B, A | B and states; "
                 "without --reward what counts is the probability of reaching it");
  options.option("--reward", &rewards, "NAME", "which rewards of the world count");
}

namespace {

Result<std::pair<std::string, std::string>> key_value(const std::string& text,
                                                      const std::string& flag) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    return Error{flag, 0, 0, "key=value expected, not '" + text + "'", ""};
  }
  return std::pair{text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace

Result<WorldSource> WorldOption::source(bool minimise) const {
  WorldSource source{name, {}};
  for (const std::string& text : with) {
    const auto parameter = key_value(text, "--with");
    if (!parameter) return parameter.error();
    if (gives(source.parameters, parameter->first)) {
      return Error{"--with " + parameter->first, 0, 0, "stands twice", ""};
    }
    source.parameters.push_back(*parameter);
  }
  if (!goal.empty()) source.parameters.emplace_back("--goal", goal);
  if (!rewards.empty()) source.parameters.emplace_back("--reward", rewards);
  if (!goal.empty() && minimise) source.parameters.emplace_back("--minimise", "true");
  return source;
}

Result<World> WorldOption::open(bool minimise) const {
  const Result<WorldSource> from = source(minimise);
  if (!from) return from.error();
  return find_world(from->name, from->parameters);
}

Result<World> WorldOption::open(const GivenSettings& given, bool minimise) const {
  const Result<WorldSource> from = source(minimise);
  if (!from) return from.error();
  const auto settings = given.given();
  if (!settings) return settings.error();
  constexpr std::pair<std::string_view, std::string_view> same[] = {{"discount", "discount"},
                                                                    {"episode_steps", "limit"}};
  for (const auto& [setting, parameter] : same) {
    if (!gives(*settings, setting) || !gives(from->parameters, parameter)) continue;
    std::string flag = "--" + std::string(setting);
    std::replace(flag.begin(), flag.end(), '_', '-');
    return Error{"--with " + std::string(parameter), 0, 0,
                 "has no effect beside " + flag + ": one of them expected", ""};
  }
  return find_world(from->name, from->parameters);
}

void OutputOption::declare(Options& options, const std::string& file_sentence) {
  options.flag("--json", &json, "print one JSON object on stdout");
  options.flag("--quiet", &quiet, "no progress on stderr");
  options.flag("--all", &all, "complete lists, however long");
  if (!file_sentence.empty()) options.option("-o,--output", &file, "FILE", file_sentence);
}

void GivenSettings::declare(Options& options, std::vector<Setting> settings) {
  declare_flags(options, std::move(settings));
  options.option("--set", &set, "KEY=VALUE", "any setting by its key; may be repeated");
  options.option("--config", &config, "FILE.toml", "settings from a TOML file");
}

void GivenSettings::declare_flags(Options& options, std::vector<Setting> settings) {
  for (const Setting& setting : settings) {
    const std::string key(setting.name);
    std::string names = "--" + key;
    std::replace(names.begin(), names.end(), '_', '-');
    if (key == "discount") names += ",--gamma";
    const std::string standard = text_of(setting);
    // A discount of 0 stands for the world's own, as its sentence says.
    const std::string initial = key == "discount" && standard == "0" ? "" : standard;
    const std::string sentence =
        sentence_of(setting) + (initial.empty() ? "" : " [" + initial + "]");
    const auto take = [this, key](const std::string& text) { flags.emplace_back(key, text); };
    if (std::holds_alternative<bool*>(setting.field)) {
      options.flag(names, take, sentence_of(setting));
    } else {
      options.option(names, take, range_of(setting), sentence);
    }
  }
}

Result<std::vector<std::pair<std::string, std::string>>> GivenSettings::given() const {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& text : set) {
    auto pair = key_value(text, "--set");
    if (!pair) return pair.error();
    std::replace(pair->first.begin(), pair->first.end(), '-', '_');
    pairs.push_back(std::move(*pair));
  }
  pairs.insert(pairs.end(), flags.begin(), flags.end());
  return pairs;
}

Result<void> GivenSettings::apply(std::vector<Setting> settings) const {
  if (!config.empty()) {
    const Result<void> read = read_config(config, settings);
    if (!read) return read;
  }
  const auto pairs = given();
  if (!pairs) return pairs.error();
  for (const auto& [key, text] : *pairs) {
    const Setting* setting = find(settings, key);
    if (!setting) {
      Nearest nearest(key);
      for (const Setting& one : settings) nearest.offer(one.name);
      return Error{"--set", 0, 0, "no setting '" + key + "'", nearest.best()};
    }
    std::string flag = "--" + key;
    std::replace(flag.begin(), flag.end(), '_', '-');
    const Result<void> assigned = assign(*setting, text, flag);
    if (!assigned) return assigned;
  }
  return {};
}

Error GivenSettings::placed(Error error) const {
  if (config.empty() || error.file.rfind("--", 0) != 0) return error;
  std::string key = error.file.substr(2);
  std::replace(key.begin(), key.end(), '-', '_');
  const auto pairs = given();
  const Result<std::string> text = read_file(config);
  if (!pairs || !text) return error;
  for (const auto& [name, value] : *pairs) {
    if (name == key) return error;
  }
  std::uint64_t line = 0;
  for (const std::string_view row : split(*text, '\n')) {
    ++line;
    const std::size_t equals = row.find('=');
    if (equals == std::string_view::npos || trim(row.substr(0, equals)) != key) continue;
    return Error{config, line, 0, key + ": " + error.expected, error.nearest};
  }
  return error;
}

Result<double> parse_discount(const std::string& text) {
  const auto number = parse_number(text);
  if (number && *number > 0.0 && *number <= 1.0) return *number;
  return Error{"--discount", 0, 0, "a number in (0, 1] expected, not '" + text + "'", ""};
}

Result<void> GivenSettings::check_discount() const {
  const auto pairs = given();
  if (!pairs) return pairs.error();
  for (const auto& [key, text] : *pairs) {
    if (key != "discount") continue;
    const Result<double> discount = parse_discount(text);
    if (!discount) return discount.error();
  }
  return {};
}

Result<void> write_output(const std::string& path, std::string_view content,
                          std::initializer_list<std::string> inputs) {
  struct stat output{};
  const bool exists = stat(path.c_str(), &output) == 0 && S_ISREG(output.st_mode);
  for (const std::string& name : inputs) {
    struct stat input{};
    if (!exists || stat(name.c_str(), &input) != 0) continue;
    if (input.st_dev == output.st_dev && input.st_ino == output.st_ino) {
      return Error{path, 0, 0, "this file was read here, -o would replace it: give another name",
                   ""};
    }
  }
  return write_file(path, content);
}

Result<void> make_folder(const std::string& path) {
  if (mkdir(path.c_str(), 0777) != 0 && errno != EEXIST) {
    return Error{path, 0, 0, std::string("the folder cannot be made: ") + std::strerror(errno), ""};
  }
  struct stat status{};
  if (stat(path.c_str(), &status) != 0 || !S_ISDIR(status.st_mode)) {
    return Error{path, 0, 0, "is not a folder", ""};
  }
  if (access(path.c_str(), W_OK) == 0) return {};
  return Error{path, 0, 0, std::string("cannot be written to: ") + std::strerror(errno), ""};
}

bool print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) {
    return true;
  }
  fail({"stdout", 0, 0, std::string("cannot be written: ") + std::strerror(errno), ""});
  return false;
}

TerminalStyle stdout_style() {
  TerminalStyle style;
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  winsize size{};
  if (terminal && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    style.width = size.ws_col;
  } else {
    style.width = 100;
  }
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  style.color = terminal && (no_color == nullptr || *no_color == '\0') &&
                !(term != nullptr && std::strcmp(term, "dumb") == 0);
  std::string locale;
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0') {
      locale = value;
      break;
    }
  }
  style.unicode = locale != "C" && locale != "POSIX";
  return style;
}

bool stderr_is_terminal() {
  return isatty(STDERR_FILENO) != 0;
}

namespace {
volatile std::sig_atomic_t interrupt_count = 0;

void on_interrupt(int signal) {
  interrupt_count = interrupt_count + 1;
  if (interrupt_count > 1) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}
}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}
bool interrupted() {
  return interrupt_count > 0;
}
int interrupts() {
  return interrupt_count;
}
void release_interrupts() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

ProgressDisplay::ProgressDisplay(bool quiet, std::string_view unit)
    : quiet_(quiet || std::getenv("QUOLL_QUIET") != nullptr), unit_(unit) {}

void ProgressDisplay::show(std::uint64_t done_now, std::uint64_t total, double seconds,
                           const std::string& extra, std::uint64_t resumed) {
  const bool terminal = stderr_is_terminal();
  if (quiet_ || seconds - last_ < (terminal ? 0.1 : 2.0) || seconds < 0.5) return;
  last_ = seconds;
  const Progress progress{done_now, total, seconds, extra, resumed, unit_};
  if (terminal) {
    winsize size{};
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    std::fputs(progress_bar(progress, known ? size.ws_col : 80).c_str(), stderr);
    shown_ = true;
  } else {
    std::fputs(progress_line(progress).c_str(), stderr);
  }
  std::fflush(stderr);
}

ProgressDisplay::~ProgressDisplay() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

}  // namespace quoll::cli
