// The taxi: fetch a passenger at one of four places and bring him to another.
//
// Actions south 0, north 1, east 2, west 3, pickup 4, dropoff 5. -1 a step; -10 for a pickup or
// dropoff where it cannot be; +20 for the dropoff at the destination, which ends the episode;
// a dropoff at another of the places lets the passenger out there. States are
// ((row * 5 + column) * 5 + passenger) * 4 + destination. Step limit 200.
// rainy: a move that no wall stops goes where it should with rainy_probability, else to its left or
// its right; outcomes stand in that order.
// fickle: on the first move of the taxi with the passenger aboard he chooses, with
// fickle_probability, one of the other three destinations. Whether that move has been made belongs
// to the state, so 500 more states follow, named "...-settled"; the observation does not tell.
// States with a passenger who waits at his own destination are never met; a move onto his place is
// an end here, as the state is.
//
// Source: Dietterich 2000, "Hierarchical reinforcement learning with the MAXQ value function
// decomposition", JAIR 13, sections 2 and 7.1; Gymnasium, Taxi-v4.
// Draws: one uniform number a start and one a step. State for people: its name, "r2c3-R-to-G". With
// fickle and seeding=gymnasium a start draws once more whether the passenger will change his mind,
// and the change draws a whole number below 3; the state is then {"row", "column", "passenger",
// "destination", "mind"}, mind 0 = settled, 1 = will stay, 2 = will change, 3 = not yet drawn (when
// the state was set by number).

#include "quoll/env/worlds/taxi.hpp"

#include <algorithm>
#include <utility>

#include "quoll/env/dynamics.hpp"
#include "quoll/env/world.hpp"
#include "quoll/env/worlds/table_writer.hpp"

namespace quoll {
namespace {

struct TaxiSettings {
  bool rainy = false, fickle = false;
  double rainy_probability = 0.8, fickle_probability = 0.3;
  Seeding seeding = Seeding::quoll;

  void describe(Describer& describe) {
    describe("rainy", rainy, "whether a move may be pushed to a side");
    describe("fickle", fickle, "whether the passenger may change his destination once");
    describe("rainy_probability", rainy_probability, 0.0, 1.0,
             "with rainy: probability that a move goes where it should");
    describe("fickle_probability", fickle_probability, 0.0, 1.0,
             "with fickle: probability that the passenger changes his destination");
    describe.choice("seeding", seeding, seeding_names, "whose random numbers a seed gives");
  }
  std::string_view needs(std::string_view name) const {
    if (name == "rainy_probability" && !rainy) return "rainy=true";
    return name == "fickle_probability" && !fickle ? "fickle=true" : "";
  }
};

struct Way {
  double probability;
  CabMove move;
};

// What an action may do but for the passenger's mind, in Gymnasium's order.
std::vector<Way> ways(const TaxiSettings& settings, const Cab& cab, Action action) {
  const CabMove move = drive(cab, action);
  if (!settings.rainy || action > 3) return {{1.0, move}};
  const double side = (1.0 - settings.rainy_probability) / 2.0;
  const bool stands = move.cab == cab;
  const auto [left, right] = sides_of(action);
  return {{settings.rainy_probability, move},
          {side, stands ? move : drive(cab, left)},
          {side, stands ? move : drive(cab, right)}};
}

bool has_moved(const Cab& from, const Cab& to) {
  return from.row != to.row || from.column != to.column;
}

std::uint32_t other_place(std::uint32_t place, std::uint32_t index) {
  return index < place ? index : index + 1;
}

class TaxiTable {
 public:
  explicit TaxiTable(const TaxiSettings& settings) : settings_(settings), table_(0.99) {}

  Result<Mdp> model() {
    for (const State settled : {State{0}, cab_states}) {
      if (settled != 0 && !settings_.fickle) break;
      for (State s = 0; s < cab_states; ++s) add_state(cab_of(s), settled);
    }
    for (const std::string_view name : {"south", "north", "east", "west", "pickup", "dropoff"}) {
      table_.arrays().action_names.push_back(name);
    }
    return table_.finish();
  }

 private:
  void add_state(const Cab& cab, State settled) {
    table_.state(cab_name(cab) + (settled != 0 ? "-settled" : ""));
    if (settled == 0 && may_start(cab)) table_.start(cab_number(cab));
    if (has_arrived(cab)) return;
    for (Action a = 0; a < 6; ++a) {
      table_.choice(a);
      for (const Way& way : ways(settings_, cab, a)) {
        if (settings_.fickle && settled == 0 && cab.passenger == aboard &&
            has_moved(cab, way.move.cab)) {
          add_first_move(way);
        } else {
          table_.outcome(way.probability, cab_number(way.move.cab) + settled, way.move.reward);
        }
      }
    }
  }
  void add_first_move(const Way& way) {
    const double changes = settings_.fickle_probability;
    Cab cab = way.move.cab;
    const auto add = [&](double probability) {
      table_.outcome(way.probability * probability, cab_number(cab) + cab_states, way.move.reward);
    };
    add(1.0 - changes);
    const std::uint32_t first = cab.destination;
    for (std::uint32_t i = 0; i < 3; ++i) {
      cab.destination = other_place(first, i);
      add(changes / 3.0);
    }
  }

