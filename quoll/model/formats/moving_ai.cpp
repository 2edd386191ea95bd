#include "quoll/model/formats/moving_ai.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/lines.hpp"

namespace quoll {
namespace {

constexpr std::uint64_t most_cells = 0xFFFF'FFFF;

class MapReader {
 public:
  MapReader(std::string_view content, const std::string& path)
      : content_(content), path_(path), lines_(content) {}

  Result<TerrainMap> read() {
    std::string_view line;
    bool in_map = false;
    while (!in_map && lines_.next(line)) {
      const std::string_view text = trim(line);
      if (text == "map")
        in_map = true;
      else if (!text.empty() && !read_header(line, text))
        return error_;
    }
    if (!in_map && lines_.error().empty()) {
      fail(0, "expected type, height, width and map, and then the rows");
      return error_;
    }
    if (in_map && (!measured() || !read_rows())) return error_;
    if (!lines_.error().empty()) return Error{path_, lines_.number(), 0, lines_.error(), ""};
    return std::move(map_);
  }

 private:
  bool fail(std::size_t column, std::string expected, std::string near = "") {
    error_ = {path_, lines_.number(), column, std::move(expected), std::move(near)};
    return false;
  }

  bool read_header(std::string_view line, std::string_view text) {
    static constexpr std::array<std::string_view, 4> keys = {"type", "height", "width", "map"};
    const std::size_t blank = text.find_first_of(" \t");
    const std::string_view key = text.substr(0, blank);
    const std::string_view value =
        blank == std::string_view::npos ? std::string_view() : trim(text.substr(blank));
    const auto column = static_cast<std::size_t>(text.data() - line.data()) + 1;
    if (key == "type") {
      if (value.starts_with("octile")) return true;
      return fail(column, "expected type octile, found '" + std::string(value) + "'");
    }
    if (key != "height" && key != "width") {
      return fail(column, "expected type, height, width or map, found '" + std::string(key) + "'",
                  nearest(key, keys));
    }
    const auto count = parse_count(value);
    if (!count || *count == 0 || *count > most_cells) {
      return fail(column, "expected a number of cells for " + std::string(key));
    }
    (key == "height" ? map_.rows : map_.columns) = static_cast<std::uint32_t>(*count);
    return true;
  }

  // The size is believed only if the file has the letters for it.
  bool measured() {
    if (map_.rows == 0 || map_.columns == 0) {
      return fail(
          0, std::string("expected ") + (map_.rows == 0 ? "height" : "width") + " above the rows");
    }
    if (std::uint64_t{map_.rows} * map_.columns > content_.size()) {
      return fail(0, "expected a map of " + std::to_string(map_.columns) + " x " +
                         std::to_string(map_.rows) + " cells, found a file of " +
                         std::to_string(content_.size()) + " bytes");
    }
    map_.cells.reserve(std::size_t{map_.rows} * map_.columns);
    return true;
  }

  bool read_rows() {
    std::string_view line;
    std::uint32_t rows = 0;
    while (lines_.next(line)) {
      if (rows == map_.rows) {
        if (trim(line).empty()) continue;
        return fail(1, "expected " + counted(map_.rows, "row") + " as height says, found more");
      }
      if (line.size() != map_.columns) {
        return fail(std::min<std::size_t>(line.size(), map_.columns) + 1,
                    "expected " + counted(map_.columns, "letter") + " as width says, found " +
                        std::to_string(line.size()));
      }
      for (std::size_t c = 0; c < line.size(); ++c) {
        const auto terrain = terrain_of(line[c]);
        if (!terrain) {
          return fail(c + 1, "expected one of . G S (ground) W (water) @ O T (blocked)");
        }
        map_.cells.push_back(*terrain);
      }
      ++rows;
    }
    if (rows == map_.rows || !lines_.error().empty()) return true;
    return fail(0, "expected " + counted(map_.rows, "row") + " as height says, found " +
                       std::to_string(rows));
  }

  static std::optional<Terrain> terrain_of(char letter) {
    switch (letter) {
      case '.':
      case 'G':
      case 'S':
        return Terrain::ground;
      case 'W':
        return Terrain::water;
      case '@':
      case 'O':
      case 'T':
        return Terrain::blocked;
      default:
        return std::nullopt;
    }
  }

