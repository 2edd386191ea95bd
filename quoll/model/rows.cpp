#include "quoll/model/rows.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace quoll {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

// Gives back what was reserved for nothing; a few unused entries are not worth a copy. A copy,
// because shrink_to_fit does nothing in a build without exceptions.
template <class T>
void trim(std::vector<T>& values) {
  if (values.capacity() <= values.size() + values.size() / 64 + 64) return;
  std::vector<T> exact(values.begin(), values.end());
  values.swap(exact);
}

// The rows of `values`, segment by segment in a new order. `begin(i)` is the first row of segment
// i.
template <class List, class Begin>
void permute(List& values, const std::vector<std::uint32_t>& order, Begin begin) {
  List sorted;
  sorted.reserve(values.size());
  for (const std::uint32_t segment : order) {
    for (std::uint64_t row = begin(segment); row < begin(segment + 1); ++row) {
      sorted.push_back(values[row]);
    }
  }
  values = std::move(sorted);
}

}  // namespace

MdpRows::MdpRows(std::uint64_t expected_rows) : expected_rows_(expected_rows) {
  arrays_.next.reserve(expected_rows);
  arrays_.reward.reserve(expected_rows);
  arrays_.action.reserve(expected_rows);
  arrays_.choice_line.reserve(expected_rows);
}

void MdpRows::add(std::uint32_t state, std::uint32_t action, double probability, double reward,
                  std::uint64_t line) {
  MdpArrays& a = arrays_;
  if (!in_state_ || state != state_) open_state(state);
  if (!in_choice_ || action != action_) {
    open_choice(action, reward, line);
  } else {
    if (a.outcome_begin.empty()) begin_outcome_begin();
    if (a.outcome_reward.empty() && !same_bits(reward, a.reward.back())) begin_outcome_reward();
  }
  if (a.probability.empty() && probability != 1.0) {
    a.probability.reserve(std::max(expected_rows_, size() + 1));
    a.probability.assign(size(), 1.0);
    a.probability.push_back(probability);
  } else if (!a.probability.empty()) {
    a.probability.push_back(probability);
  }
  if (!a.outcome_reward.empty()) a.outcome_reward.push_back(reward);
  ++rows_;
}

void MdpRows::declare(std::uint32_t state) {
  if (!in_state_ || state != state_) open_state(state);
}

void MdpRows::open_state(std::uint32_t state) {
  if (state >= index_.size())
    index_.resize(std::max<std::size_t>(state + 1, 2 * index_.size()), nobody);
  if (index_[state] == nobody) {
    index_[state] = opened_++;
    arrays_.choice_begin.push_back(arrays_.action.size());
  } else if (index_[state] + 1 != opened_) {
    begin_sorting();
  }
  state_ = state;
  state_index_ = index_[state];
  in_state_ = true;
  in_choice_ = false;
}

void MdpRows::open_choice(std::uint32_t action, double reward, std::uint64_t line) {
  if (action >= last_state_.size()) last_state_.resize(action + 1, nobody);
  if (last_state_[action] == state_index_) begin_sorting();
  last_state_[action] = state_index_;
  if (sorting_) segment_state_.push_back(state_index_);
  if (!arrays_.outcome_begin.empty()) arrays_.outcome_begin.push_back(size());
  arrays_.action.push_back(action);
  arrays_.reward.push_back(reward);
  arrays_.choice_line.push_back(static_cast<std::uint32_t>(
      std::min<std::uint64_t>(line, std::numeric_limits<std::uint32_t>::max())));
  action_ = action;
  in_choice_ = true;
}

// From here on each segment remembers its state, because choice_begin no longer tells.
void MdpRows::begin_sorting() {
  if (sorting_) return;
  sorting_ = true;
  segment_state_.reserve(arrays_.action.capacity());
  for (std::uint32_t s = 0; s < opened_; ++s) {
    const std::uint64_t end = s + 1 < opened_ ? arrays_.choice_begin[s + 1] : arrays_.action.size();
    segment_state_.resize(end, s);
  }
}

// Until now each segment had one row.
void MdpRows::begin_outcome_begin() {
  const std::uint64_t segments = arrays_.action.size();
  arrays_.outcome_begin.reserve(std::max(expected_rows_, segments) + 1);
  for (std::uint64_t i = 0; i < segments; ++i) arrays_.outcome_begin.push_back(i);
}

// Until now the rows of a segment had one reward.
void MdpRows::begin_outcome_reward() {
  MdpArrays& a = arrays_;
  a.outcome_reward.reserve(std::max(expected_rows_, size() + 1));
  if (a.outcome_begin.empty()) {
    a.outcome_reward.assign(a.reward.begin(), a.reward.end());
    return;
  }
  for (std::uint64_t i = 0; i < a.action.size(); ++i) {
    const std::uint64_t end = i + 1 < a.action.size() ? a.outcome_begin[i + 1] : size();
    a.outcome_reward.resize(end, a.reward[i]);
  }
}