  const TaxiSettings& settings_;
  TableWriter table_;
};

// Gymnasium draws at the start whether the passenger will change his mind.
struct FickleTaxi {
  enum Mind : std::uint32_t { settled, stays, changes, open };
  struct Position {
    Cab cab;
    std::uint32_t mind = open;

    template <class A>
    void persist(A& archive) {
      archive("row", cab.row);
      archive("column", cab.column);
      archive("passenger", cab.passenger);
      archive("destination", cab.destination);
      archive("mind", mind);
      if (!archive.saving() && (cab.row > 4 || cab.column > 4 || cab.passenger > aboard ||
                                cab.destination > 3 || mind > open)) {
        archive.fail(
            "row, column and passenger at most 4, destination and mind at most 3 expected");
      }
    }
  };
  TaxiSettings settings;

  Spaces spaces() const { return {.actions = 6, .states = 2 * cab_states}; }
  Action actions(State s) const { return has_arrived(cab_of(s % cab_states)) ? 0 : 6; }
  State number(const Position& at) const {
    return cab_number(at.cab) + (at.mind == settled ? cab_states : 0);
  }
  Position position(State s) const {
    return {cab_of(s % cab_states), s < cab_states ? open : settled};
  }

  Position start(auto& dice) const {
    constexpr std::uint32_t starts = 300;
    const auto draw = dice.uniform();
    double sum = 0.0;
    Position at;
    for (State s = 0; s < cab_states && !(sum > draw); ++s) {
      if (!may_start(cab_of(s))) continue;
      sum += 1.0 / starts;
      at.cab = cab_of(s);
    }
    at.mind = chance(dice, settings.fickle_probability) ? changes : stays;
    return at;
  }
  Feedback step(Position& at, Action action, auto& dice) const {
    const auto draw = dice.uniform();
    if (has_arrived(at.cab)) return {0.0, true, false};
    const std::vector<Way> all = ways(settings, at.cab, action);
    std::size_t taken = 0;
    for (double sum = all[0].probability; taken + 1 < all.size() && !(sum > draw);) {
      sum += all[++taken].probability;
    }
    const CabMove& move = all[taken].move;
    const bool first_move =
        at.mind != settled && at.cab.passenger == aboard && has_moved(at.cab, move.cab);
    at.cab = move.cab;
    if (first_move) {
      if (at.mind == open) at.mind = chance(dice, settings.fickle_probability) ? changes : stays;
      if (at.mind == changes) at.cab.destination = other_place(at.cab.destination, dice.below(3));
      at.mind = settled;
    }
    return {move.reward, has_arrived(at.cab), false};
  }
  Tree observation(const Position& at) const { return Tree(std::int64_t{cab_number(at.cab)}); }
  std::string text(const Position& at) const { return cab_text(at.cab); }
  Drawing drawing(const Position& at) const { return cab_drawing(at.cab); }
};

Result<World> make(const Parameters& parameters) {
  const Result<TaxiSettings> settings = read_parameters<TaxiSettings>("taxi", parameters);
  if (!settings) return settings.error();
  Result<Mdp> mdp = TaxiTable(*settings).model();
  if (!mdp) return mdp.error();
  Looks looks;
  looks.text = [](State s) { return cab_text(cab_of(s % cab_states)); };
  looks.drawing = [](State s) { return cab_drawing(cab_of(s % cab_states)); };
  looks.observation = [](State s) { return Tree(std::int64_t{s % cab_states}); };
  constexpr std::uint64_t limit = 200;
  World world = to_world("taxi", std::move(*mdp), std::move(looks), limit, settings->seeding);
  if (settings->fickle && settings->seeding == Seeding::gymnasium) {
    world.make = [taxi = FickleTaxi{*settings}](Lanes lanes) {
      if (lanes.episode_steps == 0) lanes.episode_steps = limit;
      return batch(taxi, lanes, Seeding::gymnasium);
    };
  }
  return world;
}

}  // namespace

extern const WorldEntry taxi_world;
const WorldEntry taxi_world{"taxi",
                            "Taxi-v3 Taxi-v4",
                            "fetch a passenger and bring him to his destination",
                            "Dietterich 2000, JAIR 13; Gymnasium, Taxi-v4",
                            make,
                            parameters_of<TaxiSettings>};

}  // namespace quoll
