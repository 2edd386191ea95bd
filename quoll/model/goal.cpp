#include "quoll/model/goal.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/model/graph.hpp"

namespace quoll {
namespace {

// What the rewards of a model are called that has no name for them.
constexpr std::string_view nameless = "reward";

// or := and { "|" and }   and := not { "&" not }   not := "!" not | "(" or ")" | name
class Expression {
 public:
  Expression(const Mdp& mdp, std::string_view text) : mdp_(mdp), text_(text) {}

  Result<std::vector<State>> read() {
    // A name may hold any letters when it stands alone.
    const std::string whole(trim(text_));
    const bool alone = mdp_.find_label(whole) != nullptr || mdp_.find_state(whole);
    if (alone) at_ = text_.size();
    const std::vector<bool> in = alone ? named(whole) : either();
    if (!failed_ && at_ != text_.size()) fail("expected & or | before '" + rest() + "'");
    if (failed_) return error_;
    std::vector<State> states;
    for (State s = 0; s < in.size(); ++s) {
      if (in[s]) states.push_back(s);
    }
    return states;
  }

 private:
  using Set = std::vector<bool>;

  // The first failure stays.
  Set fail(std::string expected, std::string near = "") {
    if (!failed_) error_ = {"--goal", 0, 0, std::move(expected), std::move(near)};
    failed_ = true;
    at_ = text_.size();
    return Set(mdp_.states());
  }
  std::string rest() const { return std::string(text_.substr(at_)); }

  bool take(char sign) {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    if (at_ == text_.size() || text_[at_] != sign) return false;
    ++at_;
    return true;
  }

  Set either() {
    Set in = both();
    while (take('|')) {
      const Set other = both();
      for (std::size_t s = 0; s < in.size(); ++s) in[s] = in[s] || other[s];
    }
    return in;
  }

  Set both() {
    Set in = one();
    while (take('&')) {
      const Set other = one();
      for (std::size_t s = 0; s < in.size(); ++s) in[s] = in[s] && other[s];
    }
    return in;
  }

  Set one() {
    bool turned = false;
    while (take('!')) turned = !turned;
    Set in;
    constexpr std::uint32_t deepest = 200;
    if (take('(')) {
      if (++depth_ > deepest) return fail("expected brackets at most 200 deep");
      in = either();
      if (!failed_ && !take(')')) return fail("expected ')' before '" + rest() + "'");
      --depth_;
    } else {
      in = named(name());
    }
    if (turned) in.flip();
    return in;
  }

  std::string name() {
    if (take('"')) {
      const std::size_t end = text_.find('"', at_);
      if (end == std::string_view::npos) {
        fail("expected a second '\"' behind '" + rest() + "'");
        return "";
      }
      std::string quoted(text_.substr(at_, end - at_));
      at_ = end + 1;
      return quoted;
    }
    const std::size_t end = std::min(text_.find_first_of("&|!()\" ", at_), text_.size());
    std::string word(text_.substr(at_, end - at_));
    if (word.empty()) fail("expected a label before '" + rest() + "'");
    at_ = end;
    return word;
  }

  Set named(const std::string& name) {
    Set in(mdp_.states());
    if (failed_) return in;
    if (const Label* label = mdp_.find_label(name)) {
      for (const State s : label->states) in[s] = true;
    } else if (const auto state = mdp_.find_state(name)) {
      in[*state] = true;
    } else if (name == "init") {
      for (const State s : mdp_.start()) in[s] = true;
    } else {
      return unknown(name);
    }
    return in;
  }

  Set unknown(const std::string& name) {
    Nearest nearest(name);
    std::string known;
    for (const Label& label : mdp_.arrays().labels) {
      nearest.offer(label.name);
      known += (known.empty() ? "" : ", ") + label.name;
    }
    std::string near = nearest.best();
    if (near.empty()) near = mdp_.arrays().state_names.nearest(name);
    return fail(
        "no label or state '" + name + "'" +
            (known.empty() ? ", and this world has no labels" : "; the labels are " + known),
        near);
  }

