#include "quoll/learn/deep/deep_setup.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <tuple>

#include "quoll/base/text.hpp"
#include "quoll/learn/value_range.hpp"

namespace quoll {
namespace {

// The index of a word among `names`, or `habit` for "auto".
template <class Enum, std::size_t n>
Result<Enum> word(std::string_view text, const std::string_view (&names)[n], Enum habit,
                  std::string_view flag) {
  if (text == "auto") return habit;
  const auto* const found = std::find(std::begin(names), std::end(names), text);
  if (found != std::end(names)) return static_cast<Enum>(found - std::begin(names));
  std::string list = "auto";
  for (const std::string_view name : names) list += ", " + std::string(name);
  return Error{std::string(flag), 0, 0,
               "one of " + list + " expected, not '" + std::string(text) + "'",
               nearest(text, std::span<const std::string_view>(names))};
}

std::vector<std::string_view> parts(std::string_view text) {
  std::vector<std::string_view> list;
  if (text == "none" || text.empty()) return list;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = text.find(',', begin);
    list.push_back(text.substr(begin, comma - begin));
    if (comma == std::string_view::npos) return list;
    begin = comma + 1;
  }
}

constexpr std::uint64_t most_units = 65536;

std::optional<std::uint32_t> count(std::string_view text) {
  std::uint32_t number = 0;
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = wrong == std::errc() && end == text.data() + text.size();
  if (!whole || number == 0 || number > most_units) return std::nullopt;
  return number;
}

// "16x3" or "32x8/4".
std::optional<nn::LayerSpec> convolution(std::string_view text) {
  const std::size_t cross = text.find('x'), slash = text.find('/');
  if (cross == std::string_view::npos) return std::nullopt;
  const auto units = count(text.substr(0, cross));
  const auto kernel = count(text.substr(
      cross + 1, slash == std::string_view::npos ? std::string_view::npos : slash - cross - 1));
  const auto stride = slash == std::string_view::npos ? std::optional<std::uint32_t>(1)
                                                      : count(text.substr(slash + 1));
  if (!units || !kernel || !stride) return std::nullopt;
  nn::LayerSpec layer;
  layer.units = *units;
  layer.kernel = *kernel;
  layer.stride = *stride;
  return layer;
}

Result<std::vector<nn::LayerSpec>> layers(const DeepSettings& settings, const Spaces& spaces,
                                          const DeepHabits& habits) {
  std::vector<nn::LayerSpec> list;
  const bool planes = spaces.shape[0] > 0;
  std::string_view filters = settings.filters;
  // A layout that reads the action beside the state reads a list of numbers.
  const bool joint = settings.layout == NetworkLayout::joint;
  if (filters == "auto") filters = planes && !joint ? habits.filters : "none";
  for (const std::string_view part : parts(filters)) {
    const auto layer = convolution(part);
    if (!layer) {
      return Error{
          "--filters", 0, 0,
          "COUNTxSIZE or COUNTxSIZE/STRIDE expected, such as 16x3, not '" + std::string(part) + "'",
          ""};
    }
    if (!planes) {
      return Error{"--filters", 0, 0,
                   "convolutions read worlds of planes; what is observed here is a list of numbers",
                   "none"};
    }
    if (joint) {
      return Error{
          "--filters", 0, 0,
          "convolutions read planes alone, but --layout joint reads the action beside them",
          "none"};
    }
    list.push_back(*layer);
  }
  std::string_view hidden = settings.hidden;
  if (hidden == "auto") {
    hidden =
        list.empty() || habits.hidden_of_planes.empty() ? habits.hidden : habits.hidden_of_planes;
  }
  for (const std::string_view part : parts(hidden)) {
    const auto units = count(part);
    if (!units) {
      return Error{"--hidden", 0, 0,
                   "sizes from 1 to " + std::to_string(most_units) +
                       " expected, such as 120,84, or none, not '" + std::string(part) + "'",
                   ""};
    }
    nn::LayerSpec layer;
    layer.units = *units;
    list.push_back(layer);
  }
  const auto activation =
      word(settings.activation, nn::activation_names, habits.activation, "--activation");
  if (!activation) return activation.error();
  const bool norm = settings.layer_norm == Switch::automatic ? habits.layer_norm
                                                             : settings.layer_norm == Switch::on;
  for (nn::LayerSpec& layer : list) {
    layer.activation = *activation;
    if (norm) {
      layer.normalisation = layer.convolution() && !habits.plain_norm ? nn::Normalisation::channels
                                                                      : nn::Normalisation::sample;
      layer.gain = !habits.plain_norm;
    }
  }
  return list;
}

void fill_in(DeepSettings& settings, const DeepHabits& habits, bool observed) {
  const auto usual = [](std::uint64_t& value, std::uint64_t habit) {
    if (value == 0) value = habit;
  };
  usual(settings.batch, habits.batch);
  usual(settings.replay, habits.replay);
  usual(settings.train_every, habits.train_every);
  usual(settings.gradient_steps, habits.gradient_steps);
  usual(settings.target_every, habits.target_every);
  usual(settings.rollout, habits.rollout);
  usual(settings.minibatches, habits.minibatches);
  usual(settings.epochs, habits.epochs);
  usual(settings.fits, habits.fits);
  usual(settings.multi_step, observed ? habits.multi_step : 1);
  if (settings.return_decay < 0.0) settings.return_decay = habits.return_decay;
  if (settings.clip_gradient < 0.0) settings.clip_gradient = habits.clip_gradient;
}

// Networks learn best what is about as large as 1, and Huber's loss finds the mean of what differs
// by less than 1. Ranges of distributions are as they are said.
double usual_scale(const DeepSetup& deep, const World& world) {
  if (!world.traits.reward_bounds || deep.settings.returns == Returns::categorical) return 1.0;
  const auto [low, high] = *world.traits.reward_bounds;
  const double largest = std::max(std::fabs(low), std::fabs(high));
  const bool bends = deep.loss == nn::LossKind::huber && deep.settings.returns == Returns::mean;
  const double small = 0.01, large = bends ? 1.0 : 1000.0;
  if (largest > large) return large / largest;
  return largest > 0.0 && largest < small ? 1.0 / largest : 1.0;
}

// A row of numbers, planes, or one number for each state.
nn::Extent input_of(const Spaces& spaces) {
  if (spaces.shape[0] > 0) return {spaces.shape[0], spaces.shape[1], spaces.shape[2]};
  return {1, 1, spaces.observation > 0 ? spaces.observation : spaces.states};
}

// What the network reads.
Result<void> find_input(DeepSetup& deep, const LearnSetup& setup, const DeepHabits& habits) {
  deep.spaces = setup.world->make({})->spaces();
  if (habits.by_state && deep.spaces.states > 0) {
    deep.spaces.observation = 0;
    deep.spaces.shape = {};
  }
  deep.input = input_of(deep.spaces);
  deep.actions = deep.spaces.actions;
  if (deep.settings.inputs == Scaling::letters) {
    const auto letters = NameLetters::make(*setup.world, deep.spaces);
    if (!letters) return letters.error();
    deep.letters = *letters;
    deep.input = {1, 1, static_cast<std::uint32_t>(deep.letters->size())};
    deep.actions = static_cast<std::uint32_t>(deep.letters->outputs());
  }
  constexpr std::size_t most_inputs = std::size_t{1} << 20;
  if (deep.input.size() > 0 && deep.input.size() <= most_inputs) return {};
  return Error{"", 0, 0,
               "a network reads 1 to " + std::to_string(most_inputs) + " numbers; " +
                   setup.world->name + " shows " + std::to_string(deep.input.size()),
               ""};
}

// How its weights begin and step.
Result<void> find_steps(DeepSetup& deep, const DeepHabits& habits) {
  const DeepSettings& settings = deep.settings;
  const auto initial =
      word(settings.initial_weights, nn::initial_names, habits.initial, "--initial-weights");
  if (!initial) return initial.error();
  deep.initial = *initial;
  const auto optimiser =
      word(settings.optimiser, nn::optimiser_names, habits.optimiser, "--optimiser");
  if (!optimiser) return optimiser.error();
  deep.optimiser.kind = *optimiser;
  deep.optimiser.epsilon = settings.optimiser_epsilon;
  deep.optimiser.decay = settings.gradient_decay;
  const bool listed = deep.spaces.observation == 0;
  const auto loss =
      word(settings.loss, nn::loss_names, listed ? habits.loss_of_states : habits.loss, "--loss");
  if (!loss) return loss.error();
  deep.loss = *loss;
  const auto rate = parse_schedule(
      settings.learning_rate == "auto" ? habits.learning_rate : settings.learning_rate, 0.0, 1e6,
      "--learning-rate");
  if (!rate) return rate.error();
  deep.learning_rate = *rate;
  const auto correction =
      parse_schedule(settings.priority_correction, 0.0, 1.0, "--priority-correction");
  if (!correction) return correction.error();
  deep.priority_correction = *correction;
  return {};
}

// The values that atoms of C51 stand for: all that the world's rewards allow, if nobody says.
Result<void> find_support(DeepSetup& deep, const LearnSetup& setup) {
  double &low = deep.settings.lowest_return, &high = deep.settings.highest_return;
  if (low < high) return {};
  if (low != 0.0 || high != 0.0) {
    return Error{"--lowest-return", 0, 0, "less than --highest-return expected", ""};
  }
  const auto rewards = reward_range(*setup.world, "");
  if (*rewards) std::tie(low, high) = value_range(**rewards, setup.discount);
  low = std::min(low, 0.0);  // an episode may be cut, or have no step
  high = std::max(high, 0.0);
  if (setup.world->traits.players > 1) {
    high = std::max(high, -low);
    low = -high;
  }
  low *= deep.settings.reward_scale;
  high *= deep.settings.reward_scale;
  if (std::isfinite(low) && std::isfinite(high) && low < high) return {};
  return Error{"--highest-return", 0, 0,
               std::string("categorical returns need a range, and ") +
                   (*rewards ? "the discount " + shortest(setup.discount) + " gives them no bound"
                             : setup.world->name + " does not declare its rewards") +
                   ": --lowest-return and --highest-return expected",
               ""};
}

// How many numbers tell of an action's return.
Result<void> find_atoms(DeepSetup& deep, const LearnSetup& setup) {
  const DeepSettings& settings = deep.settings;
  if (settings.returns == Returns::mean) {
    deep.atoms = 1;
  } else {
    const std::uint64_t usual = settings.returns == Returns::categorical ? 51 : 32;
    deep.atoms = static_cast<std::uint32_t>(settings.atoms > 0 ? settings.atoms : usual);
  }
  if (deep.atoms > 1024 || (settings.returns == Returns::categorical && deep.atoms < 2)) {
    return Error{"--atoms", 0, 0, "2 to 1024 expected, not " + std::to_string(deep.atoms), ""};
  }
  return settings.returns == Returns::categorical ? find_support(deep, setup) : Result<void>();
}

// Below 0 there is only the -1 that stands for the method's.
Result<void> check_numbers(const DeepSettings& settings) {
  const auto refuse = [](std::string flag, std::string expected) -> Result<void> {
    return Error{std::move(flag), 0, 0, std::move(expected) + " expected, or -1 = the method's",
                 ""};
  };
  if (settings.clip_gradient < 0.0 && settings.clip_gradient != -1.0) {
    return refuse("--clip-gradient", "a number of at least 0");
  }
  if (settings.return_decay < 0.0 && settings.return_decay != -1.0) {
    return refuse("--return-decay", "a number in [0, 1]");
  }
  return {};
}

}  // namespace