MdpArrays MdpRows::finish(std::uint32_t states, std::vector<std::uint32_t>& index) {
  MdpArrays& a = arrays_;
  last_state_ = {};
  index_.resize(states, nobody);
  for (std::uint32_t& i : index_) {
    if (i != nobody) continue;
    i = opened_++;
    a.choice_begin.push_back(a.action.size());
  }
  a.choice_begin.push_back(a.action.size());
  if (!a.outcome_begin.empty()) a.outcome_begin.push_back(size());
  if (sorting_ && !a.action.empty()) sort();
  for (State& next : a.next) next = index_[next];
  // Rows that vary decide alone; Mdp::make then takes the expectation.
  if (!a.outcome_reward.empty()) a.reward = {};
  if (!a.outcome_begin.empty() && a.probability.empty()) a.probability.assign(size(), 1.0);
  trim(a.choice_begin);
  trim(a.outcome_begin);
  trim(a.next);
  a.probability.trim();
  trim(a.reward);
  trim(a.outcome_reward);
  trim(a.action);
  trim(a.choice_line);
  index = std::move(index_);
  return std::move(arrays_);
}

// Segments in order of state, then of the first mention of their action, then of the file: a
// counting sort by state, and within each state a sort by the rank of the action and the place in
// the file.
std::vector<std::uint32_t> MdpRows::sorted_segments() {
  std::vector<std::uint64_t> begin(opened_ + std::uint64_t{1}, 0);
  for (const std::uint32_t s : segment_state_) ++begin[s + 1];
  for (std::uint32_t s = 0; s < opened_; ++s) begin[s + 1] += begin[s];
  std::vector<std::uint32_t> order(segment_state_.size());
  for (std::uint32_t i = 0; i < segment_state_.size(); ++i) order[begin[segment_state_[i]]++] = i;
  // begin[s] is now the end of state s.
  const std::uint32_t actions = *std::max_element(arrays_.action.begin(), arrays_.action.end()) + 1;
  std::vector<std::uint32_t> rank(actions), seen_in(actions, nobody);
  for (std::uint32_t s = 0; s < opened_; ++s) {
    const auto first = order.begin() + static_cast<std::ptrdiff_t>(s == 0 ? 0 : begin[s - 1]);
    const auto last = order.begin() + static_cast<std::ptrdiff_t>(begin[s]);
    std::uint32_t ranks = 0;
    for (auto segment = first; segment != last; ++segment) {
      const std::uint32_t action = arrays_.action[*segment];
      if (seen_in[action] == s) continue;
      seen_in[action] = s;
      rank[action] = ranks++;
    }
    // Within a state segments stand in order of the file, which is their number.
    const auto before = [&](std::uint32_t left, std::uint32_t right) {
      return std::pair(rank[arrays_.action[left]], left) <
             std::pair(rank[arrays_.action[right]], right);
    };
    std::sort(first, last, before);
  }
  return order;
}

void MdpRows::sort() {
  MdpArrays& a = arrays_;
  const std::vector<std::uint32_t> order = sorted_segments();
  const std::uint64_t segments = order.size();
  const auto joins = [&](std::uint64_t i) {  // segment order[i] continues the choice before it
    return i > 0 && segment_state_[order[i]] == segment_state_[order[i - 1]] &&
           a.action[order[i]] == a.action[order[i - 1]];
  };
  for (std::uint64_t i = 1; i < segments && a.outcome_reward.empty(); ++i) {
    if (joins(i) && !same_bits(a.reward[order[i]], a.reward[order[i - 1]])) begin_outcome_reward();
  }
  const auto row = [&](std::uint64_t segment) {
    return a.outcome_begin.empty() ? segment : a.outcome_begin[segment];
  };
  permute(a.next, order, row);
  if (!a.probability.empty()) permute(a.probability, order, row);
  if (!a.outcome_reward.empty()) permute(a.outcome_reward, order, row);

  std::vector<std::uint64_t> choice_begin(opened_ + std::uint64_t{1}, 0), outcome_begin;
  std::vector<std::uint32_t> action, line;
  std::vector<double> reward;
  std::uint64_t rows = 0;
  for (std::uint64_t i = 0; i < segments; ++i) {
    if (!joins(i)) {
      ++choice_begin[segment_state_[order[i]] + 1];
      outcome_begin.push_back(rows);
      action.push_back(a.action[order[i]]);
      reward.push_back(a.reward[order[i]]);
      line.push_back(a.choice_line[order[i]]);
    }
    rows += row(order[i] + std::uint64_t{1}) - row(order[i]);
  }
  for (std::uint32_t s = 0; s < opened_; ++s) choice_begin[s + 1] += choice_begin[s];
  outcome_begin.push_back(rows);
  const bool single = outcome_begin.size() == rows + 1;
  a.choice_begin = std::move(choice_begin);
  a.outcome_begin = single ? std::vector<std::uint64_t>{} : std::move(outcome_begin);
  a.action = std::move(action);
  a.reward = std::move(reward);
  a.choice_line = std::move(line);
  segment_state_ = {};
}

}  // namespace quoll
