// A large maze: loaded, solved exactly, and every distance compared with a breadth-first search
// written here, on the letters themselves:
//   ./dev bench maze [SIZE] [BRAID]
// The same by hand: quoll new maze --with size=1000 --with braid=0.5 -o maze.txt, quoll solve
// maze.txt

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/yardstick/stopwatch.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/maze.hpp"
#include "quoll/solve/solver.hpp"

namespace {

// Moves to the goal per cell in reading order, -1 for walls and cells that cannot reach it.
std::vector<int> distances(const std::vector<std::string>& rows) {
  const std::size_t height = rows.size(), width = rows[0].size();
  std::vector<int> distance(height * width, -1);
  std::vector<std::size_t> queue;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (rows[i / width][i % width] == 'G') {
      distance[i] = 0;
      queue.push_back(i);
    }
  }
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const std::size_t at = queue[head], row = at / width, column = at % width;
    const auto visit = [&](std::size_t r, std::size_t c) {
      const std::size_t to = r * width + c;
      if (rows[r][c] == '#' || distance[to] >= 0) return;
      distance[to] = distance[at] + 1;
      queue.push_back(to);
    };
    if (row > 0) visit(row - 1, column);
    if (row + 1 < height) visit(row + 1, column);
    if (column > 0) visit(row, column - 1);
    if (column + 1 < width) visit(row, column + 1);
  }
  return distance;
}

}  // namespace

int main(int argc, char** argv) {
  quoll::MazeSettings settings;
  settings.size = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000;
  settings.braid = argc > 2 ? std::atof(argv[2]) : 0.5;
  const quoll::Grid grid = quoll::make_maze(settings);
  const std::string text = quoll::to_text(grid);

  quoll::Result<quoll::Mdp> mdp = quoll::Error{};
  const double loading = yardstick::seconds([&] { mdp = quoll::parse_model(text, "maze.txt"); });
  if (!mdp) return std::printf("%s\n", quoll::message(mdp.error()).c_str()), 1;
  quoll::Result<quoll::Solution> solution = quoll::Error{};
  const double solving = yardstick::seconds([&] { solution = quoll::solve(*mdp); });
  if (!solution) return std::printf("%s\n", quoll::message(solution.error()).c_str()), 1;

  std::vector<int> distance;
  const double searching = yardstick::seconds([&] { distance = distances(grid.rows); });
  std::uint64_t open = 0, equal = 0;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (grid.rows[i / grid.rows[0].size()][i % grid.rows[0].size()] == '#') continue;
    const double value = -distance[i];
    equal += solution->lower[open] == value && solution->upper[open] == value;
    ++open;
  }
  std::printf("%zux%zu, %llu open cells, model %.1f MB\n", grid.rows.size(), grid.rows[0].size(),
              static_cast<unsigned long long>(open), static_cast<double>(mdp->bytes()) * 1e-6);
  std::printf("load %.3f s, solve %.3f s (%s), breadth-first search on the letters %.3f s\n",
              loading, solving, solution->method.c_str(), searching);
  std::printf("distances equal: %llu of %llu\n", static_cast<unsigned long long>(equal),
              static_cast<unsigned long long>(open));
  return equal == open ? 0 : 1;
}
