#include "quoll/model/terrain.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "quoll/base/math.hpp"
#include "quoll/base/text.hpp"

namespace quoll {
namespace {

// Clockwise, so that the neighbours in the list are the neighbours on the compass.
struct Direction {
  std::string_view name;
  int right;
  int down;
};
constexpr std::array<Direction, 8> directions = {{{"N", 0, -1},
                                                  {"NE", 1, -1},
                                                  {"E", 1, 0},
                                                  {"SE", 1, 1},
                                                  {"S", 0, 1},
                                                  {"SW", -1, 1},
                                                  {"W", -1, 0},
                                                  {"NW", -1, -1}}};
using Compass = std::uint32_t;  // index into directions
constexpr Compass all_directions = 8;
// The straight moves come first, as in grids: of equally long ways the policy takes these.
constexpr std::array<Compass, 8> order = {0, 2, 4, 6, 1, 3, 5, 7};

constexpr Compass turned(Compass from, std::uint32_t eighths) {
  return (from + eighths) % all_directions;
}
constexpr std::uint32_t to_the_left = 7;
constexpr std::uint32_t to_the_right = 1;

constexpr State nobody = std::numeric_limits<State>::max();

// Which neighbours each cell leads to, one bit per direction. Every way leads back, too.
class Ways {
 public:
  explicit Ways(const TerrainMap& map) : map_(map), ways_(map.cells.size(), 0) {
    for (std::uint32_t r = 0; r < map.rows; ++r) {
      for (std::uint32_t c = 0; c < map.columns; ++c) {
        const std::size_t cell = std::size_t{r} * map.columns + c;
        if (map.cells[cell] == Terrain::blocked) continue;
        for (Compass d = 0; d < all_directions; ++d) {
          if (leads(r, c, d)) ways_[cell] |= static_cast<std::uint8_t>(1U << d);
        }
      }
    }
  }

  bool open(std::size_t cell, Compass d) const { return (ways_[cell] >> d & 1U) != 0; }
  std::size_t beside(std::size_t cell, Compass d) const {
    const auto step = std::ptrdiff_t{directions[d].down} * map_.columns + directions[d].right;
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell) + step);
  }

  // Per cell, whether there is a way to `goal`.
  std::vector<bool> joined(std::size_t goal) const {
    std::vector<bool> met(ways_.size(), false);
    std::vector<std::uint32_t> open_cells{static_cast<std::uint32_t>(goal)};
    met[goal] = true;
    while (!open_cells.empty()) {
      const std::size_t cell = open_cells.back();
      open_cells.pop_back();
      for (Compass d = 0; d < all_directions; ++d) {
        if (!open(cell, d)) continue;
        const std::size_t next = beside(cell, d);
        if (met[next]) continue;
        met[next] = true;
        open_cells.push_back(static_cast<std::uint32_t>(next));
      }
    }
    return met;
  }

 private:
  bool same(std::uint32_t row, std::uint32_t column, int right, int down) const {
    const auto r = static_cast<std::uint32_t>(static_cast<std::int64_t>(row) + down);
    const auto c = static_cast<std::uint32_t>(static_cast<std::int64_t>(column) + right);
    if (r >= map_.rows || c >= map_.columns) return false;  // -1 wraps: off the map
    const auto at = [&](std::uint32_t y, std::uint32_t x) {
      return map_.cells[std::size_t{y} * map_.columns + x];
    };
    return at(r, c) == at(row, column);
  }

  bool leads(std::uint32_t row, std::uint32_t column, Compass d) const {
    const auto [name, right, down] = directions[d];
    if (!same(row, column, right, down)) return false;
    return right == 0 || down == 0 || (same(row, column, right, 0) && same(row, column, 0, down));
  }

  const TerrainMap& map_;
  std::vector<std::uint8_t> ways_;
};

Error wrong_place(std::string_view key, const std::string& text, const std::string& why) {
  return Error{"--with " + std::string(key), 0, 0, why + ", not '" + text + "'", ""};
}

// "r3c14" -> row and column.
std::optional<std::pair<double, double>> named_cell(std::string_view text) {
  const std::size_t middle = text.find('c');
  if (text.empty() || text[0] != 'r' || middle == std::string_view::npos) return std::nullopt;
  const auto row = parse_count(text.substr(1, middle - 1));
  const auto column = parse_count(text.substr(middle + 1));
  if (!row || !column) return std::nullopt;
  return std::pair{static_cast<double>(*row), static_cast<double>(*column)};
}

