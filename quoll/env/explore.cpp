#include "quoll/env/explore.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/env/positions.hpp"
#include "quoll/model/name_index.hpp"

namespace quoll {
namespace {

constexpr std::uint64_t most_outcomes = std::uint64_t{1} << 20;
constexpr std::size_t longest_name = 100;
constexpr State nobody = std::numeric_limits<State>::max();

/// The states found: kept positions, each of an episode that goes on or has ended there.
class Found {
 public:
  explicit Found(Positions& positions) : positions_(positions), slots_(64, nobody) {}

  State size() const { return static_cast<State>(hash_.size()); }
  /// Number of actions of a state.
  Action actions(State s) const { return actions_[s]; }
  /// An end whose position is also one of an episode that goes on.
  bool needs_mark(State s) const { return twin_[s] && actions_[s] == 0; }

  /// The state of the position looked at.
  State place(bool ended) {
    const std::string_view key = positions_.key();
    const Action actions = ended ? 0 : positions_.actions();
    const NameIndex::Key parts = NameIndex::key_of(key);
    const std::uint64_t hash = mix(parts.low ^ (parts.high * golden_gamma));
    bool twin = false;
    std::size_t slot = hash & (slots_.size() - 1);
    for (; slots_[slot] != nobody; slot = (slot + 1) & (slots_.size() - 1)) {
      const State s = slots_[slot];
      if (hash_[s] != hash || positions_.key(s) != key) continue;
      if ((actions_[s] == 0) == (actions == 0)) return s;
      twin_[s] = twin = true;
    }
    const State s = size();
    slots_[slot] = s;
    positions_.keep();
    hash_.push_back(hash);
    actions_.push_back(actions);
    twin_.push_back(twin);
    if (std::uint64_t{size()} * 4 > slots_.size() * 3) grow();
    return s;
  }

 private:
  void grow() {
    slots_.assign(slots_.size() * 2, nobody);
    for (State s = 0; s < size(); ++s) {
      std::size_t slot = hash_[s] & (slots_.size() - 1);
      while (slots_[slot] != nobody) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = s;
    }
  }

  Positions& positions_;
  std::vector<State> slots_;
  std::vector<std::uint64_t> hash_;  // per state, as those below
  std::vector<Action> actions_;
  std::vector<bool> twin_;  // the same position is also a state of the other kind
};

struct Outcome {
  State next;
  double reward, probability;
};

class Explorer {
 public:
  Explorer(const World& world, std::shared_ptr<Positions> positions,
           const ExploreSettings& exploration)
      : world_(world),
        exploration_(exploration),
        positions_(std::move(positions)),
        found_(*positions_) {}

  Result<Mdp> run() {
    arrays_.discount = world_.discount;
    start();
    for (State s = 0; s < found_.size() && !error_; ++s) {
      arrays_.choice_begin.push_back(arrays_.action.size());
      if (exploration_.progress && s % 4096 == 0) {
        exploration_.progress(found_.size(), found_.size() - s);
      }
      for (Action a = 0; a < found_.actions(s) && !error_; ++a) step(s, a);
    }
    if (error_) return *error_;
    arrays_.choice_begin.push_back(arrays_.action.size());
    arrays_.outcome_begin.push_back(arrays_.next.size());
    arrays_.alternating = alternating_.value_or(false);
    name_actions();
    name_states();
    return Mdp::make(std::move(arrays_));
  }

 private:
  // Each path of draws of what `look` does, until all were taken or one cannot be.
  template <class Look>
  void each_path(std::string_view who, const Look& look) {
    std::uint64_t paths = 0;
    dice_.begin();
    do {
      look();
      if (++paths > most_outcomes) return fail(who, "has more than 1,048,576 outcomes");
      if (error_) return;
    } while (dice_.next());
    if (!dice_.fault().empty()) fail(who, dice_.fault());
  }

  void start() {
    each_path("its start", [&] {
      positions_->start(dice_);
      if (!dice_.fault().empty()) return;
      const State s = place(false, 0);
      if (s == arrays_.start.size()) {
        arrays_.start.push_back(s);
        arrays_.start_probability.push_back(0.0);
      }
      arrays_.start_probability[s] += dice_.probability();
    });
  }

