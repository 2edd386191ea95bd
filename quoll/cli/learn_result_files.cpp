// What a run folder tells of the result: seeds.csv, curve.svg, and event files for TensorBoard.

#include <cmath>
#include <filesystem>
#include <set>
#include <system_error>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/learn_files.hpp"
#include "quoll/cli/seeds_curve.hpp"
#include "quoll/report/curve_svg.hpp"
#include "quoll/report/tensorboard.hpp"

namespace quoll::cli {
namespace {

std::string seeds_csv(const RunResult& result) {
  std::string text =
      "seed,steps,episodes,stop,seconds,processor_seconds,reached_steps,reached_episodes,"
      "reached_processor_seconds,training_return,mean_return,mean_discounted,mean_steps,ended,"
      "evaluation_episodes\n";
  for (const SeedResult& seed : result.seeds) {
    std::string reached = ",,";
    if (seed.reached) {
      reached = std::to_string(seed.reached->steps) + "," + std::to_string(seed.reached->episodes) +
                "," + shortest(seed.reached->processor_seconds);
    }
    std::string played = ",,,";
    if (seed.played.episodes > 0) {
      played = shortest(seed.played.mean) + "," + shortest(seed.played.mean_discounted) + "," +
               shortest(seed.played.mean_steps) + "," + shortest(seed.played.ended);
    }
    text += std::to_string(seed.seed) + "," + std::to_string(seed.steps) + "," +
            std::to_string(seed.episodes) + "," + std::string(stop_name(seed.stop)) + "," +
            shortest(seed.seconds) + "," + shortest(seed.processor_seconds) + "," + reached + "," +
            (seed.training_return ? shortest(*seed.training_return) : "") + "," + played + "," +
            std::to_string(seed.played.episodes) + "\n";
  }
  return text;
}

// CleanRL's names for what records.csv calls otherwise; nothing = no curve of its own.
std::string_view tag_of(std::string_view name) {
  if (name == "episodic_return") return "charts/episodic_return";
  if (name == "processor_seconds") return "charts/SPS";
  if (name == "td_loss") return "losses/td_loss";
  if (name == "q_values") return "losses/q_values";
  return "";
}

// One seed's rows of records.csv as points. The rows of a step that come before its
// processor_seconds are told at that time as well.
std::vector<Scalar> scalars_of(std::string_view rows) {
  std::vector<Scalar> scalars;
  std::size_t timed = 0;
  double now = 0.0;
  for (const std::string_view row : split(rows, '\n')) {
    const std::vector<std::string_view> fields = split(row, ',');
    if (fields.size() != 4) continue;
    const auto step = parse_count(fields[0]);
    const auto value = parse_number(fields[3]);
    if (!step || !value) continue;
    const bool time = fields[2] == "processor_seconds";
    if (time) now = *value;
    const double shown = time ? static_cast<double>(*step) / now : *value;
    if (const std::string_view tag = tag_of(fields[2]); !tag.empty() && std::isfinite(shown)) {
      scalars.push_back({tag, *step, now, static_cast<float>(shown)});
    }
    for (; time && timed < scalars.size(); ++timed) scalars[timed].wall_time = now;
  }
  return scalars;
}

std::string seed_folder(std::uint64_t seed) {
  return "seed-" + std::to_string(seed);
}

constexpr const char* events_name = "events.out.tfevents.quoll";

// Events of an earlier run in this folder, of seeds that this one has not; nothing else.
void remove_other_seeds(const std::string& tensorboard, const Run& run) {
  std::set<std::string> ours;
  for (const Training& training : run.trainings()) ours.insert(seed_folder(training.seed()));
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(tensorboard, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("seed-", 0) != 0 || ours.count(name) > 0) continue;
    std::filesystem::remove(entry.path() / events_name, ignored);
    std::filesystem::remove(entry.path(), ignored);  // fails while there is more in it
  }
}

}  // namespace

Result<void> RunFiles::write_result(const Run& run, const RunResult& result) const {
  if (folder_.empty()) return {};
  const Result<void> written = write_file(in_folder("seeds.csv"), seeds_csv(result));
  return written ? write_curves(run) : written;
}

Result<void> RunFiles::write_curves(const Run& run) const {
  if (folder_.empty()) return {};
  const std::vector<Curve> curves{run.trainings().size() > 1 ? curve_over_seeds(run)
                                                             : curve_of(run.trainings().front())};
  const Picture picture =
      curve_svg({curves, run.world().name + ", " + run.settings().learn.method});
  Result<void> written = write_file(in_folder("curve.svg"), picture.svg);
  if (!written) return written;
  written = make_folder(in_folder("tensorboard"));
  if (!written) return written;
  remove_other_seeds(in_folder("tensorboard"), run);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::string folder = in_folder("tensorboard/" + seed_folder(run.trainings()[i].seed()));
    written = make_folder(folder);
    if (written) {
      written = write_file(folder + "/" + events_name, tensorboard_events(scalars_of(rows_[i])));
    }
    if (!written) return written;
  }
  return {};
}

}  // namespace quoll::cli
