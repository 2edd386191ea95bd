#include <algorithm>
#include <cmath>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/cassandra.hpp"

namespace quoll::cassandra {
namespace {

using Kind = Rule::Kind;
constexpr double exact_enough = 1e-9;  // what Mdp::make takes
constexpr double mendable = 1e-5;

std::uint64_t key_of(std::uint32_t action, std::uint32_t from) {
  return std::uint64_t{action} << 32 | from;
}

/// Sparse numbers, ascending in their places.
using Row = std::vector<std::pair<std::uint32_t, double>>;

class Expander {
 public:
  Expander(Content& content, MdpArrays& arrays)
      : c_(content), a_(arrays), work_left_((std::uint64_t{1} << 22) + 64 * content.bytes) {}

  Result<void> run() {
    c_.transitions.index();
    c_.outputs.index();
    c_.rewards.index();
    const std::uint64_t choices = std::uint64_t{c_.states} * c_.actions;
    if (choices > (std::uint64_t{1} << 18) + 16 * c_.bytes) return too_much();
    a_.choice_begin.push_back(0);
    a_.outcome_begin.push_back(0);
    for (std::uint32_t s = 0; s < c_.states; ++s) {
      for (std::uint32_t action = 0; action < c_.actions; ++action) {
        if (!choice(s, action)) return too_much();
      }
      a_.choice_begin.push_back(a_.action.size());
    }
    if (a_.outcome_reward.empty()) a_.reward.assign(choices, 0.0);
    if (rescaled_ > 0) {
      a_.remarks.push_back(counted(rescaled_, "row") +
                           " of probabilities rescaled, whose sum is 1 only within 1e-5");
    }
    return {};
  }

 private:
  static Error too_much() {
    return Error{"", 0, 0,
                 "expected fewer states, actions and outcomes by wildcards in a file of this size",
                 ""};
  }
  bool work(std::uint64_t steps) {
    if (steps > work_left_) return false;
    work_left_ -= steps;
    return true;
  }

  /// The number a complete rule gives a place; `width` numbers make a row.
  double base(const Rule& rule, std::uint32_t from, std::uint32_t to, std::uint32_t width) const {
    switch (rule.kind) {
      case Kind::number:
        return rule.value;
      case Kind::uniform:
        return 1.0 / width;
      case Kind::identity:
        return from == to ? 1.0 : 0.0;
      case Kind::row:
        return c_.numbers[rule.values + to];
      case Kind::matrix:
        break;
    }
    return c_.numbers[rule.values + std::uint64_t{from} * width + to];
  }

