#pragma once
// The files of a run that learns: --save FILE, and the run folder of -o.

#include <string>
#include <vector>

#include "quoll/experiment/run.hpp"

namespace quoll::cli {

/// Where a run is written. prepare() before learning, record() while it goes on, write() after it.
class RunFiles {
 public:
  /// `save` = a file, `folder` = a run folder, `resumed` = the file the run came from; each may be
  /// empty.
  RunFiles(std::string save, std::string folder, std::string resumed);

  /// Finds out whether everything can be written, and takes over the records that the resumed run
  /// left. An existing file must be an intact run; where there is none yet, the run is written as
  /// it stands. Error: nothing that was there has been touched.
  Result<void> prepare(Run& run);

  /// Takes one record; they are written sorted by index of the seed, then step.
  void record(const Record& record);
  bool has_folder() const { return !folder_.empty(); }

  /// The file of --save, if there is one.
  Result<void> save(Run& run) const;
  /// The folder, if there is one: run.quoll, settings.toml, records.csv.
  Result<void> write_folder(Run& run) const;
  /// How it goes, in the same folder: curve.svg, and the records for TensorBoard,
  /// tensorboard/seed-N/, with time as seconds of the processor.
  Result<void> write_curves(const Run& run) const;
  /// What became of the run: seeds.csv, a line for each seed, and the curves.
  Result<void> write_result(const Run& run, const RunResult& result) const;

 private:
  Result<void> prepare_folder(Run& run);
  Result<void> take_over(const std::string& path, const Run& run);
  std::string records_of_resumed(const Run& run) const;
  std::string in_folder(const std::string& name) const { return folder_ + "/" + name; }

  std::string save_, folder_, resumed_;
  std::vector<std::string> rows_;  ///< lines of records.csv, per index of the seed
};

}  // namespace quoll::cli
