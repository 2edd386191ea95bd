#include "quoll/model/mdp.hpp"

#include <algorithm>
#include <utility>

#include "quoll/model/check.hpp"

namespace quoll {

namespace {

template <class T>
void release(std::vector<T>& list) {
  std::vector<T>().swap(list);
}

std::vector<bool> ends_of(const MdpArrays& a) {
  const std::size_t states = a.choice_begin.size() - 1;
  std::vector<bool> ends(states);
  for (std::size_t s = 0; s < states; ++s) ends[s] = a.choice_begin[s] == a.choice_begin[s + 1];
  for (const State s : a.terminal) ends[s] = true;
  return ends;
}

// An outcome that never happens is no outcome: without it, the graph needs no look at
// probabilities.
void drop_impossible_outcomes(MdpArrays& a) {
  bool any = false;
  for (std::size_t o = 0; o < a.probability.size() && !any; ++o) any = a.probability[o] == 0.0;
  if (!any) return;
  std::vector<std::vector<double>*> along;
  if (!a.outcome_reward.empty()) along.push_back(&a.outcome_reward);
  for (RewardStructure& other : a.other_rewards) {
    if (!other.outcome_reward.empty()) along.push_back(&other.outcome_reward);
  }
  std::uint64_t kept = 0;
  std::uint64_t outcome = 0;
  for (std::size_t c = 0; c + 1 < a.outcome_begin.size(); ++c) {
    const std::uint64_t end = a.outcome_begin[c + 1];
    a.outcome_begin[c] = kept;
    for (; outcome < end; ++outcome) {
      if (a.probability[outcome] == 0.0) continue;
      a.next[kept] = a.next[outcome];
      a.probability.set(kept, a.probability[outcome]);
      for (std::vector<double>* list : along) (*list)[kept] = (*list)[outcome];
      ++kept;
    }
  }
  a.outcome_begin.back() = kept;
  a.next.resize(kept);
  a.probability.truncate(kept);
  for (std::vector<double>* list : along) list->resize(kept);
}

// One zero: -0 and 0 are equal numbers with different bits.
void unsign_zeros(std::vector<double>& rewards) {
  for (double& reward : rewards) reward += 0.0;
}

// The expected reward of each choice. Equal outcome rewards are taken as they are: their weighted
// sum might differ from them by rounding.
void expect_rewards(const MdpArrays& a, std::vector<double>& reward,
                    std::vector<double>& outcome_reward) {
  unsign_zeros(reward);
  unsign_zeros(outcome_reward);
  if (outcome_reward.empty()) return;
  const std::size_t choices = a.action.size();
  reward.resize(choices);
  bool varies = false;
  for (std::size_t c = 0; c < choices; ++c) {
    const std::uint64_t begin = a.outcome_begin.empty() ? c : a.outcome_begin[c];
    const std::uint64_t end = a.outcome_begin.empty() ? c + 1 : a.outcome_begin[c + 1];
    bool equal = true;
    double sum = 0.0;
    for (std::uint64_t o = begin; o < end; ++o) {
      equal = equal && outcome_reward[o] == outcome_reward[begin];
      sum += (a.probability.empty() ? 1.0 : a.probability[o]) * outcome_reward[o];
    }
    reward[c] = equal ? outcome_reward[begin] : sum;
    varies = varies || !equal;
  }
  if (!varies) release(outcome_reward);
}

void drop_impossible_starts(MdpArrays& a) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < a.start_probability.size(); ++i) {
    if (a.start_probability[i] == 0.0) continue;
    a.start[kept] = a.start[i];
    a.start_probability[kept] = a.start_probability[i];
    ++kept;
  }
  if (a.start_probability.empty()) return;
  a.start.resize(kept);
  a.start_probability.resize(kept);
}

void drop_redundant_arrays(MdpArrays& a) {
  bool certain = true;
  for (std::size_t o = 0; o < a.probability.size() && certain; ++o) {
    certain = a.probability[o] == 1.0;
  }
  if (certain) a.probability = {};
  a.probability.trim();
  // No choice is without outcome, so equal numbers mean one outcome for each.
  if (a.next.size() == a.action.size()) release(a.outcome_begin);
  const double share = 1.0 / static_cast<double>(a.start.size());
  const auto is_share = [share](double p) { return p == share; };
  if (std::all_of(a.start_probability.begin(), a.start_probability.end(), is_share)) {
    release(a.start_probability);
  }
  release(a.choice_line);
}

}  // namespace

Result<Mdp> Mdp::make(MdpArrays arrays) {
  Error error;
  if (first_fault(arrays, error)) return error;

  Mdp mdp;
  mdp.a_ = std::move(arrays);
  MdpArrays& a = mdp.a_;
  mdp.ends_ = ends_of(a);
  if (a.start.empty()) {
    for (State s = 0; s < mdp.ends_.size(); ++s) {
      if (!mdp.ends_[s]) a.start.push_back(s);
    }
  }
  drop_impossible_outcomes(a);
  drop_impossible_starts(a);
  expect_rewards(a, a.reward, a.outcome_reward);
  for (RewardStructure& other : a.other_rewards) {
    expect_rewards(a, other.reward, other.outcome_reward);
  }
  drop_redundant_arrays(a);

  bool first = true;
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.ends_[s]) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        const double reward = mdp.reward(c, o);
        auto& [low, high] = mdp.reward_bounds_;
        low = first ? reward : std::min(low, reward);
        high = first ? reward : std::max(high, reward);
        first = false;
      }
    }
  }
  return mdp;
}

std::optional<State> Mdp::find_state(std::string_view name) const {
  const auto index = a_.state_names.find(name);
  if (!index) return std::nullopt;
  return static_cast<State>(*index);
}

const Label* Mdp::find_label(std::string_view name) const {
  for (const Label& label : a_.labels) {
    if (label.name == name) return &label;
  }
  return nullptr;
}

const RewardStructure* Mdp::find_rewards(std::string_view name) const {
  for (const RewardStructure& rewards : a_.other_rewards) {
    if (rewards.name == name) return &rewards;
  }
  return nullptr;
}

std::uint64_t Mdp::bytes() const {
  const auto held = [](const auto& list) { return list.capacity() * sizeof(list[0]); };
  std::uint64_t total = held(a_.choice_begin) + held(a_.outcome_begin) + held(a_.next) +
                        a_.probability.bytes() + held(a_.reward) + held(a_.outcome_reward) +
                        held(a_.action) + held(a_.start) + held(a_.start_probability) +
                        held(a_.terminal) + a_.state_names.bytes() + a_.action_names.bytes() +
                        ends_.size() / 8;
  for (const Label& label : a_.labels) total += held(label.states);
  for (const RewardStructure& other : a_.other_rewards) {
    total += held(other.reward) + held(other.outcome_reward);
  }
  if (a_.layout) total += held(a_.layout->cell) + held(a_.layout->direction);
  return total;
}

}  // namespace quoll