// The cell a text names: its number row * columns + column.
Result<std::size_t> place(const TerrainMap& map, std::string_view key, const std::string& text) {
  std::pair<double, double> at;  // row, column
  if (const auto cell = named_cell(text)) {
    at = *cell;
  } else {
    const auto parts = split(text, ',');
    const auto x = parse_number(parts[0]);
    const auto y = parse_number(parts.size() == 2 ? parts[1] : "");
    if (!x || !y) return wrong_place(key, text, "x,y or a cell like r3c14 expected");
    if (map.frame) {
      const Layout::Frame& frame = *map.frame;
      const double east = *x - frame.x;
      const double north = *y - frame.y;
      const double cosine = math::cos(frame.yaw);
      const double sine = math::sin(frame.yaw);
      at.second = std::floor((cosine * east + sine * north) / frame.side);
      at.first = map.rows - 1 - std::floor((cosine * north - sine * east) / frame.side);
    } else {
      if (*x != std::floor(*x) || *y != std::floor(*y)) {
        return wrong_place(key, text, "whole numbers of cells expected");
      }
      at = {*y, *x};
    }
  }
  if (!(at.first >= 0 && at.first < map.rows && at.second >= 0 && at.second < map.columns)) {
    return wrong_place(key, text,
                       "a place on the map of " + std::to_string(map.columns) + " x " +
                           std::to_string(map.rows) + " cells expected");
  }
  const auto cell =
      static_cast<std::size_t>(at.first) * map.columns + static_cast<std::size_t>(at.second);
  if (map.cells[cell] == Terrain::blocked) {
    return wrong_place(key, text, "a cell that is not blocked expected");
  }
  return cell;
}

class RobotBuilder {
 public:
  RobotBuilder(const TerrainMap& map, const RobotSettings& robot, const Ways& ways,
               const std::vector<bool>& joined, std::size_t goal)
      : map_(map),
        robot_(robot),
        ways_(ways),
        goal_(goal),
        side_(map.frame ? map.frame->side : 1.0),
        diagonal_(side_ * std::sqrt(2.0)),
        number_(map.cells.size(), nobody) {
    for (std::size_t cell = 0; cell < joined.size(); ++cell) {
      if (!joined[cell]) continue;
      number_[cell] = static_cast<State>(cells_.size());
      cells_.push_back(static_cast<std::uint32_t>(cell));
    }
    const std::uint64_t choices = cells_.size() * (robot.heading ? 24 : 8);
    a_.choice_begin.reserve(cells_.size() * (robot.heading ? 8 : 1) + 1);
    a_.action.reserve(choices);
    a_.reward.reserve(choices);
    a_.next.reserve(robot.slip > 0 ? 3 * choices : choices);
  }

  MdpArrays build(std::optional<std::size_t> start) {
    for (const std::uint32_t cell : cells_) {
      if (robot_.heading)
        add_headings(cell);
      else
        add_cell(cell);
    }
    a_.choice_begin.push_back(a_.action.size());
    if (robot_.slip > 0) a_.outcome_begin.push_back(a_.next.size());
    if (start) {
      const Compass headings = robot_.heading ? all_directions : 1;
      for (Compass h = 0; h < headings; ++h) {
        a_.start.push_back(static_cast<State>(number_[*start] * headings + h));
      }
    }
    if (robot_.heading)
      name_headings();
    else
      name_cells();
    return std::move(a_);
  }

 private:
  double length(Compass d) const { return d % 2 == 0 ? side_ : diagonal_; }

  // The state a move in direction d leads to; `heading` is kept.
  State arrival(std::size_t cell, Compass d, Compass heading) const {
    const State to = number_[ways_.open(cell, d) ? ways_.beside(cell, d) : cell];
    return robot_.heading ? to * all_directions + heading : to;
  }

  void add_cell(std::size_t cell) {
    a_.choice_begin.push_back(a_.action.size());
    if (cell == goal_) return;
    for (std::uint32_t i = 0; i < all_directions; ++i) {
      if (ways_.open(cell, order[i])) add_move(cell, order[i], i, 0);
    }
  }

