#include "quoll/cli/learn_files.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/same_world.hpp"
#include "quoll/experiment/config.hpp"

namespace quoll::cli {
namespace {

constexpr std::string_view records_header = "step,seed_index,name,value";

bool exists(const std::string& path) {
  struct stat status{};
  return stat(path.c_str(), &status) == 0;
}

// The folder that a new content of this file has to be written to; a link counts as its goal.
std::string folder_of(const std::string& path) {
  const std::unique_ptr<char, decltype(&std::free)> real(realpath(path.c_str(), nullptr),
                                                         &std::free);
  const std::string whole = real ? real.get() : path;
  const std::size_t slash = whole.find_last_of('/');
  return slash == std::string::npos ? "." : whole.substr(0, slash + 1);
}

// Whether the run can be written there when it has learned.
Result<void> ready(Run& run, const std::string& path) {
  struct stat status{};
  const bool there = stat(path.c_str(), &status) == 0;
  if (there && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) return {};  // written in place
  if (!there || status.st_size == 0 || S_ISDIR(status.st_mode)) return run.save(path);
  const auto old = load_archive(path, "run");
  if (!old) {
    Error error = old.error();
    error.expected += "; it is kept, choose another name or remove it";
    return error;
  }
  if (access(folder_of(path).c_str(), W_OK) != 0) {
    return Error{path, 0, 0, std::string("cannot be written: its folder: ") + std::strerror(errno),
                 ""};
  }
  return {};
}

// Whether two runs learn the same in the same way, however far they are.
bool same_run(const Run& one, const Run& other) {
  RunSettings first = one.settings(), second = other.settings();
  return check_same_world(one, "", other.world()) &&
         config_text(settings_of(first)) == config_text(settings_of(second));
}

}  // namespace

RunFiles::RunFiles(std::string save, std::string folder, std::string resumed)
    : save_(std::move(save)), folder_(std::move(folder)), resumed_(std::move(resumed)) {}

Result<void> RunFiles::prepare(Run& run) {
  rows_.assign(run.trainings().size(), "");
  if (!folder_.empty()) {
    const Result<void> prepared = prepare_folder(run);
    if (!prepared) return prepared;
  }
  return save_.empty() ? Result<void>() : ready(run, save_);
}

Result<void> RunFiles::prepare_folder(Run& run) {
  const Result<void> made = make_folder(folder_);
  if (!made) return made;
  for (const char* name : {"settings.toml", "records.csv"}) {
    if (exists(in_folder("run.quoll")) || !exists(in_folder(name))) continue;
    return Error{in_folder(name), 0, 0,
                 "stands in a folder without a run.quoll; it is kept, choose another folder or "
                 "remove it",
                 ""};
  }
  const std::string records = resumed_.empty() ? "" : records_of_resumed(run);
  if (!records.empty()) {
    const Result<void> taken = take_over(records, run);
    if (!taken) return taken;
  }
  return ready(run, in_folder("run.quoll"));
}

// Beside the resumed run if that lies in a run folder, else in the folder that is written if it
// holds the same run.
std::string RunFiles::records_of_resumed(const Run& run) const {
  const std::size_t slash = resumed_.find_last_of('/');
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  const std::string beside = resumed_.substr(0, name) + "records.csv";
  if (resumed_.substr(name) == "run.quoll" && exists(beside)) return beside;
  if (!exists(in_folder("records.csv"))) return "";
  const Result<Run> other = Run::load(in_folder("run.quoll"), false, &run.world());
  return other && same_run(run, *other) ? in_folder("records.csv") : "";
}

// The rows up to where each seed stands; what the file holds beyond is learned again.
Result<void> RunFiles::take_over(const std::string& path, const Run& run) {
  const Result<std::string> content = read_file(path);
  if (!content) return content.error();
  std::uint64_t number = 0;
  for (const std::string_view line : split(*content, '\n')) {
    const bool header = ++number == 1;
    if (header ? line == records_header : line.empty()) continue;
    const std::vector<std::string_view> fields = split(line, ',');
    const bool whole = !header && fields.size() == 4;
    const auto step = whole ? parse_count(fields[0]) : std::nullopt;
    const auto index = whole ? parse_count(fields[1]) : std::nullopt;
    if (!step || !index) {
      return Error{path, number, 0,
                   "a line of records, " + std::string(records_header) + ", expected", ""};
    }
    if (*index >= rows_.size()) continue;
    if (*step > run.trainings()[*index].learner().progress().steps) continue;
    rows_[*index] += std::string(line) + "\n";
  }
  return {};
}

void RunFiles::record(const Record& record) {
  rows_[record.lane] += std::to_string(record.step) + "," + std::to_string(record.lane) + "," +
                        std::string(record.name) + "," + shortest(record.value) + "\n";
}

Result<void> RunFiles::save(Run& run) const {
  return save_.empty() ? Result<void>() : run.save(save_);
}

Result<void> RunFiles::write_folder(Run& run) const {
  if (folder_.empty()) return {};
  const Result<void> saved = run.save(in_folder("run.quoll"));
  if (!saved) return saved;
  RunSettings settings = run.settings();
  const Result<void> written =
      write_file(in_folder("settings.toml"), config_text(settings_of(settings)));
  if (!written) return written;
  std::string records = std::string(records_header) + "\n";
  for (const std::string& rows : rows_) records += rows;
  return write_file(in_folder("records.csv"), records);
}

}  // namespace quoll::cli
