#include "quoll/learn/deep/network_learner.hpp"

#include <algorithm>
#include <cmath>

#include "quoll/learn/deep/choose.hpp"
#include "quoll/learn/deep/learned_network.hpp"
#include "quoll/learn/deep/q_network.hpp"
#include "quoll/learn/tabular/any_source.hpp"

namespace quoll {

namespace {

// Greedy by a copy of the network, of what is observed.
class NetworkPolicy final : public Policy {
 public:
  NetworkPolicy(Inputs inputs, Distribution distribution, std::unique_ptr<QFunction> q)
      : inputs_(std::move(inputs)),
        distribution_(distribution),
        q_(std::move(q)),
        row_(inputs_.size()),
        outputs_(q_->actions() * q_->atoms()),
        means_(q_->actions()) {}

  void act(const Experience& now, std::span<Action> out, std::span<Rng>) const override {
    for (std::size_t lane = 0; lane < out.size(); ++lane) {
      inputs_.write(now.state, now.observation, lane, row_.span());
      q_->values(QFunction::Weights::online, row_.data(), 1, outputs_.data());
      for (std::size_t a = 0; a < means_.size(); ++a) {
        means_[a] = distribution_.mean({outputs_.data() + a * q_->atoms(), q_->atoms()});
      }
      out[lane] = greedy(means_);
    }
  }