  std::string_view content_;
  const std::string& path_;
  Lines lines_;
  TerrainMap map_;
  Error error_;
};

constexpr std::size_t fields_of_problem = 9;
using ProblemFields = std::array<std::string_view, fields_of_problem>;

// The fields of a line; how many there are, counting on beyond nine.
std::size_t split_fields(std::string_view line, ProblemFields& fields) {
  const bool tabs = line.find('\t') != std::string_view::npos;
  const std::string_view separators = tabs ? "\t" : " ";
  std::size_t count = 0;
  std::size_t at = line.find_first_not_of(separators);
  while (at != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
    if (count < fields_of_problem) fields[count] = trim(line.substr(at, end - at));
    ++count;
    at = line.find_first_not_of(separators, end);
  }
  return count;
}

Result<Problem> parse_problem(std::string_view line, const std::string& path,
                              std::uint64_t number) {
  static constexpr std::array<std::string_view, fields_of_problem> names = {
      "bucket", "map", "width", "height", "start x", "start y", "goal x", "goal y", "length"};
  ProblemFields fields;
  const std::size_t count = split_fields(line, fields);
  if (count != fields_of_problem) {
    return Error{path, number, 0,
                 "expected bucket, map, width, height, start x, start y, goal x, goal y and length "
                 "(9 fields), found " +
                     std::to_string(count),
                 ""};
  }
  Problem problem;
  problem.line = number;
  const std::array<std::uint32_t*, 6> numbers = {&problem.width,   &problem.height,
                                                 &problem.start_x, &problem.start_y,
                                                 &problem.goal_x,  &problem.goal_y};
  const auto wrong = [&](std::size_t field, const std::string& what) {
    const auto column = static_cast<std::size_t>(fields[field].data() - line.data()) + 1;
    return Error{path, number, column, "expected " + what + " for " + std::string(names[field]),
                 ""};
  };
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto value = parse_count(fields[i + 2]);
    if (!value || *value > most_cells) return wrong(i + 2, "a number of cells");
    *numbers[i] = static_cast<std::uint32_t>(*value);
  }
  const auto length = parse_number(fields[8]);
  if (!length || !(*length >= 0)) return wrong(8, "a number from 0");
  problem.length = *length;
  return problem;
}

struct MovingAiSettings : RobotSettings {
  std::string scen;
  std::uint64_t problem = 1;

  void describe(Describer& d) {
    RobotSettings::describe(d);
    d("scen", scen, "a file of problems (.scen); one of them gives goal and start");
    d("problem", problem, 1, 1e9, "which problem of that file, from 1");
  }
  std::string_view needs(std::string_view name) const {
    return name == "problem" && scen.empty() ? "scen=FILE" : RobotSettings::needs(name);
  }
};

// Goal and start of the problem asked for, where they are not given themselves.
Result<void> take_problem(MovingAiSettings& settings, const TerrainMap& map) {
  const Result<std::string> content = read_file(settings.scen);
  if (!content) return Error{settings.scen, 0, 0, content.error().expected, ""};
  const Result<std::vector<Problem>> problems = parse_problems(*content, settings.scen);
  if (!problems) return problems.error();
  if (settings.problem > problems->size()) {
    return Error{"--with problem", 0, 0,
                 "1 to " + std::to_string(problems->size()) + " expected, as " + settings.scen +
                     " has, not " + std::to_string(settings.problem),
                 ""};
  }
  const Problem& problem = (*problems)[settings.problem - 1];
  if (problem.width != map.columns || problem.height != map.rows) {
    return Error{settings.scen, problem.line, 0,
                 "expected a problem for a map of " + std::to_string(map.columns) + " x " +
                     std::to_string(map.rows) + " cells, found one for " +
                     std::to_string(problem.width) + " x " + std::to_string(problem.height),
                 ""};
  }
  const auto place = [](std::uint32_t x, std::uint32_t y) {
    return std::to_string(x) + "," + std::to_string(y);
  };
  if (settings.goal.empty()) settings.goal = place(problem.goal_x, problem.goal_y);
  if (settings.start.empty()) settings.start = place(problem.start_x, problem.start_y);
  return {};
}

}  // namespace

Result<TerrainMap> parse_moving_ai(std::string_view content, const std::string& path) {
  return MapReader(content, path).read();
}

Result<std::vector<Problem>> parse_problems(std::string_view content, const std::string& path) {
  Lines lines(content);
  std::vector<Problem> problems;
  std::string_view line;
  bool versioned = false;
  while (lines.next(line)) {
    if (trim(line).empty()) continue;
    if (!versioned && problems.empty() && trim(line).starts_with("version")) {
      const auto version = parse_number(trim(trim(line).substr(7)));
      if (!version || *version != 1) {
        return Error{path, lines.number(), 0, "expected version 1", ""};
      }
      versioned = true;
      continue;
    }
    const Result<Problem> problem = parse_problem(line, path, lines.number());
    if (!problem) return problem.error();
    problems.push_back(*problem);
  }
  if (!lines.error().empty()) return Error{path, lines.number(), 0, lines.error(), ""};
  if (problems.empty()) return Error{path, 0, 0, "expected at least one problem", ""};
  return problems;
}

Result<MdpArrays> read_moving_ai(std::string_view content, const std::string& path,
                                 const Parameters& given) {
  Result<MovingAiSettings> settings = read_parameters<MovingAiSettings>(path, given);
  if (!settings) return settings.error();
  const Result<TerrainMap> map = parse_moving_ai(content, path);
  if (!map) return map.error();
  if (!settings->scen.empty()) {
    const Result<void> taken = take_problem(*settings, *map);
    if (!taken) return taken.error();
  }
  return to_arrays(*map, *settings);
}

std::vector<ParameterText> moving_ai_parameters() {
  return parameters_of<MovingAiSettings>();
}

}  // namespace quoll
