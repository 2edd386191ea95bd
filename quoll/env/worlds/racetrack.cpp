// Racetrack: a car on a grid with a velocity of 0 to 4 cells a step upwards and to the right. An
// action changes each of the two by -1, 0 or +1; changes that would leave that range, or stop the
// car anywhere but on the starting line, are no actions. With probability `failure` the velocity
// stays as it was. -1 a step, discount 1. A car that leaves the track is put back on a random cell
// of the starting line with velocity 0; crossing the finish line is the end.
// Sutton, Barto 2018, "Reinforcement Learning", exercise 5.12, figure 5.5.
// The way of a step is looked at in max(up, right) equally long parts: after each the nearest cell
// counts (a half is rounded away from where the car came from), and the first one off the track or
// on the finish line decides. So no column is skipped, and no finish line is jumped over.
// Only states that can be reached are numbered, in order of discovery. State: its name,
// "r31c3u0r0" = row 31, column 3, up 0, right 0; the end is "finish". One draw a step and a start.

#include <algorithm>
#include <utility>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/env/worlds/racetrack_maps.hpp"

namespace quoll {
namespace {

constexpr std::uint32_t speeds = 5;

enum class Track : std::uint8_t { left, right };
constexpr std::string_view track_names[] = {"left", "right"};

struct Settings {
  Track track = Track::left;
  double failure = 0.1;

  void describe(Describer& d) {
    d.choice("track", track, track_names, "which track of figure 5.5");
    d("failure", failure, 0, 1, "probability that the velocity does not change");
  }
};

struct Car {
  std::uint32_t row, column, up, right;
};

// States are numbered as they are met, and a state's choices are added in that order.
class Race {
 public:
  Race(std::span<const std::string_view> track, double failure)
      : track_(track),
        columns_(static_cast<std::uint32_t>(track.front().size())),
        failure_(failure),
        number_(track.size() * columns_ * speeds * speeds, unknown) {}

  MdpArrays build() {
    finish_ = 0;
    a_.choice_begin = {0, 0};
    a_.outcome_begin = {0};
    a_.state_names.push_back("finish");
    cars_.push_back({0, columns_ - 1, 0, 0});
    for (std::uint32_t row = 0; row < track_.size(); ++row) {
      for (std::uint32_t column = 0; column < columns_; ++column) {
        if (track_[row][column] == 'S') a_.start.push_back(number({row, column, 0, 0}));
      }
    }
    for (int up = -1; up <= 1; ++up) {
      for (int right = -1; right <= 1; ++right) {
        a_.action_names.push_back("u" + signed_text(up) + "r" + signed_text(right));
      }
    }
    for (State s = 1; s < cars_.size(); ++s) add_choices(s);
    return std::move(a_);
  }
  /// Cells of the states, for pictures.
  std::vector<std::uint32_t> cells() const {
    std::vector<std::uint32_t> cells;
    for (const Car& car : cars_) cells.push_back(car.row * columns_ + car.column);
    return cells;
  }

 private:
  static constexpr State unknown = ~State{0};

  static std::string signed_text(int change) {
    return (change > 0 ? "+" : "") + std::to_string(change);
  }
  State number(const Car& car) {
    State& known =
        number_[((car.row * columns_ + car.column) * speeds + car.up) * speeds + car.right];
    if (known == unknown) {
      known = static_cast<State>(cars_.size());
      cars_.push_back(car);
      a_.state_names.push_back(cell_name(car.row, car.column) + "u" + std::to_string(car.up) + "r" +
                               std::to_string(car.right));
    }
    return known;
  }
  char letter(std::uint32_t row, std::uint32_t column) const { return track_[row][column]; }

  // 'F' when the way ends on the finish line, '#' when it leaves the track, else '.'.
  char drive(const Car& car, std::uint32_t up, std::uint32_t right) const {
    const std::uint32_t parts = std::max(up, right);
    for (std::uint32_t i = 1; i <= parts; ++i) {
      const std::uint32_t climbed = (2 * up * i + parts) / (2 * parts);
      const std::uint32_t column = car.column + (2 * right * i + parts) / (2 * parts);
      if (climbed > car.row || column >= columns_) return '#';
      const char met = letter(car.row - climbed, column);
      if (met == '#' || met == 'F') return met;
    }
    return '.';
  }

  void add_outcome(State next, double probability) {
    const auto begin = a_.next.begin() + static_cast<std::ptrdiff_t>(a_.outcome_begin.back());
    const auto same = std::find(begin, a_.next.end(), next);
    if (same != a_.next.end()) {
      const auto o = static_cast<std::size_t>(same - a_.next.begin());
      a_.probability.set(o, a_.probability[o] + probability);
      return;
    }
    a_.next.push_back(next);
    a_.probability.push_back(probability);
  }
  void add_step(const Car& car, std::uint32_t up, std::uint32_t right, double probability) {
    if (probability == 0.0) return;
    const char end = drive(car, up, right);
    if (end == 'F') {
      add_outcome(finish_, probability);
    } else if (end == '.') {
      add_outcome(number({car.row - up, car.column + right, up, right}), probability);
    } else {
      const double share = probability / static_cast<double>(a_.start.size());
      for (const State start : a_.start) add_outcome(start, share);
    }
  }
  void add_choices(State s) {
    const Car car = cars_[s];  // a copy: the list grows
    for (std::uint32_t action = 0; action < 9; ++action) {
      const std::uint32_t up = car.up + action / 3 - 1;  // -1 wraps: too large
      const std::uint32_t right = car.right + action % 3 - 1;
      if (up >= speeds || right >= speeds) continue;
      if (up == 0 && right == 0 && letter(car.row, car.column) != 'S') continue;
      add_step(car, up, right, 1.0 - failure_);
      add_step(car, car.up, car.right, failure_);
      a_.reward.push_back(-1.0);
      a_.action.push_back(action);
      a_.outcome_begin.push_back(a_.next.size());
    }
    a_.choice_begin.push_back(a_.action.size());
  }

  std::span<const std::string_view> track_;
  std::uint32_t columns_;
  double failure_;
  std::vector<State> number_;
  std::vector<Car> cars_;
  State finish_ = 0;
  MdpArrays a_;
};

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("racetrack", given);
  if (!settings) return settings.error();
  const std::span<const std::string_view> track =
      settings->track == Track::left ? std::span<const std::string_view>(left_track)
                                     : std::span<const std::string_view>(right_track);
  Race race(track, settings->failure);
  Result<Mdp> mdp = Mdp::make(race.build());
  if (!mdp) return mdp.error();
  return to_world("racetrack", std::move(*mdp),
                  grid_looks({track.begin(), track.end()}, race.cells()));
}

}  // namespace

extern const WorldEntry racetrack_world;
const WorldEntry racetrack_world{"racetrack",
                                 "",
                                 "drive round a bend as fast as the brakes allow",
                                 "Sutton, Barto 2018, exercise 5.12, figure 5.5",
                                 make,
                                 parameters_of<Settings>};

}  // namespace quoll
