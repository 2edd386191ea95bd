// Random mazes by depth-first search: the "recursive backtracker" without recursion.
//
//   rooms stand on a lattice, all unvisited; s := top left; visit s
//   1. while s has unvisited neighbours: choose one, n, at random; open the wall s-n;
//      remember that n was entered from s; s := n
//   2. otherwise go back to where s was entered from; stop when that was the first room
//   3. of the D rooms with one door choose round(braid * D) at random; open one more wall of each
//
// Steps 1 and 2 give a spanning tree, so that there is exactly one path between two rooms. The way
// back stands in two bits of each room, which is all the stack there is. s -> room, n -> neighbour,
// braid -> settings.braid

#include "quoll/model/maze.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "quoll/base/random.hpp"

namespace quoll {
namespace {

// Directions N E S W as 0..3; the opposite of d is d ^ 2.
class Rooms {
 public:
  explicit Rooms(std::uint32_t side) : side_(side), room_(std::size_t{side} * side, 0) {}

  std::uint32_t side() const { return side_; }
  std::size_t count() const { return room_.size(); }
  bool visited(std::size_t room) const { return (room_[room] & visited_bit) != 0; }
  bool door(std::size_t room, unsigned d) const { return (room_[room] >> d & 1) != 0; }
  unsigned came_from(std::size_t room) const { return room_[room] >> 4 & 3; }
  bool dead_end(std::size_t room) const {
    const unsigned doors = room_[room] & 15;
    return (doors & (doors - 1)) == 0;
  }

  bool has_neighbour(std::size_t room, unsigned d) const {
    const std::size_t row = room / side_;
    const std::size_t column = room % side_;
    return d == 0 ? row > 0 : d == 1 ? column + 1 < side_ : d == 2 ? row + 1 < side_ : column > 0;
  }
  std::size_t neighbour(std::size_t room, unsigned d) const {
    return d == 0 ? room - side_ : d == 1 ? room + 1 : d == 2 ? room + side_ : room - 1;
  }
  void visit(std::size_t room, unsigned back) {
    room_[room] = static_cast<unsigned char>(room_[room] | visited_bit | back << 4);
  }
  void open(std::size_t room, unsigned d) {
    const std::size_t other = neighbour(room, d);
    room_[room] = static_cast<unsigned char>(room_[room] | 1u << d);
    room_[other] = static_cast<unsigned char>(room_[other] | 1u << (d ^ 2));
  }

 private:
  static constexpr unsigned visited_bit = 64;
  std::uint32_t side_;
  std::vector<unsigned char> room_;  // bits 0-3 doors, 4-5 the way back, 6 visited
};

// One of the directions for which `allowed` holds, uniformly; 4 if there is none.
template <class Allowed>
unsigned choose(Rng& dice, Allowed allowed) {
  std::array<unsigned, 4> possible{};
  std::uint32_t count = 0;
  for (unsigned d = 0; d < 4; ++d) {
    if (allowed(d)) possible[count++] = d;
  }
  return count == 0 ? 4 : possible[dice.below(count)];
}

void carve(Rooms& rooms, Rng& dice) {
  std::size_t room = 0;
  rooms.visit(room, 0);
  while (true) {
    const unsigned d = choose(dice, [&](unsigned way) {
      return rooms.has_neighbour(room, way) && !rooms.visited(rooms.neighbour(room, way));
    });
    if (d < 4) {  // 1.
      rooms.open(room, d);
      room = rooms.neighbour(room, d);
      rooms.visit(room, d ^ 2);
    } else if (room != 0) {  // 2.
      room = rooms.neighbour(room, rooms.came_from(room));
    } else {
      return;
    }
  }
}

// Step 3. A dead end that another one's new door has opened already needs no more.
void open_dead_ends(Rooms& rooms, double share, Rng& dice) {
  std::vector<std::size_t> ends;
  for (std::size_t room = 0; room < rooms.count(); ++room) {
    if (rooms.dead_end(room)) ends.push_back(room);
  }
  const auto chosen =
      static_cast<std::size_t>(std::llround(share * static_cast<double>(ends.size())));
  for (std::size_t i = 0; i < chosen; ++i) {
    const std::size_t other = i + dice.below(static_cast<std::uint32_t>(ends.size() - i));
    std::swap(ends[i], ends[other]);
    if (!rooms.dead_end(ends[i])) continue;
    const unsigned d = choose(dice, [&](unsigned way) {
      return rooms.has_neighbour(ends[i], way) && !rooms.door(ends[i], way);
    });
    rooms.open(ends[i], d);
  }
}

// Rooms stand in every second row and column; with an even side the last ones are moved to the
// edge, behind a wall of two cells, so that start and goal stand in the corners.
std::vector<std::string> picture(const Rooms& rooms, std::size_t size) {
  const std::size_t side = rooms.side();
  const auto at = [&](std::size_t i) { return i + 1 < side ? 2 * i : size - 1; };
  std::vector<std::string> rows(size, std::string(size, '#'));
  for (std::size_t r = 0; r < side; ++r) {
    for (std::size_t c = 0; c < side; ++c) {
      const std::size_t room = r * side + c;
      rows[at(r)][at(c)] = '.';
      if (rooms.door(room, 1)) {
        for (std::size_t i = at(c) + 1; i < at(c + 1); ++i) rows[at(r)][i] = '.';
      }
      if (rooms.door(room, 2)) {
        for (std::size_t i = at(r) + 1; i < at(r + 1); ++i) rows[i][at(c)] = '.';
      }
    }
  }
  rows.front().front() = 'S';
  rows.back().back() = 'G';
  return rows;
}

}  // namespace

Grid make_maze(const MazeSettings& settings) {
  const auto size = static_cast<std::size_t>(settings.size);
  Rng dice = stream(settings.seed, "maze");
  Rooms rooms(static_cast<std::uint32_t>((size + 1) / 2));
  carve(rooms, dice);
  open_dead_ends(rooms, settings.braid, dice);
  Grid grid;
  grid.rows = picture(rooms, size);
  return grid;
}

}  // namespace quoll
