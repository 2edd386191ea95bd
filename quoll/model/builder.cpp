#include "quoll/model/builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace quoll {

namespace {

std::uint32_t index_of(std::string_view name, std::vector<std::string>& names,
                       std::unordered_map<std::string, std::uint32_t>& index) {
  const auto [entry, added] =
      index.try_emplace(std::string(name), static_cast<std::uint32_t>(names.size()));
  if (added) names.emplace_back(name);
  return entry->second;
}

Names stored_names(const std::vector<std::string>& list) {
  Names names;
  for (const std::string& name : list) names.push_back(name);
  return names;
}

}  // namespace

State MdpBuilder::state(std::string_view name) {
  return index_of(name, state_names_, state_index_);
}

std::uint32_t MdpBuilder::action(std::string_view name) {
  return index_of(name, action_names_, action_index_);
}

MdpBuilder& MdpBuilder::move(std::string_view from, std::string_view action_name,
                             std::string_view to, double reward, double probability) {
  const State first = state(from);
  const std::uint32_t by = action(action_name);
  move(first, by, state(to), reward, probability);
  return *this;
}

void MdpBuilder::move(State from, std::uint32_t action, State to, double reward,
                      double probability) {
  moves_.push_back({from, action, to, reward, probability});
}

MdpBuilder& MdpBuilder::terminal(std::string_view name) {
  terminal_.push_back(state(name));
  return *this;
}

MdpBuilder& MdpBuilder::start(std::string_view name, double weight) {
  start_.emplace_back(state(name), weight);
  return *this;
}

// The moves ordered by state, then by the first mention of their action there, then as they came.
// `mention` becomes, per move, a number that the moves of one (state, action) share.
std::vector<std::size_t> MdpBuilder::ordered(std::vector<std::size_t>& mention) const {
  constexpr std::size_t never = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> order(moves_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
    return moves_[a].from < moves_[b].from;
  });
  mention.resize(moves_.size());
  std::vector<std::size_t> place(action_names_.size(), never);  // first of each action, this state
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Move& move = moves_[order[i]];
    std::size_t& first = place[move.action];
    if (first == never || moves_[order[first]].from != move.from) first = i;
    mention[order[i]] = first;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return mention[a] < mention[b]; });
  return order;
}

Result<MdpArrays> MdpBuilder::arrays() const {
  const std::size_t states = state_names_.size();
  for (const Move& move : moves_) {
    if (move.from >= states || move.to >= states || move.action >= action_names_.size()) {
      Error error;
      error.expected = "a move between states or by an action that were never named";
      return error;
    }
  }
  MdpArrays a;
  a.choice_begin.assign(states + 1, 0);
  constexpr std::uint64_t no_outcome = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::uint64_t> seen(states, no_outcome);  // per successor: its latest outcome
  std::vector<std::size_t> mention;
  std::size_t latest = moves_.size();
  for (const std::size_t m : ordered(mention)) {
    const Move& move = moves_[m];
    if (mention[m] != latest) {
      latest = mention[m];
      a.outcome_begin.push_back(a.next.size());
      a.action.push_back(move.action);
      ++a.choice_begin[move.from + 1];
    }
    const std::uint64_t begin = a.outcome_begin.back();
    std::uint64_t joined = a.next.size();
    if (seen[move.to] != no_outcome && seen[move.to] >= begin) {
      for (joined = begin; joined < a.next.size(); ++joined) {
        if (a.next[joined] == move.to && a.outcome_reward[joined] == move.reward) break;
      }
    }
    if (joined < a.next.size()) {
      a.probability.set(joined, a.probability[joined] + move.probability);
      continue;
    }
    seen[move.to] = joined;
    a.next.push_back(move.to);
    a.probability.push_back(move.probability);
    a.outcome_reward.push_back(move.reward);
  }
  a.outcome_begin.push_back(a.next.size());
  std::partial_sum(a.choice_begin.begin(), a.choice_begin.end(), a.choice_begin.begin());

  a.terminal = terminal_;
  std::sort(a.terminal.begin(), a.terminal.end());
  a.terminal.erase(std::unique(a.terminal.begin(), a.terminal.end()), a.terminal.end());
  place_starts(a);
  a.state_names = stored_names(state_names_);
  a.action_names = stored_names(action_names_);
  a.discount = discount_;
  a.alternating = alternating_;
  a.layout = layout_;
  return a;
}

void MdpBuilder::place_starts(MdpArrays& a) const {
  auto starts = start_;
  const auto by_state = [](const auto& x, const auto& y) { return x.first < y.first; };
  std::stable_sort(starts.begin(), starts.end(), by_state);
  double total = 0.0;
  for (const auto& [state, weight] : starts) {
    total += weight;
    if (!a.start.empty() && a.start.back() == state) {
      a.start_probability.back() += weight;
    } else {
      a.start.push_back(state);
      a.start_probability.push_back(weight);
    }
  }
  // Weights that are probabilities already keep their bits; senseless ones are left for make().
  if (std::fabs(total - 1.0) <= 1e-9 || !(total > 0.0)) return;
  for (double& probability : a.start_probability) probability /= total;
}

Result<Mdp> MdpBuilder::build() const {
  Result<MdpArrays> made = arrays();
  if (!made) return made.error();
  return Mdp::make(*std::move(made));
}

}  // namespace quoll