  const Mdp& mdp_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::uint32_t depth_ = 0;
  bool failed_ = false;
  Error error_;
};

// The choices that may lead to each state.
struct LeadingChoices {
  std::vector<std::uint64_t> begin;  // states + 1, and one spare place used while filling
  std::vector<std::uint64_t> choice;

  explicit LeadingChoices(const Mdp& mdp) : begin(mdp.states() + 2, 0), choice(mdp.outcomes()) {
    for (std::uint64_t o = 0; o < mdp.outcomes(); ++o) ++begin[mdp.next(o) + std::size_t{2}];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (std::uint64_t c = 0; c < mdp.choices(); ++c) {
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        choice[begin[mdp.next(o) + std::size_t{1}]++] = c;
      }
    }
  }
};

State state_of(const Mdp& mdp, std::uint64_t choice) {
  const std::vector<std::uint64_t>& begin = mdp.arrays().choice_begin;
  return static_cast<State>(std::upper_bound(begin.begin(), begin.end(), choice) - begin.begin() -
                            1);
}

// The greatest set of states outside the goal each of which is an end or has a choice that stays in
// the set.
std::vector<bool> avoiding(const Mdp& mdp, const std::vector<bool>& goal) {
  const LeadingChoices leading(mdp);
  std::vector<bool> in(mdp.states(), true), stays(mdp.choices(), true);
  std::vector<std::uint32_t> staying(mdp.states());
  std::vector<State> out;
  for (State s = 0; s < mdp.states(); ++s) {
    staying[s] = mdp.actions(s);
    if (goal[s]) out.push_back(s);
  }
  for (const State s : out) in[s] = false;
  while (!out.empty()) {
    const State left = out.back();
    out.pop_back();
    for (std::uint64_t i = leading.begin[left]; i < leading.begin[left + std::size_t{1}]; ++i) {
      const std::uint64_t c = leading.choice[i];
      if (!stays[c]) continue;
      stays[c] = false;
      const State s = state_of(mdp, c);
      if (--staying[s] > 0 || !in[s] || mdp.terminal(s)) continue;
      in[s] = false;
      out.push_back(s);
    }
  }
  return in;
}

void sort_in(std::vector<State>& list, const std::vector<State>& more) {
  list.insert(list.end(), more.begin(), more.end());
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// Rewards of 1 on entering the goal, and ends where that cannot, or need not, happen.
void reward_entering(const Mdp& mdp, const std::vector<State>& goal, bool minimise, MdpArrays& a) {
  std::vector<bool> in(mdp.states(), false);
  for (const State s : goal) in[s] = true;
  a.reward.clear();
  a.outcome_reward.assign(mdp.outcomes(), 0.0);
  for (std::uint64_t o = 0; o < mdp.outcomes(); ++o) {
    if (in[mdp.next(o)]) a.outcome_reward[o] = 1.0;
  }
  std::vector<State> never;
  if (minimise) {
    const std::vector<bool> avoids = avoiding(mdp, in);
    for (State s = 0; s < mdp.states(); ++s) {
      if (avoids[s]) never.push_back(s);
    }
  } else {
    const std::vector<std::uint32_t> moves = moves_to(mdp, goal);
    for (State s = 0; s < mdp.states(); ++s) {
      if (moves[s] == unreached) never.push_back(s);
    }
  }
  sort_in(a.terminal, never);
  a.reward_name.clear();
  a.discount = 1.0;
}

// Who comes to an end outside the goal stays there for ever, and never comes to the goal.
void stay_outside(const Mdp& mdp, const std::vector<State>& goal, MdpArrays& a) {
  std::vector<bool> stays(mdp.states(), false);
  bool any = false;
  for (State s = 0; s < mdp.states(); ++s) {
    stays[s] = mdp.terminal(s) && !std::binary_search(goal.begin(), goal.end(), s);
    any = any || stays[s];
  }
  a.terminal = goal;
  a.other_rewards.clear();
  if (!any) return;
  const auto stay = a.action_names.find("stay");
  const auto action = static_cast<std::uint32_t>(stay.value_or(a.action_names.size()));
  Names names;
  for (std::uint64_t i = 0; i < a.action_names.size(); ++i) names.push_back(a.action_names[i]);
  if (!stay) names.push_back("stay");
  MdpArrays to;
  to.choice_begin.push_back(0);
  to.outcome_begin.push_back(0);
  const auto add = [&to](State next, double probability, double reward) {
    to.next.push_back(next);
    to.probability.push_back(probability);
    to.outcome_reward.push_back(reward);
  };
  for (State s = 0; s < mdp.states(); ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s) && !stays[s]; ++c) {
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        add(mdp.next(o), mdp.probability(o),
            a.outcome_reward.empty() ? a.reward[c] : a.outcome_reward[o]);
      }
      to.outcome_begin.push_back(to.next.size());
      to.action.push_back(a.action[c]);
    }
    if (stays[s]) {
      add(s, 1.0, 0.0);
      to.outcome_begin.push_back(to.next.size());
      to.action.push_back(action);
    }
    to.choice_begin.push_back(to.action.size());
  }
  a.choice_begin = std::move(to.choice_begin);
  a.outcome_begin = std::move(to.outcome_begin);
  a.next = std::move(to.next);
  a.probability = std::move(to.probability);
  a.reward.clear();
  a.outcome_reward = std::move(to.outcome_reward);
  a.action = std::move(to.action);
  a.action_names = std::move(names);
}

