#pragma once
// A rule applied to given transitions instead of its own: for explaining, and for comparing two
// rules on the same experience.

#include <algorithm>
#include <vector>

#include "quoll/env/table.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/learn/tabular/rule.hpp"

namespace quoll {

template <UpdateRule Rule>
std::vector<Update> replay(const LearnSetup& setup, std::span<const Update> script) {
  using Value = typename Rule::Value;
  const Mdp& mdp = *setup.world->mdp;
  const std::vector<std::uint64_t>& begin = mdp.arrays().choice_begin;
  Rule rule(setup, PairLayout{0, mdp.choices()}, begin);
  std::vector<Value> q(mdp.choices(), static_cast<Value>(setup.initial_value));
  std::vector<std::uint32_t> visits(mdp.choices());
  std::vector<Update> updates(script.begin(), script.end());
  for (Update& update : updates) {
    const std::uint64_t pair = begin[update.state] + update.action;
    const auto row = q.begin() + static_cast<std::ptrdiff_t>(begin[update.next]);
    const auto row_end = q.begin() + static_cast<std::ptrdiff_t>(begin[update.next + 1]);
    const bool over = update.terminated || row == row_end;
    update.best_next = over ? 0.0 : double{*std::max_element(row, row_end)};
    update.old_value = double{q[pair]};
    const Revision<Value> revision =
        revise(rule, setup.step_size, pair, q[pair], update.reward, mdp.carry(setup.discount),
               update.best_next, ++visits[pair], nearest_rounding);
    q[pair] = revision.value;
    rule.learned(pair, double{revision.value});
    update.reward = revision.reward;
    update.target = revision.target;
    update.step_size = revision.step_size;
    update.new_value = double{revision.value};
  }
  return updates;
}

}  // namespace quoll