Result<DeepSetup> DeepSetup::make(const LearnSetup& setup, const DeepHabits& habits) {
  if (const auto fits = check_numbers(setup.deep); !fits) return fits.error();
  DeepSetup deep;
  const DeepSettings& settings = deep.settings = setup.deep;
  if (const auto found = find_input(deep, setup, habits); !found) return found.error();
  fill_in(deep.settings, habits, deep.spaces.observation > 0);
  auto hidden = layers(settings, deep.spaces, habits);
  if (!hidden) return hidden.error();
  deep.hidden = std::move(*hidden);
  if (const auto found = find_steps(deep, habits); !found) return found.error();
  if (settings.reward_scale == 0.0) {
    deep.settings.reward_scale = usual_scale(deep, *setup.world);
  }
  deep.walkers =
      settings.walkers > 0 ? static_cast<std::uint32_t>(settings.walkers) : habits.walkers;
  deep.traces = habits.traces;
  deep.running =
      habits.running && settings.inputs == Scaling::automatic && deep.spaces.observation > 0;
  deep.scaled = !deep.running && settings.inputs <= Scaling::scaled &&
                settings.inputs != Scaling::raw && !setup.world->measured.empty();
  if (settings.inputs == Scaling::scaled && !deep.scaled) {
    return Error{"--inputs", 0, 0,
                 "the ranges of what " + setup.world->name + " shows are not declared", "raw"};
  }
  if (const auto found = find_atoms(deep, setup); !found) return found.error();
  return deep;
}

}  // namespace quoll
