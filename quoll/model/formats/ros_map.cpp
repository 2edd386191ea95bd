#include "quoll/model/formats/ros_map.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/lines.hpp"

namespace quoll {
namespace {

constexpr std::array<std::string_view, 7> keys = {
    "image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"};

// YAML as map servers write it: "key: value" lines, comments, and a list in brackets or with one
// "- item" per line.
class RosMapReader {
 public:
  RosMapReader(std::string_view content, const std::string& path) : lines_(content), path_(path) {}

  Result<RosMap> read() {
    std::string_view line;
    while (lines_.next(line)) {
      const std::string_view text = trim(without_comment(line));
      if (text.empty() || text == "---" || text == "...") continue;
      if (!read_line(line, text)) return error_;
    }
    if (!lines_.error().empty()) return Error{path_, lines_.number(), 0, lines_.error(), ""};
    if (seen_.contains("origin") && origin_.size() != 3) {
      return Error{path_, 0, 0, "expected origin: [x, y, yaw]", ""};
    }
    for (const std::string_view key : {"image", "resolution"}) {
      if (!seen_.contains(key))
        return Error{path_, 0, 0, "expected the key " + std::string(key), ""};
    }
    if (!origin_.empty()) {
      map_.frame.x = origin_[0];
      map_.frame.y = origin_[1];
      map_.frame.yaw = origin_[2];
    }
    return std::move(map_);
  }

 private:
  // A '#' begins a comment at the front of the line or after a blank, and not in quotes.
  static std::string_view without_comment(std::string_view line) {
    char quote = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (quote != 0) {
        if (line[i] == quote) quote = 0;
      } else if (line[i] == '"' || line[i] == '\'') {
        quote = line[i];
      } else if (line[i] == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) {
        return line.substr(0, i);
      }
    }
    return line;
  }

  bool fail(std::size_t column, std::string expected, std::string near = "") {
    error_ = {path_, lines_.number(), column, std::move(expected), std::move(near)};
    return false;
  }

  bool read_line(std::string_view line, std::string_view text) {
    const auto column = static_cast<std::size_t>(text.data() - line.data()) + 1;
    if (in_origin_ && text.starts_with('-')) return read_origin(text.substr(1), column);
    const std::size_t colon = text.find(':');
    const std::string_view key = trim(text.substr(0, colon));
    const auto known = std::find(keys.begin(), keys.end(), key);
    if (colon == std::string_view::npos || known == keys.end()) {
      return fail(column,
                  "expected image, resolution, origin, negate, occupied_thresh, free_thresh or "
                  "mode with a colon, found '" +
                      std::string(key) + "'",
                  nearest(key, keys));
    }
    if (!seen_.insert(*known).second) {
      return fail(column, "expected one '" + std::string(key) + "', found a second");
    }
    const std::string_view value = trim(text.substr(colon + 1));
    in_origin_ = key == "origin" && value.empty();
    return in_origin_ || read_value(key, value, column);
  }

  bool read_value(std::string_view key, std::string_view value, std::size_t column) {
    const std::string_view word = unquoted(value);
    if (key == "image") {
      if (word.empty()) return fail(column, "expected the name of an image");
      map_.image = std::string(word);
      return true;
    }
    if (key == "mode") {
      map_.raw = word == "raw";
      const bool known = map_.raw || word == "trinary" || word == "scale";
      return known || fail(column, "expected mode: trinary, scale or raw");
    }
    if (key == "negate") {
      map_.negate = word == "1" || word == "true";
      const bool known = map_.negate || word == "0" || word == "false";
      return known || fail(column, "expected negate: 0 or 1");
    }
    if (key == "origin") {
      if (!value.starts_with('[') || !value.ends_with(']')) {
        return fail(column, "expected origin: [x, y, yaw]");
      }
      for (const std::string_view part : split(value.substr(1, value.size() - 2), ',')) {
        if (!read_origin(part, column)) return false;
      }
      return true;
    }
    return read_number(key, value, column);
  }

