#include "quoll/experiment/heat_log.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <vector>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"

namespace quoll {
namespace {

constexpr std::string_view head =
    "world,mode,entrant,seed,cap_steps,cap_seconds,end,steps,seconds,bytes";

std::string key_of(const HeatPlace& place, std::string_view settings, std::uint64_t seed) {
  return place.command + "," + std::string(race_mode_names[static_cast<std::size_t>(place.mode)]) +
         "," + std::string(settings) + "," + std::to_string(seed) + "," +
         std::to_string(place.cap_steps) + "," + shortest(place.cap_seconds);
}

std::string line_of(const std::string& key, const Heat& heat) {
  return key + "," + std::string(heat_end_names[static_cast<std::size_t>(heat.end)]) + "," +
         std::to_string(heat.steps) + "," + shortest(heat.seconds) + "," +
         std::to_string(heat.bytes) + "\n";
}

struct Line {
  std::string key;
  Heat heat;
};

std::optional<Line> parse(std::string_view text) {
  const std::vector<std::string_view> fields = split(text, ',');
  if (fields.size() != 10) return std::nullopt;
  const auto seed = parse_count(fields[3]), steps = parse_count(fields[7]),
             bytes = parse_count(fields[9]);
  const auto seconds = parse_number(fields[8]);
  const auto* const end =
      std::find(std::begin(heat_end_names), std::end(heat_end_names), fields[6]);
  if (!seed || !steps || !bytes || !seconds || end == std::end(heat_end_names)) return std::nullopt;
  std::size_t length = 0;
  for (int field = 0; field < 6; ++field) length = text.find(',', length) + 1;
  Heat heat{*seed, static_cast<HeatEnd>(end - heat_end_names), *steps, *seconds, *bytes};
  return Line{std::string(text.substr(0, length - 1)), heat};
}

}  // namespace

Result<HeatLog> HeatLog::open(const std::string& path) {
  HeatLog log;
  log.path_ = path;
  struct stat status{};
  if (stat(path.c_str(), &status) != 0) {
    const Result<void> begun = write_file(path, std::string(head) + "\n");
    if (!begun) return begun.error();
    return log;
  }
  const Result<std::string> content = read_file(path);
  if (!content) return content.error();
  const std::size_t whole = content->rfind('\n') + 1;  // npos + 1 = 0: not one whole line
  std::uint64_t number = 0;
  for (std::size_t from = 0; from < whole;) {
    const std::size_t to = content->find('\n', from);
    const std::string_view text = std::string_view(*content).substr(from, to - from);
    from = to + 1;
    if (++number == 1 && text == head) continue;
    const std::optional<Line> line = number == 1 ? std::nullopt : parse(text);
    if (!line) {
      return Error{path, number, 0, "a line '" + std::string(head) + "' of a race expected", ""};
    }
    log.heats_[line->key] = line->heat;
  }
  if (whole < content->size() || number == 0) {
    const std::string kept = number == 0 ? std::string(head) + "\n" : content->substr(0, whole);
    const Result<void> mended = write_file(path, kept);
    if (!mended) return mended.error();
  }
  return log;
}

const Heat* HeatLog::find(const HeatPlace& place, std::string_view settings,
                          std::uint64_t seed) const {
  const auto found = heats_.find(key_of(place, settings, seed));
  return found == heats_.end() ? nullptr : &found->second;
}

Result<void> HeatLog::add(const HeatPlace& place, std::string_view settings, const Heat& heat) {
  const std::string key = key_of(place, settings, heat.seed);
  heats_[key] = heat;
  const std::string line = line_of(key, heat);
  std::FILE* const file = std::fopen(path_.c_str(), "ab");
  const bool written =
      file != nullptr && std::fwrite(line.data(), 1, line.size(), file) == line.size();
  const bool closed = file != nullptr && std::fclose(file) == 0;
  if (written && closed) return {};
  return Error{path_, 0, 0, std::string("cannot be written: ") + std::strerror(errno), ""};
}

}  // namespace quoll
