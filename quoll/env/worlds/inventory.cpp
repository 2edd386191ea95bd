// A stock of one product. Each month begins with a stock s; an order of a units arrives at once;
// then demand d comes, and what cannot be served is lost. Revenue is price per unit sold, less
// order_cost if anything is ordered, unit_cost per unit ordered and holding_cost per unit of s + a.
// Orders go up to the capacity, so that states have unequally many actions. No ends, discount 0.95,
// starts with any stock. The best policy is of (s, S) type: from s or less, order up to S.
// Puterman 1994, "Markov Decision Processes", sections 3.2 and 4.6.1; with capacity=3, demand=book
// (0, 1, 2 units with probabilities 1/4, 1/2, 1/4) this is the book's example to the digit.
// demand=poisson has mean `mean`; all demands of s + a and more are one outcome, so that nothing is
// cut off. State: its name, "stock-0", ... One draw a step.

#include <algorithm>
#include <utility>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/env/worlds/poisson.hpp"
#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

enum class Demand : std::uint8_t { poisson, book };
constexpr std::string_view demand_names[] = {"poisson", "book"};

struct Settings {
  std::uint64_t capacity = 20;
  Demand demand = Demand::poisson;
  double mean = 5.0;
  double price = 8.0;
  double order_cost = 4.0;
  double unit_cost = 2.0;
  double holding_cost = 1.0;

  void describe(Describer& d) {
    d("capacity", capacity, 1, 1000, "largest stock");
    d.choice("demand", demand, demand_names, "a month's demand: Poisson, or Puterman's 0, 1, 2");
    d("mean", mean, 0, 100, "mean of the Poisson demand");
    d("price", price, 0, 1e9, "revenue of a unit sold");
    d("order_cost", order_cost, 0, 1e9, "fixed cost of an order, K");
    d("unit_cost", unit_cost, 0, 1e9, "cost of a unit ordered");
    d("holding_cost", holding_cost, 0, 1e9, "cost of a unit in stock after ordering");
  }
  std::string_view needs(std::string_view name) const {
    return name == "mean" && demand != Demand::poisson ? "demand=poisson" : "";
  }
};

// Probabilities of demands 0, 1, ..., available - 1 and of all larger ones together.
std::vector<double> demands(const Settings& settings, std::uint32_t available) {
  if (settings.demand == Demand::poisson) return poisson_up_to(settings.mean, available);
  switch (available) {
    case 0:
      return {1.0};
    case 1:
      return {0.25, 0.75};
    default:
      return {0.25, 0.5, 0.25};
  }
}

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("inventory", given);
  if (!settings) return settings.error();
  const auto capacity = static_cast<State>(settings->capacity);
  MdpBuilder builder(0.95);
  for (State stock = 0; stock <= capacity; ++stock) builder.state("stock-" + std::to_string(stock));
  for (State order = 0; order <= capacity; ++order) {
    builder.action("order-" + std::to_string(order));
  }
  for (State stock = 0; stock <= capacity; ++stock) {
    for (State order = 0; stock + order <= capacity; ++order) {
      const State available = stock + order;
      const double cost = (order > 0 ? settings->order_cost : 0.0) + settings->unit_cost * order +
                          settings->holding_cost * available;
      const std::vector<double> demand = demands(*settings, available);
      for (State sold = 0; sold < demand.size(); ++sold) {
        if (demand[sold] == 0.0) continue;
        builder.move(stock, order, available - sold, settings->price * sold - cost, demand[sold]);
      }
    }
  }
  builder.layout(row_layout(capacity + 1, std::vector<std::pair<int, int>>(capacity + 1, {0, 0})));
  Result<Mdp> mdp = builder.build();
  if (!mdp) return mdp.error();
  return to_world("inventory", std::move(*mdp), row_looks(std::string(capacity + 1, '.')));
}

}  // namespace

extern const WorldEntry inventory_world;
const WorldEntry inventory_world{"inventory",
                                 "",
                                 "how much to order for an uncertain demand",
                                 "Puterman 1994, sections 3.2 and 4.6.1",
                                 make,
                                 parameters_of<Settings>};

}  // namespace quoll