  bool read_number(std::string_view key, std::string_view value, std::size_t column) {
    const auto number = parse_number(value);
    if (key == "resolution") {
      if (!number || !(*number >= 1e-6 && *number <= 1e6)) {
        return fail(column, "expected a resolution in metres per pixel, 1e-6 to 1e6");
      }
      map_.frame.side = *number;
      return true;
    }
    if (!number || !(*number >= 0 && *number <= 1)) {
      return fail(column, "expected a number from 0 to 1 for " + std::string(key));
    }
    (key == "free_thresh" ? map_.free : map_.occupied) = *number;
    return true;
  }

  bool read_origin(std::string_view text, std::size_t column) {
    const auto number = parse_number(trim(text));
    if (!number || !(*number >= -1e9 && *number <= 1e9) || origin_.size() == 3) {
      return fail(column, "expected three numbers for origin: x, y and yaw");
    }
    origin_.push_back(*number);
    return true;
  }

  static std::string_view unquoted(std::string_view text) {
    const bool quoted = text.size() >= 2 && (text.front() == '"' || text.front() == '\'') &&
                        text.front() == text.back();
    return quoted ? text.substr(1, text.size() - 2) : text;
  }

  Lines lines_;
  const std::string& path_;
  RosMap map_;
  std::set<std::string_view> seen_;  // leads into keys
  std::vector<double> origin_;
  bool in_origin_ = false;
  Error error_;
};

struct RosMapSettings : RobotSettings {
  bool unknown = false;

  void describe(Describer& d) {
    RobotSettings::describe(d);
    d("unknown", unknown, "cells of unknown occupancy may be crossed");
  }
};

// The image's name as the YAML file means it: from the folder of that file.
std::string beside(const std::string& path, const std::string& image) {
  const std::size_t slash = path.find_last_of('/');
  if (image.starts_with('/') || slash == std::string::npos) return image;
  return path.substr(0, slash + 1) + image;
}

}  // namespace

Result<RosMap> parse_ros_map(std::string_view content, const std::string& path) {
  return RosMapReader(content, path).read();
}

TerrainMap to_terrain(const GrayImage& image, const RosMap& map, bool cross_unknown) {
  TerrainMap terrain;
  terrain.rows = image.height;
  terrain.columns = image.width;
  terrain.frame = map.frame;
  terrain.cells.reserve(image.levels.size());
  const auto white = static_cast<double>(image.white);
  for (const std::uint16_t level : image.levels) {
    double occupancy = map.negate ? level / white : (white - level) / white;
    bool known = true;
    if (map.raw) {
      occupancy = level / 100.0;
      known = level <= 100;
    }
    if (known && occupancy > map.occupied)
      terrain.cells.push_back(Terrain::blocked);
    else if ((known && occupancy < map.free) || cross_unknown)
      terrain.cells.push_back(Terrain::ground);
    else
      terrain.cells.push_back(Terrain::blocked);
  }
  return terrain;
}

Result<MdpArrays> read_ros_map(std::string_view content, const std::string& path,
                               const Parameters& given) {
  const Result<RosMapSettings> settings = read_parameters<RosMapSettings>(path, given);
  if (!settings) return settings.error();
  const Result<RosMap> map = parse_ros_map(content, path);
  if (!map) return map.error();
  const std::string image_path = beside(path, map->image);
  const Result<std::string> pixels = read_file(image_path);
  if (!pixels) return Error{image_path, 0, 0, pixels.error().expected, ""};
  const Result<GrayImage> image = parse_pgm(*pixels, image_path);
  if (!image) return image.error();
  return to_arrays(to_terrain(*image, *map, settings->unknown), *settings);
}

Result<MdpArrays> read_pgm_map(std::string_view content, const std::string& path,
                               const Parameters& given) {
  const Result<RosMapSettings> settings = read_parameters<RosMapSettings>(path, given);
  if (!settings) return settings.error();
  const Result<GrayImage> image = parse_pgm(content, path);
  if (!image) return image.error();
  TerrainMap terrain = to_terrain(*image, {}, settings->unknown);
  terrain.frame.reset();
  return to_arrays(terrain, *settings);
}

std::vector<ParameterText> ros_map_parameters() {
  return parameters_of<RosMapSettings>();
}

}  // namespace quoll
