#include "quoll/report/explain_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/report/table.hpp"

namespace quoll {
namespace {

constexpr Action most_listed = 8;       // moves of the next state that a formula lists
constexpr std::size_t most_others = 5;  // lines about other values

std::string action_name(const Mdp& mdp, const Update& update) {
  return mdp.action_name(mdp.choice_begin(update.state) + update.action);
}

bool same(double a, double b) {
  return a == b || std::fabs(a - b) <= 1e-6 * std::max(std::fabs(a), std::fabs(b));
}

// "80 + 0.8 * 100 = 160": the sum of a rule that takes whole steps.
std::string sum_text(const Update& update, double discount) {
  return fmt::format("{} + {} * {} = {}", number_text(update.reward), factor_text(discount),
                     factor_text(update.best_next), number_text(update.new_value));
}

std::string sum_without_result(const Update& update, double discount) {
  return fmt::format("{} + {} * {}", number_text(update.reward), factor_text(discount),
                     factor_text(update.best_next));
}

}  // namespace

std::string factor_text(double value) {
  const std::string text = number_text(value);
  return text.front() == '-' ? "(" + text + ")" : text;
}

std::string pair_text(const Mdp& mdp, State state, Action action) {
  return "(" + mdp.state_name(state) + ", " + mdp.action_name(mdp.choice_begin(state) + action) +
         ")";
}

UpdateWords UpdateWords::of(std::string_view rule) {
  if (rule == "as-printed") return {"QE", Reward::stored, false};
  if (rule == "reward-estimate") return {"QE", Reward::mean, false};
  return {};
}

UpdateTeller::UpdateTeller(const Mdp& mdp, std::vector<double> q, double discount,
                           UpdateWords words, std::vector<std::uint32_t> visits)
    : mdp_(mdp),
      q_(std::move(q)),
      visits_(std::move(visits)),
      discount_(mdp.carry(discount)),
      words_(words) {
  visits_.resize(mdp.choices());
}

// "max{To-GOAL 100, To-HALL 0}", or 0 after an end.
std::string UpdateTeller::best_text(const Update& update) const {
  if (update.terminated) return "0";
  const std::uint64_t first = mdp_.choice_begin(update.next), end = mdp_.choice_end(update.next);
  std::uint64_t best = first;
  std::string list;
  for (std::uint64_t c = first; c < end; ++c) {
    if (q_[c] > q_[best]) best = c;
    if (end - first > most_listed) continue;
    list += fmt::format("{}{} {}", c > first ? ", " : "", mdp_.action_name(c), number_text(q_[c]));
  }
  if (end - first <= most_listed) return "max{" + list + "}";
  return fmt::format("max{{{} {}, {} others}}", mdp_.action_name(best), number_text(q_[best]),
                     end - first - 1);
}

std::string UpdateTeller::formula(const Update& update) const {
  if (words_.memory) {
    const double bonus = update.target - update.reward - discount_ * update.best_next;
    const bool none = std::fabs(bonus) <= 1e-6 * std::max(1.0, std::fabs(update.target));
    return fmt::format("{}{} + {} * {} = {}", number_text(update.reward),
                       none ? "" : " + " + factor_text(bonus), factor_text(discount_),
                       update.terminated ? "0" : factor_text(update.best_next),
                       number_text(update.target));
  }
  return fmt::format("{} + {} * {} = {}", number_text(update.reward), factor_text(discount_),
                     best_text(update), number_text(update.target));
}

// "Q(A,go) := ..", with the target on a line of its own where the step is not whole.
std::string UpdateTeller::change_text(const Update& update, const std::string& name) const {
  const double target = update.target, old = update.old_value, now = update.new_value;
  // Methods with memory may change the value later, or in two halves.
  const double moved = old + update.step_size * (target - old);
  if (words_.memory && !same(moved, now) &&
      std::fabs(moved - now) > 1e-6 * std::max(std::fabs(target), std::fabs(old))) {
    return "target = " + formula(update) + "\n         " + name + " = " + number_text(now);
  }
  if (update.step_size == 1.0) {
    return name + " := " + (words_.reward == UpdateWords::Reward::observed ? "" : "rE ") +
           formula(update);
  }
  return "target = " + formula(update) + "\n         " +
         fmt::format("{} := {} + {} * ({} - {}) = {}", name, number_text(old),
                     number_text(update.step_size), number_text(target), factor_text(old),
                     number_text(now));
}

std::string UpdateTeller::tell(const Update& update, std::span<const OtherChange> others) {
  const std::uint64_t pair = mdp_.choice_begin(update.state) + update.action;
  const std::string next = mdp_.state_name(update.next);
  std::string text = fmt::format("step {:<3} at {}, take {} -> {}", update.step,
                                 mdp_.state_name(update.state), action_name(mdp_, update), next);
  using Reward = UpdateWords::Reward;
  if (words_.reward == Reward::observed) text += ", reward " + number_text(update.reward);
  if (words_.chance) text += update.explored ? "   (by chance)" : "   (the best so far)";
  text += "\n         " + change_text(update, choice_text(pair));
  text += update.new_value == update.old_value
              ? "   unchanged"
              : fmt::format("   was {}", number_text(update.old_value));
  if (words_.reward == Reward::mean) {
    text += fmt::format("   [rE: mean of {} observed reward{}]", visits_[pair] + 1,
                        visits_[pair] == 0 ? "" : "s");
  }
  if (update.terminated) text += "   [" + next + " is an end: nothing follows]";
  if (update.truncated && !update.terminated) {
    text += "   [the episode is cut off here; the value of " + next + " still counts]";
  }
  text += others_text(others);
  count(update, others);
  return text + "\n";
}

std::string UpdateTeller::others_text(std::span<const OtherChange> others) const {
  std::string text;
  for (std::size_t i = 0; i < std::min(most_others, others.size()); ++i) {
    text += fmt::format("\n         also {} = {}   was {}", choice_text(others[i].choice),
                        number_text(others[i].new_value), number_text(others[i].old_value));
  }
  if (others.size() > most_others) {
    text += fmt::format("\n         and {} more", others.size() - most_others);
  }
  return text;
}

State UpdateTeller::owner(std::uint64_t choice) const {
  State low = 0;
  for (auto high = static_cast<State>(mdp_.states()); high - low > 1;) {
    const State middle = low + (high - low) / 2;
    (mdp_.choice_begin(middle) <= choice ? low : high) = middle;
  }
  return low;
}

// "Q(HALL,To-CAVE)".
std::string UpdateTeller::choice_text(std::uint64_t choice) const {
  return fmt::format("{}({},{})", words_.q, mdp_.state_name(owner(choice)),
                     mdp_.action_name(choice));
}

void UpdateTeller::count(const Update& update, std::span<const OtherChange> others) {
  const std::uint64_t pair = mdp_.choice_begin(update.state) + update.action;
  q_[pair] = update.new_value;
  ++visits_[pair];
  for (const OtherChange& other : others) q_[other.choice] = other.new_value;
}

void UpdateTeller::write(JsonWriter& json, const Update& update, bool is_float,
                         std::optional<double> standard, std::span<const OtherChange> others) {
  json.begin_object().member("step", update.step);
  json.member("state", mdp_.state_name(update.state)).member("action", action_name(mdp_, update));
  json.key("reward").number(update.reward, is_float);
  json.member("next", mdp_.state_name(update.next));
  json.member("terminated", update.terminated).member("truncated", update.truncated);
  if (words_.chance) json.member("explored", update.explored);
  json.key("old").number(update.old_value, is_float);
  json.key("next_q").begin_array();
  if (!update.terminated) {
    for (std::uint64_t c = mdp_.choice_begin(update.next); c < mdp_.choice_end(update.next); ++c) {
      json.begin_object().member("action", mdp_.action_name(c));
      json.key("q").number(q_[c], is_float).end_object();
    }
  }
  json.end_array();
  json.key("best_next").number(update.best_next, is_float);
  json.member("target", update.target).member("step_size", update.step_size);
  json.key("new").number(update.new_value, is_float);
  if (standard) json.key("standard").number(*standard, true);
  if (words_.memory) {
    json.key("others").begin_array();
    for (const OtherChange& other : others) {
      json.begin_object().member("state", mdp_.state_name(owner(other.choice)));
      json.member("action", mdp_.action_name(other.choice));
      json.key("new").number(other.new_value, is_float).end_object();
    }
    json.end_array();
  }
  json.end_object();
  count(update, others);
}

std::optional<std::size_t> first_difference(const RuleComparison& view) {
  for (std::size_t i = 0; i < std::min(view.printed.size(), view.standard.size()); ++i) {
    if (!same(view.printed[i].new_value, view.standard[i].new_value)) return i;
  }
  return {};
}

std::string comparison_text(const RuleComparison& view) {
  const Mdp& mdp = *view.mdp;
  const double carry = view.mdp->carry(view.discount);
  const std::string discount = factor_text(carry);
  using Align = TextTable::Align;
  TextTable table({{"step", Align::right},
                   {"move"},
                   {"as printed: rE + " + discount + " * max QE"},
                   {"|"},
                   {"standard: r + " + discount + " * max Q"},
                   {""}});
  const auto first = first_difference(view);
  for (std::size_t i = 0; i < view.printed.size(); ++i) {
    const Update& printed = view.printed[i];
    std::string note;
    if (first == i) {
      note = fmt::format("<- first difference: {} against {}", sum_without_result(printed, carry),
                         sum_without_result(view.standard[i], carry));
    } else if (view.episodes && printed.terminated) {
      note = "end";
    } else if (view.episodes && printed.truncated) {
      note = "cut off";
    }
    table.row({std::to_string(printed.step),
               mdp.state_name(printed.state) + " " + action_name(mdp, printed),
               sum_text(printed, carry), "|", sum_text(view.standard[i], carry), std::move(note)});
  }
  return table.text();
}

}  // namespace quoll
