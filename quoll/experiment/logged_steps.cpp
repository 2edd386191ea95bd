#include "quoll/experiment/logged_steps.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/model/formats/step_log.hpp"
#include "quoll/model/letters.hpp"
#include "quoll/model/name_index.hpp"

namespace quoll {
namespace {

constexpr std::uint64_t most_steps = 0xfffffffe;  // counts have 32 bits

// Calls row(log, step) for each row of each file, until it returns an Error.
template <class Begin, class Row>
Result<void> each_row(std::span<const std::string> files, const Begin& begin, const Row& row) {
  for (const std::string& path : files) {
    Result<Lines> lines = Lines::open(path);
    if (!lines) return lines.error();
    StepLog log(*lines, path);
    LoggedStep step;
    begin();
    while (log.next(step)) {
      const std::optional<Error> wrong = row(log, step);
      if (wrong) return *wrong;
    }
    if (log.error()) return *log.error();
  }
  return {};
}

// What logs name, collected row by row.
class Named {
 public:
  void begin_file() { begins_ = true; }

  std::optional<Error> add(const StepLog& log, const LoggedStep& step) {
    State from = 0, to = 0;
    if (auto wrong = number(log, StepLog::state, step.state, from)) return wrong;
    const std::uint32_t known = actions_.size();
    const std::uint32_t action = actions_.insert(step.action);
    if (action == known) {
      if (auto wrong = check(log, StepLog::action, step.action)) return wrong;
    }
    std::vector<std::uint32_t>& here = taken_[from];
    if (std::find(here.begin(), here.end(), action) == here.end()) here.push_back(action);
    began_[from] += begins_ ? 1 : 0;
    episodes_ += begins_ ? 1.0 : 0.0;
    begins_ = step.terminated || step.truncated;
    if (step.next_state.empty()) return std::nullopt;
    if (auto wrong = number(log, StepLog::next_state, step.next_state, to)) return wrong;
    if (!step.terminated) goes_on_[to] = 1;
    return std::nullopt;
  }

  Result<Mdp> model(double discount) {
    MdpArrays arrays;
    arrays.discount = discount;
    arrays.choice_begin.push_back(0);
    const std::uint32_t unknown = actions_.insert(unknown_action);
    for (State s = 0; s < taken_.size(); ++s) {
      if (taken_[s].empty() && goes_on_[s] != 0) taken_[s].push_back(unknown);
      for (const std::uint32_t action : taken_[s]) {
        arrays.action.push_back(action);
        arrays.next.push_back(s);
        arrays.reward.push_back(0.0);
      }
      arrays.choice_begin.push_back(arrays.action.size());
      if (began_[s] == 0) continue;
      arrays.start.push_back(s);
      arrays.start_probability.push_back(static_cast<double>(began_[s]) / episodes_);
    }
    arrays.state_names = states_.take({});
    arrays.action_names = actions_.take({});
    return Mdp::make(std::move(arrays));
  }

  bool empty() const { return taken_.empty(); }

 private:
  static std::optional<Error> check(const StepLog& log, StepLog::Column column,
                                    std::string_view name) {
    const std::string_view reason = name_fault(name);
    if (reason.empty()) return std::nullopt;
    return log.fault(column, std::string(reason));
  }

  std::optional<Error> number(const StepLog& log, StepLog::Column column, std::string_view name,
                              State& found) {
    found = states_.insert(name);
    if (found < taken_.size()) return std::nullopt;
    if (auto wrong = check(log, column, name)) return wrong;
    if (found >= max_states) return log.fault(column, "less than 2^31 states expected");
    taken_.emplace_back();
    began_.push_back(0);
    goes_on_.push_back(0);
    return std::nullopt;
  }

  NameIndex states_, actions_;
  std::vector<std::vector<std::uint32_t>> taken_;  // per state: its actions, as first met
  std::vector<std::uint32_t> began_;               // per state: episodes
  std::vector<std::uint8_t> goes_on_;              // per state: it followed a step
  double episodes_ = 0.0;
  bool begins_ = true;
};

// Finds the states and actions of a model by name or number.
class Finder {
 public:
  explicit Finder(const Mdp& names) : names_(names) {
    for (State s = 0; s < names.states(); ++s) states_.insert(names.state_name(s));
    const Names& actions = names.arrays().action_names;
    for (std::uint64_t i = 0; i < actions.size(); ++i) {
      word_.push_back(words_.insert(actions[i]));
    }
  }

