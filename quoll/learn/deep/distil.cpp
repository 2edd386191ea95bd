// Fitting a network to a table of Q: regression, the lecture's "labelled data". What the table says
// does not move while the network learns, so none of the devices of Q-learning with networks is
// needed (Rusu et al. 2016, "Policy distillation", where the teacher is a network).
//
//   given T(s,a) of the pairs that were visited
//   1   shuffle the pairs
//   2   for each batch of them: a step down the gradient of mean L(Q(s_i, a_i), T(s_i, a_i))
//   3   until stable: stop if in every state the greedy action of Q is one of the best of T, and
//   the
//       mean of |Q - T| is at most a fiftieth of what T reaches
//   4   go to 1
//
// T -> table_, times reward_scale; pairs -> order_; L, steps, learning rate -> DeepSettings.
// Actions that a state does not have, or that were never tried, are in no batch and no argmax.

#include "quoll/learn/deep/distil.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "quoll/learn/deep/learners.hpp"
#include "quoll/learn/deep/network_learner.hpp"
#include "quoll/learn/deep/q_network.hpp"

namespace quoll {
namespace {

constexpr DeepHabits habits{.hidden = "128,128",
                            .filters = "none",
                            .layer_norm = false,
                            .initial = nn::Initial::uniform,
                            .optimiser = nn::OptimiserKind::adam,
                            .learning_rate = "0.003",
                            .loss = nn::LossKind::half_squared,
                            .loss_of_states = nn::LossKind::half_squared,
                            .clip_gradient = 0.0,
                            .walkers = 1,
                            .batch = 128,
                            .by_state = true};

// Largest mean error of a network that agrees, of the largest value.
constexpr double agreed_error = 0.02;

// Whether, among the visited of `n` actions, the one that q prefers is as good as the best; nothing
// where none was visited.
template <class Value>
std::optional<bool> prefers_best(const double* table, const std::uint32_t* visits, const Value* q,
                                 std::uint64_t n) {
  std::uint64_t chosen = n, best = n;
  for (std::uint64_t a = 0; a < n; ++a) {
    if (visits[a] == 0) continue;
    if (chosen == n || q[a] > q[chosen]) chosen = a;
    if (best == n || table[a] > table[best]) best = a;
  }
  if (chosen == n) return std::nullopt;
  return table[chosen] >= table[best] - 1e-9 * std::fabs(table[best]);
}

class Distil final : public NetworkLearner {
 public:
  Distil(const LearnSetup& setup, const DeepSetup& deep, std::unique_ptr<QFunction> q)
      : NetworkLearner(setup, deep, std::move(q)),
        until_agreed_(setup.stable.watch),
        batch_(deep_.settings.batch),
        shuffle_(stream(setup.seed, "shuffle")),
        inputs_part_(batch_ * inputs_.size()),
        chosen_(batch_),
        predicted_(batch_),
        slopes_(batch_),
        outputs_part_(batch_ * actions_) {}

  /// The table's own gaps stay gaps.
  Estimates estimates() const override {
    Estimates out = NetworkLearner::estimates();
    out.foreseen.clear();
    return out;
  }
  const std::vector<std::uint8_t>& withheld() const { return withheld_; }

  void teach(const Estimates& table, double share) {
    table_ = table.q;
    withheld_.assign(row_begin_.size() - 1, 0);
    for (State s = 0; s + 1 < row_begin_.size(); ++s) {
      for (std::uint64_t c = row_begin_[s]; c < row_begin_[s + 1]; ++c) {
        visits_[c] = table.visits[c];
      }
    }
    list_pairs();
    if (share >= 1.0) return;
    // As many as are wanted of those that are left, each as likely (Knuth, volume 2, algorithm S).
    double wanted = std::ceil(share * static_cast<double>(taught_.size()));
    double left = static_cast<double>(taught_.size());
    for (const State s : taught_) {
      withheld_[s] = shuffle_.uniform() * left < wanted ? 0 : 1;
      wanted -= withheld_[s] == 0 ? 1.0 : 0.0;
      left -= 1.0;
    }
    list_pairs();
  }

