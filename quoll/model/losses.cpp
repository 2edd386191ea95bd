#include "quoll/model/losses.hpp"

#include <algorithm>
#include <utility>

#include "quoll/base/text.hpp"

namespace quoll {
namespace {

class Comparison {
 public:
  Comparison(const Mdp& from, const Mdp& to) : from_(from), to_(to) {}

  std::vector<std::string> run() {
    if (from_.states() != to_.states()) {
      return {"the model: it had " + counted(from_.states(), "state") + " and has " +
              grouped(to_.states())};
    }
    for (State s = 0; s < from_.states(); ++s) {
      if (!state(s)) return {"the choices of state " + from_.state_name(s)};
    }
    tell(names_, "the name", "of ", "state");
    tell(actions_, "the name", "of ", "action");
    tell(ends_, "what can be done", "at ", "end");
    if (outcomes_ > 0) {
      lost_.push_back("the rewards of single outcomes at " + counted(outcomes_, "choice") +
                      ", of which the expectation stays");
    }
    if (rewards_ > 0) lost_.push_back("the rewards of " + counted(rewards_, "choice"));
    rest();
    return std::move(lost_);
  }

 private:
  void tell(std::uint64_t count, const std::string& what, const std::string& of,
            const std::string& noun) {
    if (count == 0) return;
    lost_.push_back(what + (count > 1 && what == "the name" ? "s " : " ") + of +
                    counted(count, noun));
  }

  bool state(State s) {
    names_ += from_.state_name(s) != to_.state_name(s);
    if (from_.terminal(s) != to_.terminal(s)) return false;
    if (from_.terminal(s) && to_.actions(s) == 0) {
      ends_ += from_.actions(s) > 0;
      return true;
    }
    if (from_.actions(s) != to_.actions(s)) return false;
    for (Action a = 0; a < from_.actions(s); ++a) {
      if (!choice(from_.choice_begin(s) + a, to_.choice_begin(s) + a)) return false;
    }
    return true;
  }

  bool choice(std::uint64_t c, std::uint64_t d) {
    const std::uint64_t count = from_.outcome_end(c) - from_.outcome_begin(c);
    if (count != to_.outcome_end(d) - to_.outcome_begin(d)) return false;
    bool outcomes = true;
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t o = from_.outcome_begin(c) + i;
      const std::uint64_t p = to_.outcome_begin(d) + i;
      if (from_.next(o) != to_.next(p) || from_.probability(o) != to_.probability(p)) return false;
      outcomes = outcomes && from_.reward(c, o) == to_.reward(d, p);
    }
    actions_ += from_.action_name(c) != to_.action_name(d);
    if (from_.reward(c) != to_.reward(d)) {
      ++rewards_;
    } else if (!outcomes) {
      ++outcomes_;
    }
    return true;
  }

  void rest() {
    const MdpArrays& a = from_.arrays();
    const MdpArrays& b = to_.arrays();
    if (a.discount != b.discount) lost_.push_back("the discount " + shortest(a.discount));
    if (a.alternating != b.alternating) lost_.push_back("that two move in turn");
    if (a.start != b.start) {
      lost_.push_back("the start");
    } else if (a.start_probability != b.start_probability) {
      lost_.push_back("the probabilities of the start");
    }
    std::vector<std::string> labels, structures;
    for (const Label& label : a.labels) {
      const Label* const other = to_.find_label(label.name);
      if (other == nullptr || other->states != label.states) labels.push_back(label.name);
    }
    for (const RewardStructure& rewards : a.other_rewards) {
      const RewardStructure* const other = to_.find_rewards(rewards.name);
      const bool same = other != nullptr && (other->reward == rewards.reward || ends_ > 0) &&
                        other->outcome_reward.empty() == rewards.outcome_reward.empty();
      if (!same) structures.push_back(rewards.name);
    }
    if (!a.reward_name.empty() && a.reward_name != b.reward_name) {
      lost_.push_back("the name of the rewards " + a.reward_name);
    }
    tell_names("label", labels);
    tell_names("reward structure", structures);
    if (a.layout && !b.layout) lost_.push_back("the places of the states in a grid");
  }

  void tell_names(const std::string& noun, const std::vector<std::string>& names) {
    if (names.empty()) return;
    std::string text = "the " + noun + (names.size() > 1 ? "s " : " ");
    for (std::size_t i = 0; i < names.size(); ++i) text += (i > 0 ? ", " : "") + names[i];
    lost_.push_back(std::move(text));
  }

  const Mdp& from_;
  const Mdp& to_;
  std::uint64_t names_ = 0, actions_ = 0, ends_ = 0, outcomes_ = 0, rewards_ = 0;
  std::vector<std::string> lost_;
};

}  // namespace

std::vector<std::string> losses(const Mdp& from, const Mdp& to) {
  return Comparison(from, to).run();
}

}  // namespace quoll
