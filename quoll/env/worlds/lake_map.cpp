#include "quoll/env/worlds/lake_map.hpp"

#include <utility>
#include <vector>

#include "quoll/base/file.hpp"
#include "quoll/base/numpy_random.hpp"
#include "quoll/base/text.hpp"

namespace quoll {
namespace {

// Whether the goal can be reached from the top left cell without entering a hole.
bool has_path(const LakeMap& map) {
  const std::size_t size = map.size();
  std::vector<std::uint8_t> seen(size * size);
  std::vector<std::size_t> open{0};
  seen[0] = 1;
  const auto visit = [&](std::size_t row, std::size_t column) {
    const std::size_t cell = row * size + column;
    if (seen[cell] || map[row][column] == 'H') return;
    seen[cell] = 1;
    open.push_back(cell);
  };
  while (!open.empty()) {
    const std::size_t row = open.back() / size, column = open.back() % size;
    open.pop_back();
    if (row + 1 < size) visit(row + 1, column);
    if (column + 1 < size) visit(row, column + 1);
    if (row > 0) visit(row - 1, column);
    if (column > 0) visit(row, column - 1);
  }
  return seen.back() != 0;
}

}  // namespace

Result<LakeMap> generated_lake(std::uint64_t size, double p, std::uint64_t seed) {
  constexpr std::uint64_t most_cells = 10'000'000;
  NumpyRandom random(seed);
  const double frozen = p / (p + (1.0 - p));  // running sums end in exactly 1
  LakeMap map(size, std::string(size, 'F'));
  for (std::uint64_t cells = 0; cells < most_cells; cells += size * size) {
    for (std::string& row : map) {
      for (char& letter : row) letter = frozen > random.random() ? 'F' : 'H';
    }
    map.front().front() = 'S';
    map.back().back() = 'G';
    if (has_path(map)) return map;
  }
  return Error{"--with p", 0, 0,
               "a larger probability of frozen cells expected: with " + shortest(p) +
                   " no map of this size had a path",
               ""};
}

Result<LakeMap> read_lake(const std::string& path) {
  const Result<std::string> content = read_file(path);
  if (!content) return content.error();
  LakeMap map;
  bool has_start = false;
  std::uint64_t number = 0;
  for (const std::string_view line : split(*content, '\n')) {
    ++number;
    if (line.empty()) continue;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (std::string_view("SFHG").find(line[i]) == std::string_view::npos) {
        return Error{path, number, i + 1,
                     "a letter S (start), F (frozen), H (hole) or G (goal) expected", ""};
      }
      has_start = has_start || line[i] == 'S';
    }
    if (!map.empty() && line.size() != map[0].size()) {
      return Error{path, number, 0,
                   "a row of " + counted(map[0].size(), "letter") +
                       " like the first expected, not " + std::to_string(line.size()),
                   ""};
    }
    map.emplace_back(line);
  }
  if (!has_start) return Error{path, 0, 0, "a start S expected", ""};
  return map;
}

}  // namespace quoll