  LearnProgress advance(std::uint64_t steps, std::span<Update>) override {
    using Halt = LearnProgress::Halt;
    if (pairs_.empty()) halt_ = Halt::stable;
    for (std::uint64_t i = 0; i < steps && halt_ == Halt::none; ++i) round();
    return progress();
  }
  LearnProgress progress() const override {
    LearnProgress now;
    now.steps = updates_;
    now.halt = halt_;
    return now;
  }

 private:
  struct Pair {
    State state;
    Action action;
  };

  void round() override;
  void persist_own(Archive& archive) override;
  void list_pairs();
  void reshuffle();
  bool agrees();
  std::uint32_t visits(State s, std::size_t a) const { return visits_[row_begin_[s] + a]; }

  bool until_agreed_;
  std::size_t batch_;
  std::vector<double> table_;           // per pair of the world
  std::vector<std::uint8_t> withheld_;  // per state
  std::vector<Pair> pairs_;             // those that are taught
  std::vector<State> taught_;           // states with one
  std::vector<std::uint32_t> order_;
  std::uint64_t position_ = 0, updates_ = 0;
  Rng shuffle_;
  nn::Floats inputs_part_;
  std::vector<Action> chosen_;
  nn::Floats predicted_, slopes_, outputs_part_;
};

void Distil::list_pairs() {
  pairs_.clear();
  taught_.clear();
  for (State s = 0; s + 1 < row_begin_.size(); ++s) {
    for (Action a = 0; a < row_begin_[s + 1] - row_begin_[s]; ++a) {
      if (visits(s, a) > 0 && withheld_[s] == 0) pairs_.push_back({s, a});
    }
    if (!pairs_.empty() && pairs_.back().state == s) taught_.push_back(s);
  }
  order_.resize(pairs_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  position_ = pairs_.size();
}

// 1
void Distil::reshuffle() {
  for (std::size_t i = order_.size(); i > 1; --i) {
    const auto j = static_cast<std::size_t>(shuffle_.uniform() * static_cast<double>(i));
    std::swap(order_[i - 1], order_[j]);
  }
  position_ = 0;
}

// 2
void Distil::round() {
  if (position_ == order_.size()) reshuffle();
  const std::size_t count = std::min<std::size_t>(batch_, order_.size() - position_);
  const std::size_t size = inputs_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Pair pair = pairs_[order_[position_ + i]];
    inputs_.write(pair.state, {}, inputs_part_.span().subspan(i * size, size));
    chosen_[i] = output_of(pair.state, pair.action);
  }
  q_->predict(inputs_part_.data(), count, chosen_.data(), predicted_.data());
  const float share = 1.0F / static_cast<float>(count);
  double loss_sum = 0.0, value_sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Pair pair = pairs_[order_[position_ + i]];
    const double target =
        table_[row_begin_[pair.state] + pair.action] * deep_.settings.reward_scale;
    const nn::Loss one = nn::loss(deep_.loss, predicted_[i] - static_cast<float>(target));
    slopes_[i] = share * one.slope;
    loss_sum += one.value;
    value_sum += double{predicted_[i]};
  }
  q_->update(slopes_.data(), deep_.learning_rate.at(updates_));
  tell(loss_sum * double{share}, value_sum * double{share});
  ++updates_;
  position_ += count;
  // 3
  if (until_agreed_ && position_ == order_.size() && agrees()) halt_ = LearnProgress::Halt::stable;
}

bool Distil::agrees() {
  const std::size_t size = inputs_.size();
  double errors = 0.0, largest = 0.0;
  for (std::size_t begin = 0; begin < taught_.size(); begin += batch_) {
    const std::size_t count = std::min(batch_, taught_.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      inputs_.write(taught_[begin + i], {}, inputs_part_.span().subspan(i * size, size));
    }
    q_->values(QFunction::Weights::online, inputs_part_.data(), count, outputs_part_.data());
    for (std::size_t i = 0; i < count; ++i) {
      const State s = taught_[begin + i];
      const std::uint64_t n = row_begin_[s + 1] - row_begin_[s];
      const float* const q = outputs_part_.data() + i * actions_;
      put_in_order(s, outputs_part_.data() + i * actions_);
      if (!*prefers_best(table_.data() + row_begin_[s], visits_.data() + row_begin_[s], q, n)) {
        return false;
      }
      for (std::uint64_t a = 0; a < n; ++a) {
        if (visits(s, a) == 0) continue;
        const double target = table_[row_begin_[s] + a] * deep_.settings.reward_scale;
        errors += std::fabs(double{q[a]} - target);
        largest = std::max(largest, std::fabs(target));
      }
    }
  }
  return errors <= agreed_error * largest * static_cast<double>(pairs_.size());
}

void Distil::persist_own(Archive& archive) {
  archive("table", table_);
  archive("withheld", withheld_);
  archive("order", order_);
  archive("position", position_);
  archive("updates", updates_);
  archive("shuffle", shuffle_);
  if (archive.saving()) return;
  std::vector<std::uint32_t> order = std::move(order_);
  const std::uint64_t position = position_;
  const bool fits = table_.empty() || (table_.size() == row_begin_.back() &&
                                       withheld_.size() + 1 == row_begin_.size());
  if (fits && !table_.empty()) list_pairs();
  std::vector<std::uint32_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  if (fits && sorted == order_ && position <= order.size()) {
    order_ = std::move(order);
    position_ = position;
    return;
  }
  table_.clear();
  pairs_.clear();
  archive.fail("the table does not fit this network's world");
}

std::unique_ptr<Learner> make(const LearnSetup& setup) {
  const Result<DeepSetup> deep = DeepSetup::make(setup, habits);
  return std::make_unique<Distil>(setup, *deep,
                                  *make_q_network(*deep, setup.seed, deep->settings.batch, false));
}

Result<void> check(const LearnSetup& setup) {
  if (setup.world->traits.states == 0) {
    return Error{"", 0, 0,
                 "the states of " + setup.world->name + " cannot be listed: no table to distil",
                 ""};
  }
  return check_network(setup, habits);
}

}  // namespace