  /// The places that are not 0 in the row of an action and a state; false = too much work.
  bool fill(const Rules& rules, std::uint32_t action, std::uint32_t from, std::uint32_t width,
            Row& row) {
    row.clear();
    rules.latest(action, from, rules_,
                 [](const Rule& rule) { return rule.kind != Kind::number || rule.to == any; });
    if (!work(rules_.size())) return false;
    const Rule* whole = nullptr;
    if (!rules_.empty() && (rules_.back()->kind != Kind::number || rules_.back()->to == any)) {
      whole = rules_.back();
      rules_.pop_back();
    }
    line_ = !rules_.empty() ? rules_.front()->line : whole ? whole->line : 0;
    single_.clear();
    for (const Rule* rule : rules_) single_.emplace_back(rule->to, rule->value);
    // Of equal places the first is the latest.
    std::stable_sort(single_.begin(), single_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto repeated =
        std::unique(single_.begin(), single_.end(),
                    [](const auto& a, const auto& b) { return a.first == b.first; });
    single_.erase(repeated, single_.end());
    const bool dense = whole && whole->kind != Kind::identity;
    if (dense && !work(width)) return false;
    if (whole && !dense) merge({{from, 1.0}}, row);
    if (!whole) merge({}, row);
    std::size_t next = 0;
    for (std::uint32_t to = 0; dense && to < width; ++to) {
      const bool own = next < single_.size() && single_[next].first == to;
      const double value = own ? single_[next++].second : base(*whole, from, to, width);
      if (value != 0.0) row.emplace_back(to, value);
    }
    return true;
  }

  void merge(Row under, Row& row) {
    for (const auto& entry : single_) {
      if (!under.empty() && under[0].first < entry.first) row.push_back(under[0]);
      if (!under.empty() && under[0].first <= entry.first) under.clear();
      if (entry.second != 0.0) row.push_back(entry);
    }
    row.insert(row.end(), under.begin(), under.end());
  }

  bool choice(std::uint32_t s, std::uint32_t action) {
    if (!fill(c_.transitions, action, s, c_.states, row_)) return false;
    double sum = 0.0;
    for (const auto& [to, value] : row_) sum += value;
    const double off = std::fabs(sum - 1.0);
    if (off > exact_enough && off <= mendable) {
      for (auto& [to, value] : row_) value /= sum;
      ++rescaled_;
    }
    a_.action.push_back(action);
    a_.choice_line.push_back(
        static_cast<std::uint32_t>(std::min<std::uint64_t>(line_, UINT32_MAX)));
    if (!find_rewards(action, s)) return false;
    for (const auto& [to, value] : row_) {
      a_.next.push_back(to);
      a_.probability.push_back(value);
      double reward = 0.0;
      if (!reward_of(action, s, to, reward)) return false;
      a_.outcome_reward.push_back(c_.cost ? -reward : reward);
    }
    a_.outcome_begin.push_back(a_.next.size());
    return work(row_.size());
  }

  // The rules of rewards for an action and state: those for one next state sorted by it.
  bool find_rewards(std::uint32_t action, std::uint32_t s) {
    c_.rewards.latest(action, s, rules_,
                      [&](const Rule& rule) { return rule.to == any && whole(rule); });
    general_.clear();
    special_.clear();
    for (const Rule* rule : rules_) (rule->to == any ? general_ : special_).push_back(rule);
    std::stable_sort(special_.begin(), special_.end(),
                     [](const Rule* a, const Rule* b) { return a->to < b->to; });
    return work(rules_.size());
  }
  /// Whether a rule that fits the next state leaves no observation to earlier ones.
  bool whole(const Rule& rule) const { return rule.kind != Kind::number || rule.last == any; }

  bool reward_of(std::uint32_t action, std::uint32_t s, std::uint32_t to, double& reward) {
    const auto before = [](const Rule* rule, std::uint32_t state) { return rule->to < state; };
    auto special = std::lower_bound(special_.begin(), special_.end(), to, before);
    auto general = general_.begin();
    const Rule* under = nullptr;
    single_.clear();
    while (!under) {
      const bool first = special != special_.end() && (*special)->to == to;
      const bool second = general != general_.end();
      if (!first && !second) break;
      const Rule* const rule = first && (!second || *special > *general) ? *special++ : *general++;
      if (!work(1)) return false;
      if (whole(*rule)) {
        under = rule;
      } else {
        single_.emplace_back(rule->last, rule->value);
      }
    }
    if (c_.observations == 0) {
      reward = under ? base(*under, s, to, c_.states) : 0.0;
      return true;
    }
    if (single_.empty() && (!under || under->kind == Kind::number)) {
      reward = under ? under->value : 0.0;
      return true;
    }
    return expectation(action, to, under, reward);
  }

  // Over the observations that follow the action with the next state.
  bool expectation(std::uint32_t action, std::uint32_t to, const Rule* under, double& reward) {
    const Row special = single_;
    const std::uint64_t kept_line = line_;
    if (!fill(c_.outputs, action, to, c_.observations, seen_)) return false;
    line_ = kept_line;
    reward = 0.0;
    for (const auto& [observation, chance] : seen_) {
      double value = 0.0;
      if (under) {
        value = under->kind == Kind::matrix ? base(*under, to, observation, c_.observations)
                                            : base(*under, 0, observation, c_.observations);
      }
      for (const auto& [place, own] : special) {
        if (!work(1)) return false;
        if (place != observation) continue;
        value = own;
        break;
      }
      reward += chance * value;
    }
    return true;
  }

  Content& c_;
  MdpArrays& a_;
  std::uint64_t work_left_;
  std::uint64_t rescaled_ = 0;
  std::uint64_t line_ = 0;  // of the latest rule of the row filled last
  Row row_, seen_, single_;
  std::vector<const Rule*> rules_, general_, special_;
};

}  // namespace

void Rules::index() {
  for (std::uint32_t i = 0; i < rules_.size(); ++i) {
    keys_.emplace_back(key_of(rules_[i].action, rules_[i].from), i);
  }
  std::sort(keys_.begin(), keys_.end());
}

Rules::Range Rules::range(std::uint32_t action, std::uint32_t from) const {
  const std::uint64_t key = key_of(action, from);
  const auto first = std::lower_bound(keys_.begin(), keys_.end(), Key{key, 0});
  const auto last = std::upper_bound(first, keys_.end(), Key{key, any});
  return {keys_.data() + (first - keys_.begin()), keys_.data() + (last - keys_.begin())};
}

Result<void> expand(Content& content, MdpArrays& arrays) {
  return Expander(content, arrays).run();
}

}  // namespace quoll::cassandra
