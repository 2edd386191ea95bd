// Deep sea: a block falls through a triangle of cells, one row a move, and goes left or right as it
// falls. Right costs move_cost / size; only right all the way down meets the reward of 1 in the
// last cell. The best return is 1 - move_cost; a uniform policy finds the reward once in 2^size
// falls.
// Stochastic: right fails to move with probability 1 / size, and the two corners of the last row
// add noise of mean 0 and variance 1 to the reward, +1 or -1 with equal probability where the
// original draws from the normal distribution: a table has finitely many rewards.
// Osband, Van Roy, Russo, Wen 2019, "Deep exploration via randomized value functions"; bsuite
// (Osband et al. 2020), deep_sea.
// mapping_seed: which of the two actions is right is drawn for each cell, as in bsuite; 0 leaves
// left the first everywhere. Actions keep their true names, only their order differs.
// Cells off the triangle cannot be reached and are no states. State: its name, "r<row>c<column>",
// or "seabed", the end. One draw a step where right may fail or noise is added. Discount 1.

#include <array>
#include <utility>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/env/worlds/table_writer.hpp"

namespace quoll {
namespace {

struct Settings {
  std::uint64_t size = 10;
  bool stochastic = false;
  double move_cost = 0.01;
  std::uint64_t mapping_seed = 0;

  void describe(Describer& d) {
    d("size", size, 2, 5000, "rows, and columns of the last one");
    d("stochastic", stochastic, "right fails with probability 1 / size, and the ends are noisy");
    d("move_cost", move_cost, 0, 1, "cost of going right all the way");
    d("mapping_seed", mapping_seed, "draws which action is right in each cell; 0 = the second");
  }
};

struct Cell {
  std::uint32_t row, column;
};
State state_of(Cell cell) {
  return cell.row * (cell.row + 1) / 2 + cell.column;
}

class Sea {
 public:
  explicit Sea(const Settings& settings)
      : settings_(settings), size_(static_cast<std::uint32_t>(settings.size)) {
    table_.arrays().layout = Layout{size_ + 1, size_, {}, {{-1, 1}, {1, 1}}};
  }

  Result<Mdp> model() {
    Rng dice = stream(settings_.mapping_seed, "deep-sea");
    for (std::uint32_t row = 0; row < size_; ++row) {
      for (std::uint32_t column = 0; column <= row; ++column) {
        const bool swapped = settings_.mapping_seed != 0 && dice.below(2) == 1;
        add_state(cell_name(row, column), row * size_ + column);
        add_choice({row, column}, swapped);
        add_choice({row, column}, !swapped);
      }
    }
    add_state("seabed", size_ * size_);
    table_.arrays().action_names.push_back("left");
    table_.arrays().action_names.push_back("right");
    table_.start(0);
    return table_.finish();
  }

 private:
  void add_state(const std::string& name, std::uint32_t cell) {
    table_.state(name);
    table_.arrays().layout->cell.push_back(cell);
  }
  State below(Cell cell, std::uint32_t column) const {
    return cell.row + 1 == size_ ? size_ * (size_ + 1) / 2 : state_of({cell.row + 1, column});
  }
  void add_choice(Cell cell, bool right) {
    const bool last = cell.row + 1 == size_;
    const bool treasure = last && cell.column + 1 == size_;
    const double reward =
        (right ? -settings_.move_cost / size_ : 0.0) + (right && treasure ? 1.0 : 0.0);
    table_.choice(right ? 1 : 0);
    const State left_cell = below(cell, cell.column == 0 ? 0 : cell.column - 1);
    if (settings_.stochastic && last && (cell.column == 0 || treasure)) {
      table_.outcome(0.5, left_cell, reward + 1.0);
      table_.outcome(0.5, left_cell, reward - 1.0);
    } else if (!right) {
      table_.outcome(1.0, left_cell, reward);
    } else if (settings_.stochastic && !last) {
      table_.outcome(1.0 - 1.0 / size_, below(cell, cell.column + 1), reward);
      table_.outcome(1.0 / size_, below(cell, cell.column), reward);
    } else {
      table_.outcome(1.0, below(cell, cell.column + 1), reward);
    }
  }

  Settings settings_;
  std::uint32_t size_;
  TableWriter table_{1.0};
};

std::vector<std::string> picture_of(std::uint32_t size) {
  std::vector<std::string> picture;
  for (std::uint32_t row = 0; row < size; ++row) {
    picture.push_back(std::string(row + 1, '.') + std::string(size - row - 1, ' '));
  }
  picture.back().back() = 'G';
  picture.emplace_back(size, '_');
  return picture;
}

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("deep-sea", given);
  if (!settings) return settings.error();
  Result<Mdp> mdp = Sea(*settings).model();
  if (!mdp) return mdp.error();
  std::vector<std::uint32_t> cells = mdp->layout()->cell;
  return to_world(
      "deep-sea", std::move(*mdp),
      grid_looks(picture_of(static_cast<std::uint32_t>(settings->size)), std::move(cells)));
}

}  // namespace

extern const WorldEntry deep_sea_world;
const WorldEntry deep_sea_world{"deep-sea",
                                "",
                                "one reward at the end of a long fall, and each step away costs it",
                                "Osband et al. 2019; bsuite (Osband et al. 2020), deep_sea",
                                make,
                                parameters_of<Settings>};

}  // namespace quoll
