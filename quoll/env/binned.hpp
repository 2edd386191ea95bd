#pragma once
// A world of observed numbers made tabular: each number falls into one of a few equal bins, and the
// state's number is the bins in mixed radix, the first number slowest. Tabular control by "boxes":
// Michie, Chambers 1968, "Boxes: an experiment in adaptive control".

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quoll/env/dynamics.hpp"
#include "quoll/env/measured.hpp"

namespace quoll {

/// What a struct must have to be binned: one Measured for each number of its observation.
template <class D>
concept HasMeasured = Dynamics<D> && HasObserve<D> && requires(const D d) {
  { d.measured() } -> std::same_as<std::vector<Measured>>;
};

class Bins {
 public:
  static constexpr std::size_t most_numbers = 16;

  /// From text like "6,6,12,12": one count from 1 up for each number. Error: what was expected.
  static Result<Bins> parse(std::string_view text, std::vector<Measured> numbers);

  State states() const { return states_; }
  /// The state of an observation of as many numbers; nan falls into the first bin.
  State number(std::span<const float> observation) const;
  /// Between which values the numbers lie, in their order, to four digits: "-0.8..0 0..1.5 ..-3"; a
  /// first bin has no lower end, a last one no upper.
  std::string name(State state) const;

 private:
  struct Cut {
    double low, per_unit;
    std::uint32_t count;
  };
  std::vector<Cut> cuts_;
  State states_ = 1;
};

/// The same world with numbered states beside its observations.
template <HasMeasured D>
struct Binned {
  using Position = typename D::Position;
  D world;
  Bins bins;

  Spaces spaces() const {
    Spaces spaces = world.spaces();
    spaces.states = bins.states();
    return spaces;
  }
  Position start(auto& dice) const { return world.start(dice); }
  Feedback step(Position& at, Action action, auto& dice) const {
    return world.step(at, action, dice);
  }
  void observe(const Position& at, std::span<float> x) const { world.observe(at, x); }
  State number(const Position& at) const {
    std::array<float, Bins::most_numbers> x;
    const std::span<float> seen(x.data(), world.spaces().observation);
    world.observe(at, seen);
    return bins.number(seen);
  }
  std::vector<std::string> action_names() const
    requires HasActionNames<D>
  {
    return world.action_names();
  }
  std::string text(const Position& at) const
    requires requires(const D d) { d.text(at); }
  {
    return world.text(at);
  }
  Drawing drawing(const Position& at) const
    requires requires(const D d) { d.drawing(at); }
  {
    return world.drawing(at);
  }
};

/// The world of a plain struct; with bins (text as Bins::parse takes it, empty = none) a tabular
/// one, whose moves are then uncertain.
template <HasMeasured D>
Result<World> to_world(std::string name, D dynamics, WorldFacts facts, const std::string& bins) {
  if (bins.empty()) return to_world(std::move(name), std::move(dynamics), facts);
  Result<Bins> parsed = Bins::parse(bins, dynamics.measured());
  if (!parsed) return parsed.error();
  facts.traits.deterministic = false;
  const auto state_name = [bins = *parsed](State state) { return bins.name(state); };
  World world =
      to_world(std::move(name), Binned<D>{std::move(dynamics), std::move(*parsed)}, facts);
  world.state_name = state_name;
  return world;
}

}  // namespace quoll
