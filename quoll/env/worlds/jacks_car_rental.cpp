// Jack's car rental: two locations, at most 20 cars each. Overnight up to 5 cars are moved for 2
// each; the next day customers rent for 10 each as long as there are cars, and returned cars can be
// rented out from the day after. Requests are Poisson of mean 3 and 4, returns of mean 3 and 2;
// cars beyond 20 go back to the company. Nothing is cut off: requests of all cars or more are one
// event, and so are returns that fill the location. No ends, discount 0.9, starts in any state.
// Sutton, Barto 2018, "Reinforcement Learning", example 4.2, figure 4.2. modified: exercise 4.7,
// one car goes from the first to the second location for nothing, and more than 10 cars kept
// overnight at a location cost 4. The reward is the expected one of the day, given what was moved:
// the table has one outcome for each pair of stocks in the evening, not for each number of
// customers. State: its name, "a3b5" = 3 cars at the first location and 5 at the second in the
// evening. One draw a step.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/env/worlds/poisson.hpp"

namespace quoll {
namespace {

constexpr std::uint32_t most_cars = 20;
constexpr std::uint32_t side = most_cars + 1;
constexpr int most_moved = 5;
constexpr std::uint32_t rows_of_parking = 10;  // cars that need no second parking lot

struct Settings {
  bool modified = false;

  void describe(Describer& d) {
    d("modified", modified, "exercise 4.7: a free shuttle, and parking beyond 10 cars costs 4");
  }
};

// A day at one location: by the number of cars in the morning.
struct Location {
  std::array<std::array<double, side>, side> evening{};  // probability of cars in the evening
  std::array<double, side> rented{};                     // expected number

  Location(double requests, double returns) {
    for (std::uint32_t morning = 0; morning <= most_cars; ++morning) {
      const std::vector<double> request = poisson_up_to(requests, morning);
      for (std::uint32_t out = 0; out <= morning; ++out) {
        rented[morning] += out * request[out];
        const std::uint32_t left = morning - out;
        const std::vector<double> back = poisson_up_to(returns, most_cars - left);
        for (std::uint32_t in = 0; left + in <= most_cars; ++in) {
          evening[morning][left + in] += request[out] * back[in];
        }
      }
    }
  }
};

class Rental {
 public:
  explicit Rental(bool modified) : modified_(modified) {}

  MdpArrays build() {
    a_.discount = 0.9;
    a_.choice_begin.push_back(0);
    a_.outcome_begin.push_back(0);
    a_.layout = Layout{side, side, {}, {}};
    for (int moved = -most_moved; moved <= most_moved; ++moved) {
      a_.action_names.push_back(moved == 0 ? std::string("none")
                                           : (moved > 0 ? "a-to-b-" : "b-to-a-") +
                                                 std::to_string(std::abs(moved)));
      a_.layout->direction.emplace_back(0, 0);
    }
    for (std::uint32_t a = 0; a <= most_cars; ++a) {
      for (std::uint32_t b = 0; b <= most_cars; ++b) {
        for (int moved = -most_moved; moved <= most_moved; ++moved) {
          const int from = static_cast<int>(moved > 0 ? a : b);
          if (std::abs(moved) <= from) add_night(a, b, moved);
        }
        a_.choice_begin.push_back(a_.action.size());
        a_.state_names.push_back("a" + std::to_string(a) + "b" + std::to_string(b));
        a_.layout->cell.push_back((most_cars - a) * side + b);
      }
    }
    return std::move(a_);
  }

 private:
  static std::uint32_t after(std::uint32_t cars, int change) {
    return std::min(static_cast<std::uint32_t>(static_cast<int>(cars) + change), most_cars);
  }
  double night_cost(std::uint32_t a, std::uint32_t b, int moved) const {
    if (!modified_) return 2.0 * std::abs(moved);
    const int paid = moved > 0 ? moved - 1 : -moved;
    return 2.0 * paid + (a > rows_of_parking ? 4.0 : 0.0) + (b > rows_of_parking ? 4.0 : 0.0);
  }
  void add_night(std::uint32_t a_cars, std::uint32_t b_cars, int moved) {
    const std::uint32_t a = after(a_cars, -moved);
    const std::uint32_t b = after(b_cars, moved);
    for (std::uint32_t i = 0; i < side; ++i) {
      for (std::uint32_t j = 0; j < side; ++j) {
        a_.next.push_back(i * side + j);
        a_.probability.push_back(first_.evening[a][i] * second_.evening[b][j]);
      }
    }
    a_.reward.push_back(10.0 * (first_.rented[a] + second_.rented[b]) - night_cost(a, b, moved));
    a_.action.push_back(static_cast<std::uint32_t>(moved + most_moved));
    a_.outcome_begin.push_back(a_.next.size());
  }

  bool modified_;
  Location first_{3.0, 3.0};
  Location second_{4.0, 2.0};
  MdpArrays a_;
};

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("jacks-car-rental", given);
  if (!settings) return settings.error();
  Result<Mdp> mdp = Mdp::make(Rental(settings->modified).build());
  if (!mdp) return mdp.error();
  std::vector<std::uint32_t> cells = mdp->layout()->cell;
  return to_world(
      "jacks-car-rental", std::move(*mdp),
      grid_looks(std::vector<std::string>(side, std::string(side, '.')), std::move(cells)));
}

}  // namespace

extern const WorldEntry jacks_car_rental_world;
const WorldEntry jacks_car_rental_world{"jacks-car-rental",
                                        "",
                                        "how many cars to move overnight between two locations",
                                        "Sutton, Barto 2018, example 4.2, exercise 4.7",
                                        make,
                                        parameters_of<Settings>};

}  // namespace quoll