 private:
  Inputs inputs_;
  Distribution distribution_;
  std::unique_ptr<QFunction> q_;
  mutable nn::Floats row_, outputs_;
  mutable std::vector<float> means_;
};

}  // namespace

NetworkLearner::NetworkLearner(const LearnSetup& setup, const DeepSetup& deep,
                               std::unique_ptr<QFunction> q)
    : walkers_(setup, deep.walkers),
      deep_(deep),
      inputs_(*setup.world, deep),
      q_(std::move(q)),
      distribution_(deep.settings.returns, deep.atoms, deep.settings.lowest_return,
                    deep.settings.highest_return),
      discount_(static_cast<float>(setup.discount)),
      actions_(q_->actions()),
      outputs_(deep.walkers * actions_ * q_->atoms()),
      means_(actions_),
      row_begin_(inputs_.numbered() ? AnySource<float>::rows_of(*setup.world)
                                    : std::vector<std::uint64_t>()),
      visits_(row_begin_.empty() ? 0 : row_begin_.back()),
      exploration_(setup.exploration),
      draws_(deep.walkers),
      here_(deep.walkers * inputs_.size()) {
  for (std::uint32_t lane = 0; lane < deep.walkers; ++lane) {
    behaviour_.push_back(stream(setup.seed, "behaviour", lane));
  }
}

LearnProgress NetworkLearner::advance(std::uint64_t steps, std::span<Update>) {
  walkers_.forget_finished();
  const std::uint64_t end = walkers_.progress().steps + steps;
  while ((walkers_.progress().steps < end || unfinished()) && halt_ == LearnProgress::Halt::none) {
    round();
    if (unfinished()) break;
  }
  return progress();
}

LearnProgress NetworkLearner::progress() const {
  LearnProgress now = walkers_.progress();
  now.halt = halt_;
  now.unfinished = unfinished();
  return now;
}

void NetworkLearner::choose_actions(bool always) {
  const std::uint64_t step = walkers_.progress().steps;
  const std::uint32_t lanes = walkers_.count();
  const double epsilon =
      exploration_.kind == Exploration::Kind::epsilon_greedy ? exploration_.epsilon.at(step) : 0.0;
  bool asked = always;
  for (std::uint32_t lane = 0; lane < lanes; ++lane) {
    inputs_.write(walkers_.now().state, walkers_.now().observation, lane, inputs_of(lane));
    draws_[lane] = ChoiceDraws::of(behaviour_[lane]);
    asked |= !(draws_[lane].coin() < epsilon * 0x1p32);
  }
  // Whoever explores by a coin does not look at values.
  if (asked) {
    q_->redraw(QFunction::Weights::online);
    q_->values(QFunction::Weights::online, here_.data(), lanes, outputs_.data());
  }
  const std::size_t row = actions_ * q_->atoms();
  // Temperatures are in units of the world's values.
  const bool weighs = exploration_.kind == Exploration::Kind::softmax ||
                      exploration_.kind == Exploration::Kind::mellowmax;
  const auto unit = static_cast<float>(weighs ? 1.0 / value_scale() : 1.0);
  for (std::uint32_t lane = 0; lane < lanes; ++lane) {
    const std::span<float> q = std::span(means_).first(walkers_.actions_now(lane));
    if (asked) {
      put_in_order(walkers_.now().state[lane], outputs_.data() + lane * row);
      means(outputs_.data() + lane * row, q);
      for (float& value : q) value *= unit;
    }
    walkers_.actions()[lane] = choose(exploration_, q, draws_[lane], step).action;
  }
  count_visits();
}

void NetworkLearner::put_in_order(State state, float* outputs) {
  if (!deep_.letters) return;
  const std::size_t atoms = q_->atoms();
  ordered_.assign(outputs, outputs + actions_ * atoms);
  const Action n = walkers_.actions_of(state);
  for (Action a = 0; a < n; ++a) {
    std::copy_n(ordered_.data() + output_of(state, a) * atoms, atoms, outputs + a * atoms);
  }
}

void NetworkLearner::count_visits() {
  if (visits_.empty()) return;
  for (std::size_t lane = 0; lane < walkers_.count(); ++lane) {
    const State state = walkers_.now().state[lane];
    const std::uint64_t pair = row_begin_[state] + walkers_.now().action[lane];
    if (pair >= row_begin_[state + 1]) continue;  // an end, where any action does nothing
    visits_[pair] += visits_[pair] < ~std::uint32_t{0};
  }
}

void NetworkLearner::tell(double loss, double value) {
  loss_sum_ += loss;
  value_sum_ += value;
  ++learned_;
  if (!(std::fabs(loss) < 1e30 && std::fabs(value) < 1e30)) {
    halt_ = LearnProgress::Halt::diverged;
  }
}

std::unique_ptr<Policy> NetworkLearner::policy() const {
  if (inputs_.numbered()) return Learner::policy();
  return std::make_unique<NetworkPolicy>(inputs_, distribution_, q_->snapshot());
}

Estimates NetworkLearner::estimates() const {
  Estimates out;
  if (!inputs_.numbered()) return out;
  const std::unique_ptr<QFunction> q = q_->snapshot();
  nn::Floats values(actions_ * q->atoms());
  std::vector<float> mean(actions_);
  out.row_begin = row_begin_;
  for (State s = 0; s + 1 < row_begin_.size(); ++s) {
    q->values(inputs_.ones(s), values.data());
    means(values.data(), mean);
    out.foreseen.push_back(walkers_.ends_in(s) ? 0 : 1);
    for (Action a = 0; a < row_begin_[s + 1] - row_begin_[s]; ++a) {
      out.q.push_back(double{mean[output_of(s, a)]} / value_scale());
      out.visits.push_back(visits_[row_begin_[s] + a]);
    }
  }
  return out;
}

std::shared_ptr<const LearnedNetwork> NetworkLearner::network() const {
  if (q_->network() == nullptr) return nullptr;
  auto out = std::make_shared<LearnedNetwork>();
  out->observed = deep_.input;
  out->numbered = inputs_.numbered() && !deep_.letters;
  out->letters = deep_.letters;
  out->middle.assign(inputs_.middle().begin(), inputs_.middle().end());
  out->scale.assign(inputs_.scale().begin(), inputs_.scale().end());
  out->network = nn::plain(*q_->network(), q_->weights());
  out->layout = deep_.settings.layout;
  out->duelling = deep_.settings.duelling;
  out->actions = static_cast<std::uint32_t>(actions_);
  out->returns = deep_.settings.returns;
  out->atoms = deep_.atoms;
  if (out->returns == Returns::categorical) {
    for (std::size_t i = 0; i < deep_.atoms; ++i) out->support.push_back(distribution_.atom(i));
  }
  out->value_scale = value_scale();
  const std::shared_ptr<QFunction> q = q_->snapshot();
  out->values = [q, inputs = inputs_, mean = distribution_, scale = out->value_scale](
                    State state, std::span<const float> observation, std::span<float> values) {
    nn::Floats outputs(q->actions() * q->atoms());
    if (observation.empty()) {
      q->values(inputs.ones(state), outputs.data());
    } else {
      nn::Floats row(inputs.size());
      inputs.read(observation, row.span());
      q->values(QFunction::Weights::online, row.data(), 1, outputs.data());
    }
    for (std::size_t a = 0; a < values.size(); ++a) {
      const float value = mean.mean(outputs.span().subspan(a * q->atoms(), q->atoms()));
      values[a] = static_cast<float>(double{value} / scale);
    }
  };
  return out;
}

void NetworkLearner::persist(Archive& archive) {
  archive("walkers", walkers_);
  archive("behaviour", behaviour_);
  archive("q", *q_);
  const std::size_t visits = visits_.size();
  archive("visits", visits_);
  archive("loss_sum", loss_sum_);
  archive("value_sum", value_sum_);
  archive("learned", learned_);
  archive("halt", halt_);
  const bool fits = behaviour_.size() == walkers_.count() && visits_.size() == visits &&
                    halt_ <= LearnProgress::Halt::diverged;
  behaviour_.resize(walkers_.count());
  visits_.resize(visits);
  if (!fits) {
    halt_ = LearnProgress::Halt::none;
    archive.fail("what is saved does not fit this network's world");
  }
  persist_own(archive);
}

namespace {

// Whether a world that shows numbers has states beside them which offer different actions.
bool hides_actions(const World& world) {
  const std::unique_ptr<Environment> environment = world.make({});
  const Spaces spaces = environment->spaces();
  for (State s = 0; spaces.observation > 0 && s < spaces.states; ++s) {
    const Action offered = environment->actions(s);
    if (offered != 0 && offered != spaces.actions) return true;
  }
  return false;
}

}  // namespace

Result<void> check_network(const LearnSetup& setup, const DeepHabits& habits) {
  using Kind = Exploration::Kind;
  if (setup.exploration.kind == Kind::ucb || setup.exploration.kind == Kind::count_bonus) {
    return Error{"--explore", 0, 0,
                 setup.method + " counts no visits of what it observes: no " +
                     std::string(setup.exploration.name()),
                 "epsilon-greedy"};
  }
  if (hides_actions(*setup.world)) {
    return Error{"--method", 0, 0,
                 "networks read the numbers that " + setup.world->name +
                     " shows, and not which of its actions a state has; a world with the same "
                     "actions everywhere expected",
                 ""};
  }
  if (setup.deep.duelling && setup.deep.layout != NetworkLayout::shared) {
    return Error{"--duelling", 0, 0,
                 "a value and advantages are the outputs of one network: --layout shared", ""};
  }
  const Result<DeepSetup> deep = DeepSetup::make(setup, habits);
  if (!deep) return deep.error();
  const Result<nn::Network> network = nn::Network::make(network_spec(*deep));
  if (!network) {
    return Error{"--filters", 0, 0, "this network cannot be built: " + network.error().expected,
                 ""};
  }
  constexpr std::size_t most_parameters = std::size_t{1} << 27;
  if (network->parameters() <= most_parameters) return {};
  return Error{"--hidden", 0, 0,
               "a network of " + std::to_string(network->parameters()) + " numbers; at most " +
                   std::to_string(most_parameters) + " expected",
               ""};
}

Result<void> check_replay(const DeepSetup& deep) {
  const std::uint64_t numbers = deep.settings.replay * deep.spaces.observation;
  constexpr std::uint64_t most_bytes = std::uint64_t{1} << 34;
  const std::uint64_t bytes = deep.spaces.whole ? numbers / 8 : numbers * sizeof(float);
  if (bytes <= most_bytes) return {};
  return Error{"--replay", 0, 0,
               "that many states of " + std::to_string(deep.spaces.observation) + " numbers take " +
                   std::to_string(bytes >> 30) + " GiB; at most 16 expected",
               ""};
}

}  // namespace quoll
