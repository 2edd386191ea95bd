#pragma once
// What the verbs share: opening worlds, settings from flags and files, output, errors, interrupts.

#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/base/settings.hpp"
#include "quoll/cli/verb.hpp"
#include "quoll/env/world.hpp"
#include "quoll/experiment/run.hpp"
#include "quoll/report/table.hpp"

namespace quoll::cli {

/// A discount somebody gave: a number in (0, 1].
Result<double> parse_discount(const std::string& text);

/// Prints "quoll: message" on stderr.
Exit fail(const Error& error);

struct GivenSettings;

/// The world of a command line: WORLD, --with key=value, --goal and --reward.
struct WorldOption {
  std::string name;
  std::vector<std::string> with;
  std::string goal, rewards;

  /// `required`: false for a verb that does something without a world.
  void declare(Options& options, bool required = true);
  /// Refuses a key given twice. `minimise`: the goal is to be reached with the least probability.
  Result<WorldSource> source(bool minimise = false) const;
  Result<World> open(bool minimise = false) const;
  /// Refuses a discount or a step limit that is also given as a setting.
  Result<World> open(const GivenSettings& given, bool minimise = false) const;
  /// Whether anything is asked beyond what the world says.
  bool aimed() const { return !goal.empty() || !rewards.empty(); }
};

/// --json, --quiet, --all, -o.
struct OutputOption {
  bool json = false;
  bool quiet = false;
  bool all = false;
  std::string file;

  void declare(Options& options, const std::string& file_sentence);
};

/// Settings as they were given: flags in the order of the command line, --set key=value, --config.
struct GivenSettings {
  std::vector<std::pair<std::string, std::string>> flags;  ///< key, text
  std::vector<std::string> set;
  std::string config;

  /// Declares a flag for each setting, --set and --config.
  void declare(Options& options, std::vector<Setting> settings);
  void declare_flags(Options& options, std::vector<Setting> settings);
  /// Applies file, then --set, then flags. Unknown keys name the nearest.
  Result<void> apply(std::vector<Setting> settings) const;
  /// Keys given by flag or --set, with their texts.
  Result<std::vector<std::pair<std::string, std::string>>> given() const;
  /// The error of a flag that was not given, but whose key stands in the file: at its line there.
  Error placed(Error error) const;
  /// Refuses a discount given by flag or --set outside (0, 1].
  Result<void> check_discount() const;
};

/// write_file(), but refuses a path that is the same file as one of `inputs`, the files that were
/// read (worlds, runs, policies; names that are no files do not count).
Result<void> write_output(const std::string& path, std::string_view content,
                          std::initializer_list<std::string> inputs);

/// Makes a folder to write to, if it is not there. Error: something else stands there, or it cannot
/// be written to.
Result<void> make_folder(const std::string& path);

/// The text on stdout, at once; false (with a message) when it cannot be written.
bool print(const std::string& text);

/// What stdout takes: width, colour (a terminal and no NO_COLOR), Unicode by locale.
TerminalStyle stdout_style();
bool stderr_is_terminal();

/// From now on Ctrl-C sets a flag instead of ending the program; a second one ends it.
void catch_interrupts();
bool interrupted();
/// How often Ctrl-C was pressed so far.
int interrupts();
/// From now on Ctrl-C ends the program again.
void release_interrupts();

/// Progress of a long work on stderr: a bar on a terminal, a line every 2 s in a pipe, nothing with
/// `quiet` or with QUOLL_QUIET in the environment. Shows nothing for works under half a second.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(bool quiet, std::string_view unit = "steps");
  ~ProgressDisplay();
  void show(std::uint64_t done_now, std::uint64_t total, double seconds, const std::string& extra,
            std::uint64_t resumed = 0);

 private:
  bool quiet_;
  std::string_view unit_;
  bool shown_ = false;
  double last_ = 0.0;
};

}  // namespace quoll::cli