  std::optional<Error> find(const StepLog& log, const LoggedStep& row, Update& step) const {
    if (auto wrong = find_state(log, StepLog::state, row.state, step.state)) return wrong;
    if (names_.terminal(step.state)) {
      return log.fault(StepLog::state, "state " + names_.state_name(step.state) +
                                           " is an end of this world: no step begins there");
    }
    if (auto wrong = find_action(log, row.action, step)) return wrong;
    step.next = step.state;
    step.reward = row.reward;
    step.terminated = row.terminated;
    step.truncated = row.truncated;
    if (row.next_state.empty()) return std::nullopt;
    if (auto wrong = find_state(log, StepLog::next_state, row.next_state, step.next)) return wrong;
    step.terminated = step.terminated || names_.terminal(step.next);
    return std::nullopt;
  }

 private:
  std::optional<Error> find_state(const StepLog& log, StepLog::Column column, std::string_view name,
                                  State& found) const {
    if (const auto known = states_.find(name)) {
      found = *known;
      return std::nullopt;
    }
    const auto number = parse_count(name);
    if (number && *number < names_.states()) {
      found = static_cast<State>(*number);
      return std::nullopt;
    }
    return log.fault(column, "no state '" + std::string(name) + "' in this world",
                     names_.arrays().state_names.nearest(name));
  }

  std::optional<Error> find_action(const StepLog& log, std::string_view name, Update& step) const {
    const std::uint64_t begin = names_.choice_begin(step.state);
    const Action count = names_.actions(step.state);
    if (const auto word = words_.find(name)) {
      for (step.action = 0; step.action < count; ++step.action) {
        if (word_[names_.arrays().action[begin + step.action]] == *word) return std::nullopt;
      }
    }
    const auto number = parse_count(name);
    if (number && *number < count) {
      step.action = static_cast<Action>(*number);
      return std::nullopt;
    }
    Nearest nearest(name);
    for (Action a = 0; a < count; ++a) nearest.offer(names_.action_name(begin + a));
    return log.fault(
        StepLog::action,
        "no action '" + std::string(name) + "' at state " + names_.state_name(step.state),
        nearest.best());
  }

  const Mdp& names_;
  NameIndex states_, words_;
  std::vector<std::uint32_t> word_;  // per action name of the model: its number in words_
};

}  // namespace

Result<Mdp> names_in_logs(std::span<const std::string> files, double discount) {
  Named named;
  const Result<void> read = each_row(
      files, [&] { named.begin_file(); },
      [&](const StepLog& log, const LoggedStep& step) { return named.add(log, step); });
  if (!read) return read.error();
  if (named.empty())
    return Error{files.back(), 0, 0, "at least one step below the header expected", ""};
  return named.model(discount);
}

Result<void> read_steps(std::span<const std::string> files, const Mdp& names,
                        const std::function<void(std::span<const Update>)>& take) {
  const Finder finder(names);
  constexpr std::size_t at_once = 4096;
  std::vector<Update> steps;
  steps.reserve(at_once);
  std::uint64_t count = 0;
  const auto row = [&](const StepLog& log, const LoggedStep& logged) -> std::optional<Error> {
    Update step;
    step.step = ++count;
    if (count > most_steps) return log.fault(StepLog::state, "less than 2^32 steps expected");
    if (auto wrong = finder.find(log, logged, step)) return wrong;
    if (steps.size() == at_once) {
      take(steps);
      steps.clear();
    }
    steps.push_back(step);
    return std::nullopt;
  };
  // The last row of a file ends an episode: what follows in the next file began anew.
  const Result<void> read = each_row(
      files,
      [&] {
        if (!steps.empty()) steps.back().truncated = true;
      },
      row);
  if (!read) return read;
  if (count == 0)
    return Error{files.back(), 0, 0, "at least one step below the header expected", ""};
  take(steps);
  return {};
}

}  // namespace quoll
