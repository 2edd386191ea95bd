#include "quoll/solve/total_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "quoll/model/graph.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/moves_left.hpp"
#include "quoll/solve/rounding.hpp"

// Interval iteration with end components collapsed: Haddad and Monmege 2018; for rewards Baier,
// Klein, Leuschner, Parker and Wunderlich 2017. Here rewards may have both signs.
//
//   L0 = -R- w for the policy pi that ends: R- the largest cost of its moves, w its moves left
//   U0 = h + R+ w: h the heights at which no move inside an end component gains, R+ the largest
//        r + E h(s') - h(s) of the moves out of end components, w the number of those left
//   L(s) <- L(s) + x for the action with the largest x = (r + E L(s') - L(s)) / (1 - P(s)); pi
//        takes it. Since every L(s) only rises, T_pi L >= L stays true, and pi keeps ending
//   U(s) <- U(s) + max over actions of the same; where moves are for nothing, all states of the
//        part at once, over the moves out of it
//
// Each new value keeps a margin for the rounding of the check (inductive.hpp).

namespace quoll {

namespace {

constexpr double reserve = 1e-9;  // of what a move may earn, for the rounding of the start
constexpr double per_move = 4.0 / 3.0 + 1e-6;  // moves_left() counts at least 3/4 of each

std::vector<bool> safe_choices(const Mdp& mdp, const std::vector<std::uint8_t>& live) {
  std::vector<bool> safe(mdp.choices(), false);
  for (State s = 0; s < mdp.states(); ++s) {
    if (live[s] == 0) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      bool keeps = true;
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        keeps = keeps && (live[mdp.next(o)] != 0 || mdp.terminal(mdp.next(o)));
      }
      safe[c] = keeps;
    }
  }
  return safe;
}

}  // namespace

TotalBounds::TotalBounds(const Mdp& mdp, const SolveSettings& settings, Ending ending)
    : mdp_(mdp),
      settings_(settings),
      live_(std::move(ending.live)),
      safe_(safe_choices(mdp, live_)),
      free_(mdp, live_),
      inductive_(mdp, live_, free_),
      lower_(inductive_.constant(-infinity)),
      upper_(inductive_.constant(infinity)) {
  for (State s = 0; s < mdp.states(); ++s) {
    if (live_[s] != 0) states_.push_back(s);
  }
  const auto [low, high] = mdp.reward_bounds();
  reward_size_ = std::max(std::fabs(low), std::fabs(high));
  solution_.policy = std::move(ending.policy);
  solution_.discount = 1.0;
}

bool TotalBounds::start_below() {
  std::vector<bool> chosen(mdp_.choices(), false);
  double cost = 0.0;
  for (const State s : states_) {
    const std::uint64_t c = mdp_.choice_begin(s) + solution_.policy[s];
    chosen[c] = true;
    cost = std::max(cost, -mdp_.reward(c));
  }
  const auto moves = moves_left(mdp_, live_, chosen, {});
  if (!moves) return false;
  const double most = per_move * (cost + reserve * reward_size_);
  for (const State s : states_) lower_[s] = -most * (*moves)[s];
  return true;
}

bool TotalBounds::start_above() {
  const EndComponents parts = maximal_end_components(mdp_, safe_);
  const std::vector<double> height = component_heights(mdp_, parts);
  double size = reward_size_;
  for (const double h : height) size = std::max(size, std::fabs(h));
  free_.balance(height, size);
  std::vector<bool> out(mdp_.choices(), false);
  double reward = 0.0;
  for (const State s : states_) {
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      out[c] = safe_[c] && !parts.inside[c];
      if (out[c]) reward = std::max(reward, inductive_.gain_up(height, 1.0, s, c));
    }
  }
  const auto moves = moves_left(mdp_, live_, out, parts);
  if (!moves) return false;
  const double most = per_move * (reward + reserve * size);
  std::vector<double> upper = upper_;
  for (const State s : states_) upper[s] = most * (*moves)[s] + height[s];
  free_.level_up(upper);
  if (!inductive_.raise_above(upper)) return false;
  upper_ = std::move(upper);
  return true;
}

void TotalBounds::guess_above(double width) {
  measure();
  free_.balance(lower_, size_);
  for (const State s : states_) upper_[s] = lower_[s] + width;
  free_.level_up(upper_);
}