  void add_headings(std::size_t cell) {
    for (Compass h = 0; h < all_directions; ++h) {
      a_.choice_begin.push_back(a_.action.size());
      if (cell == goal_) continue;
      if (ways_.open(cell, h)) add_move(cell, h, 0, h);
      add_turn(cell, 1, turned(h, to_the_left));
      add_turn(cell, 2, turned(h, to_the_right));
    }
  }

  void add_move(std::size_t cell, Compass d, std::uint32_t action, Compass heading) {
    begin_choice(action);
    if (robot_.slip == 0) {
      add_outcome(arrival(cell, d, heading), 1.0, -length(d));
      return;
    }
    add_outcome(arrival(cell, d, heading), 1.0 - robot_.slip, -length(d));
    const Compass left = turned(d, to_the_left);
    const Compass right = turned(d, to_the_right);
    const State left_state = arrival(cell, left, heading);
    const State right_state = arrival(cell, right, heading);
    if (left_state == right_state) {  // both blocked
      add_outcome(left_state, robot_.slip, -length(left));
      return;
    }
    add_outcome(left_state, robot_.slip / 2, -length(left));
    add_outcome(right_state, robot_.slip / 2, -length(right));
  }

  void add_turn(std::size_t cell, std::uint32_t action, Compass heading) {
    begin_choice(action);
    add_outcome(number_[cell] * all_directions + heading, 1.0, -robot_.turn_cost * side_);
  }

  void begin_choice(std::uint32_t action) {
    a_.action.push_back(action);
    if (robot_.slip > 0) a_.outcome_begin.push_back(a_.next.size());
  }

  void add_outcome(State next, double probability, double reward) {
    a_.next.push_back(next);
    if (robot_.slip == 0) {
      a_.reward.push_back(reward);
      return;
    }
    a_.probability.push_back(probability);
    a_.outcome_reward.push_back(reward);
  }

  void name_cells() {
    Layout layout{map_.rows, map_.columns, cells_, {}, map_.frame};
    for (const Compass d : order) {
      a_.action_names.push_back(directions[d].name);
      layout.direction.emplace_back(directions[d].right, directions[d].down);
    }
    a_.layout = std::move(layout);
    a_.state_names = Names::cells(map_.columns, std::move(cells_));
  }

  void name_headings() {
    for (const std::string_view name : {"forward", "left", "right"}) {
      a_.action_names.push_back(name);
    }
    Layout layout{map_.rows, map_.columns, {}, {}, map_.frame};
    layout.cell.reserve(cells_.size() * all_directions);
    for (const std::uint32_t cell : cells_) {
      const std::string name = "r" + std::to_string(cell / map_.columns) + "c" +
                               std::to_string(cell % map_.columns) + "-";
      for (const Direction& d : directions) {
        a_.state_names.push_back(name + std::string(d.name));
        layout.cell.push_back(cell);
      }
    }
    a_.layout = std::move(layout);
  }

  const TerrainMap& map_;
  const RobotSettings& robot_;
  const Ways& ways_;
  std::size_t goal_;
  double side_, diagonal_;
  std::vector<State> number_;         // per cell: its place among cells_
  std::vector<std::uint32_t> cells_;  // with a way to the goal
  MdpArrays a_;
};

}  // namespace

Result<MdpArrays> to_arrays(const TerrainMap& map, const RobotSettings& robot) {
  if (map.cells.size() > max_states / (robot.heading ? all_directions : 1)) {
    return Error{"", 0, 0, "a map whose states are at most 2^31 - 1 expected", ""};
  }
  if (robot.goal.empty()) {
    return Error{"--with goal", 0, 0, "the place to go expected: --with goal=x,y", ""};
  }
  const Result<std::size_t> goal = place(map, "goal", robot.goal);
  if (!goal) return goal.error();
  const Ways ways(map);
  const std::vector<bool> joined = ways.joined(*goal);
  std::optional<std::size_t> start;
  if (!robot.start.empty()) {
    const Result<std::size_t> given = place(map, "start", robot.start);
    if (!given) return given.error();
    if (!joined[*given]) {
      return wrong_place("start", robot.start, "a cell with a way to the goal expected");
    }
    start = *given;
  }
  bool alone = true;
  for (Compass d = 0; d < all_directions; ++d) alone = alone && !ways.open(*goal, d);
  if (alone) return wrong_place("goal", robot.goal, "a cell that another leads to expected");
  return RobotBuilder(map, robot, ways, joined, *goal).build(start);
}

}  // namespace quoll