Error unknown_rewards(const Mdp& mdp, const std::string& name) {
  Nearest nearest(name);
  std::string known;
  const auto offer = [&](const std::string& one) {
    nearest.offer(one);
    known += (known.empty() ? "" : ", ") + one;
  };
  offer(mdp.arrays().reward_name.empty() ? std::string(nameless) : mdp.arrays().reward_name);
  for (const RewardStructure& other : mdp.arrays().other_rewards) offer(other.name);
  return {"--reward", 0, 0, "no rewards '" + name + "' in this world; there are " + known,
          nearest.best()};
}

Result<void> take_rewards(const Mdp& mdp, const std::string& name, MdpArrays& a) {
  if (name == a.reward_name) return {};
  const auto found = std::find_if(a.other_rewards.begin(), a.other_rewards.end(),
                                  [&](const RewardStructure& one) { return one.name == name; });
  if (found == a.other_rewards.end()) {
    if (a.reward_name.empty() && name == nameless) return {};
    return unknown_rewards(mdp, name);
  }
  std::swap(a.reward, found->reward);
  std::swap(a.outcome_reward, found->outcome_reward);
  std::swap(a.reward_name, found->name);
  if (found->name.empty()) a.other_rewards.erase(found);
  return {};
}

}  // namespace

Result<std::vector<State>> states_of(const Mdp& mdp, std::string_view expression) {
  return Expression(mdp, expression).read();
}

Result<Mdp> aim(const Mdp& mdp, const Goal& goal) {
  MdpArrays a = mdp.arrays();
  if (!goal.rewards.empty()) {
    const Result<void> taken = take_rewards(mdp, goal.rewards, a);
    if (!taken) return taken.error();
  }
  if (goal.states.empty()) return Mdp::make(std::move(a));
  if (mdp.alternating()) {
    return Error{"--goal", 0, 0, "expected a world of one player, not a game of two", ""};
  }
  const Result<std::vector<State>> states = states_of(mdp, goal.states);
  if (!states) return states.error();
  if (goal.rewards.empty()) {
    reward_entering(mdp, *states, goal.minimise, a);
    sort_in(a.terminal, *states);
  } else {
    stay_outside(mdp, *states, a);
  }
  return Mdp::make(std::move(a));
}

}  // namespace quoll