void teach(Learner& distilled, const Estimates& table, double share) {
  static_cast<Distil&>(distilled).teach(table, share);
}

const std::vector<std::uint8_t>& withheld(const Learner& distilled) {
  return static_cast<const Distil&>(distilled).withheld();
}

double scale_of(const Estimates& table) {
  double largest = 0.0;
  for (std::size_t c = 0; c < table.q.size(); ++c) {
    if (table.visits[c] > 0) largest = std::max(largest, std::fabs(table.q[c]));
  }
  double scale = 1.0;
  while (largest * scale > 1.0 && scale > 0x1p-29) scale /= 2;
  while (largest > 0.0 && largest * scale <= 0.5 && scale < 0x1p29) scale *= 2;
  return scale;
}

std::vector<std::optional<bool>> agreement(const Estimates& table, const Estimates& q) {
  std::vector<std::optional<bool>> agrees;
  for (std::size_t s = 0; s + 1 < table.row_begin.size(); ++s) {
    const std::uint64_t c = table.row_begin[s];
    agrees.push_back(prefers_best(table.q.data() + c, table.visits.data() + c, q.q.data() + c,
                                  table.row_begin[s + 1] - c));
  }
  return agrees;
}

const LearnerEntry distil{.method = "distil",
                          .rule = "",
                          .summary = "a network that is taught a table",
                          .sound = true,
                          .make = make,
                          .replay = nullptr,
                          .traits = {.approximates = true,
                                     .networks = true,
                                     .taught = true,
                                     .optimiser = habits.optimiser_name()},
                          .check = check,
                          .formula = "a step down the gradient of L(Q(s,a), T(s,a)), T the table"};

}  // namespace quoll