void TotalBounds::measure() {
  size_ = reward_size_;
  for (const State s : states_) {
    size_ = std::max(size_, std::fabs(lower_[s]));
    if (upper_[s] < infinity) size_ = std::max(size_, std::fabs(upper_[s]));
  }
}

double TotalBounds::slack(std::uint64_t choice) const {
  const auto outcomes = static_cast<double>(mdp_.outcome_end(choice) - mdp_.outcome_begin(choice));
  return 8.0 * (outcomes + 4.0) * half_ulp * size_;
}

double TotalBounds::raise_lower() {
  measure();
  double change = 0.0;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const State s = states_[backward_ ? states_.size() - 1 - i : i];
    double most = 0.0;
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      if (!safe_[c]) continue;
      const double gain = -inductive_.gain_up(lower_, -1.0, s, c) - slack(c);
      if (!(gain > 0.0)) continue;
      double leaving = 0.0;
      for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
        if (mdp_.next(o) != s) leaving += mdp_.probability(o);
      }
      if (leaving == 0.0 || !(gain / leaving > most)) continue;
      most = gain / leaving;
      solution_.policy[s] = static_cast<Action>(c - mdp_.choice_begin(s));
    }
    if (most == 0.0) continue;
    lower_[s] = add_down(lower_[s], most);
    change = std::max(change, most);
  }
  return change;
}

// How far the state, or its free part, can sink as far as this choice goes; below 0: U fails here.
double TotalBounds::sinking(State s, std::uint64_t choice) const {
  const double gain = inductive_.gain_up(upper_, 1.0, s, choice);
  const std::uint32_t part = free_.part(s);
  double leaving = 0.0;
  for (std::uint64_t o = mdp_.outcome_begin(choice); o < mdp_.outcome_end(choice); ++o) {
    const State next = mdp_.next(o);
    const bool stays = next == s || (part != no_component && free_.part(next) == part);
    if (!stays) leaving += mdp_.probability(o);
  }
  if (gain > 0.0) return -infinity;
  if (leaving == 0.0) return infinity;
  return std::max(0.0, (-gain - slack(choice)) / leaving);
}

TotalBounds::Sunk TotalBounds::sink_upper() {
  measure();
  const double least = 1e-15 * size_;          // less is not worth it
  const double least_of_part = 1e-11 * size_;  // above the grid of their values
  Sunk sunk;
  sink_.assign(free_.count(), infinity);
  const auto lower_by = [&](State s, double by) {
    upper_[s] = add_up(upper_[s], -by);
    sunk.change = std::max(sunk.change, by);
  };
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const State s = states_[backward_ ? states_.size() - 1 - i : i];
    double by = infinity;
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      if (safe_[c] && !free_.inside(c)) by = std::min(by, sinking(s, c));
    }
    sunk.inductive = sunk.inductive && by >= 0.0;
    const std::uint32_t part = free_.part(s);
    if (part != no_component) {
      sink_[part] = std::min(sink_[part], by);
    } else if (by > least && by < infinity) {
      lower_by(s, by);
    }
  }
  backward_ = !backward_;
  for (const State s : states_) {
    const std::uint32_t part = free_.part(s);
    if (part == no_component || !(sink_[part] > least_of_part && sink_[part] < infinity)) continue;
    lower_by(s, sink_[part]);
  }
  free_.level_up(upper_);
  return sunk;
}

double TotalBounds::width() const {
  double width = 0.0;
  for (const State s : states_) width = std::max(width, next_up(upper_[s] - lower_[s]));
  return width;
}

bool TotalBounds::crossed() const {
  for (const State s : states_) {
    if (upper_[s] < lower_[s]) return true;
  }
  return false;
}

bool TotalBounds::count(double gap) {
  ++solution_.sweeps;
  solution_.backups += mdp_.states();
  return may_continue(settings_, solution_, gap);
}

Solution TotalBounds::finish() {
  const std::vector<double> open_below = inductive_.constant(-infinity);
  const std::vector<double> open_above = inductive_.constant(infinity);
  const bool sure = lower_ != open_below && inductive_.ends(solution_.policy) &&
                    inductive_.holds_below(lower_, solution_.policy);
  const bool bounded = upper_ != open_above && inductive_.raise_above(upper_);
  solution_.lower = sure ? lower_ : open_below;
  solution_.upper = bounded ? upper_ : open_above;
  conclude(mdp_, solution_, settings_.width);
  return std::move(solution_);
}

}  // namespace quoll