  void step(State from, Action action) {
    row_.clear();
    each_path("its action " + action_name(action), [&] {
      const Feedback feedback = positions_->step(from, action, dice_);
      if (!dice_.fault().empty()) return;
      row_.push_back({place(feedback.terminated, from), feedback.reward, dice_.probability()});
      if (feedback.terminated) return;
      if (alternating_.value_or(feedback.turn_passes) != feedback.turn_passes) {
        fail("the turn", "passes in some steps only");
      }
      alternating_ = feedback.turn_passes;
    });
    write_row(action);
  }

  State place(bool ended, State at) {
    const State s = found_.place(ended);
    if (found_.size() > exploration_.max_states && !error_) {
      error_ = Error{"--max-states", 0, 0,
                     world_.name + " has more than " + counted(exploration_.max_states, "state") +
                         ": " + grouped(found_.size() - at) +
                         " of those found are not yet gone through; give a larger number, or use "
                         "'quoll learn', which needs no list of them",
                     ""};
    }
    return s;
  }

  // Outcomes alike are one.
  void write_row(Action action) {
    std::stable_sort(row_.begin(), row_.end(), [](const Outcome& a, const Outcome& b) {
      return a.next != b.next ? a.next < b.next : a.reward < b.reward;
    });
    std::size_t kept = 0;
    for (std::size_t i = 1; i < row_.size(); ++i) {
      if (row_[i].next == row_[kept].next && row_[i].reward == row_[kept].reward) {
        row_[kept].probability += row_[i].probability;
      } else {
        row_[++kept] = row_[i];
      }
    }
    if (!row_.empty()) row_.resize(kept + 1);
    arrays_.action.push_back(action);
    arrays_.outcome_begin.push_back(arrays_.next.size());
    for (const auto& [next, reward, probability] : row_) {
      arrays_.next.push_back(next);
      arrays_.outcome_reward.push_back(reward);
      arrays_.probability.push_back(probability);
    }
  }

  std::string action_name(Action action) const {
    return world_.action_names.empty() ? std::to_string(action) : world_.action_names[action];
  }
  void name_actions() {
    const std::uint32_t actions = positions_->spaces().actions;
    for (Action a = 0; a < actions; ++a) arrays_.action_names.push_back(action_name(a));
  }
  void name_states() {
    NameIndex names;
    for (State s = 0; s < found_.size(); ++s) {
      std::string name = positions_->name(s, world_.state_name);
      if (!name.empty() && found_.needs_mark(s)) name += " (end)";
      if (name.empty() || name.size() > longest_name || names.insert(name) != s) {
        arrays_.state_names = Names::numbered("", found_.size());
        return;
      }
    }
    arrays_.state_names = names.take({});
  }

  void fail(std::string_view who, std::string_view what) {
    if (error_) return;
    error_ = Error{"", 0, 0,
                   "the states of " + world_.name + " cannot be listed: " + std::string(who) + " " +
                       std::string(what),
                   ""};
  }

  const World& world_;
  const ExploreSettings& exploration_;
  std::shared_ptr<Positions> positions_;
  Found found_;
  Branches dice_;
  MdpArrays arrays_;
  std::vector<Outcome> row_;
  std::optional<bool> alternating_;
  std::optional<Error> error_;
};

}  // namespace

std::string short_text(const Tree& tree) {
  const auto* const object = std::get_if<Tree::Object>(&tree.value);
  if (!object) return json_text(tree);
  std::string text;
  for (const auto& [key, value] : *object) {
    if (!text.empty()) text += ' ';
    const auto* const word = std::get_if<std::string>(&value.value);
    if (object->size() > 1) text += key + "=";
    text += word ? *word : json_text(value);
  }
  return text;
}

Result<Mdp> explore(const World& world, const ExploreSettings& exploration) {
  const std::unique_ptr<Environment> environment = world.make({});
  if (const auto* const source = dynamic_cast<const PositionsSource*>(environment.get())) {
    return Explorer(world, source->positions(), exploration).run();
  }
  return Error{"", 0, 0, "the states of " + world.name + " cannot be listed", ""};
}

Result<World> explored(World world, const ExploreSettings& exploration) {
  if (world.mdp) return world;
  Result<Mdp> mdp = explore(world, exploration);
  if (!mdp) return mdp.error();
  World listed = to_world(std::move(world.name), std::move(*mdp), {}, world.episode_steps);
  listed.parameters = std::move(world.parameters);
  return listed;
}

}  // namespace quoll
