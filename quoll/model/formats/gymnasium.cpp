// Gymnasium's env.P as JSON: {"state": {"action": [[probability, next, reward,
// done], ...]}}, with lists for objects where states or actions are numbered.
// What Quoll knows beyond it stands around it: {"discount": 0.99, "start": ...,
// "P": {...}} (docs/formats.md).
//
// The value of a state in P is what P's own equation says: after an outcome
// that is done nothing follows. A state that only stays where it is, done and
// without reward, is an end; an outcome that is done in any other state leads
// to an end of its own.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "quoll/base/json.hpp"
#include "quoll/base/json_reader.hpp"
#include "quoll/base/text.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/letters.hpp"
#include "quoll/model/name_index.hpp"

namespace quoll {
namespace {

constexpr double usual_discount = 0.99;
constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

class GymnasiumReader {
 public:
  GymnasiumReader(std::string_view content, const std::string& path)
      : json_(content), path_(path) {}

  Result<MdpArrays> read() {
    a_.discount = usual_discount;
    read_top();
    if (json_.good() && !model_ && !in_frame_) json_.fail("a state expected");
    if (json_.good() && !model_) json_.fail("the member \"P\" expected");
    if (!json_.good() || !json_.end()) return json_.error(path_);
    if (!find_successors() || !find_mentioned()) return error_;
    place_ends();
    if (a_.outcome_reward.empty()) a_.reward.assign(a_.action.size(), 0.0);
    a_.state_names = states_.take(place_);
    for (const std::string& name : made_names_) a_.state_names.push_back(name);
    a_.action_names = actions_.take({});
    return std::move(a_);
  }

 private:
  struct Mention {
    std::uint32_t number;
    double weight;
  };

  void read_top();
  void read_frame(const std::string& name);
  void read_mentions(std::vector<Mention>& to);
  void read_labels();
  void read_states();
  void read_state(std::string_view name);
  void read_actions();
  void read_outcomes(std::string_view action);
  bool read_outcome();
  bool read_successor(std::uint32_t& number);
  bool read_done();
  bool proper(std::string_view name);
  std::uint32_t number_of(std::string_view name);
  bool find_successors();
  bool find_mentioned();
  bool mentioned_states(const std::vector<Mention>& from, std::vector<State>& states,
                        std::vector<double>* weights);
  bool pure_end(State s) const;
  void place_ends();

  JsonReader json_;
  const std::string& path_;
  MdpArrays a_;
  NameIndex states_, actions_;
  std::vector<std::uint32_t> place_;       // per number in states_: the state's index, or nobody
  std::vector<std::uint64_t> first_line_;  // per number in states_
  std::vector<bool> done_;                 // per outcome
  std::vector<std::string> made_names_;    // of ends that P has no state for
  std::vector<Mention> start_, terminal_;
  bool start_weighted_ = false;
  std::vector<std::pair<std::string, std::vector<Mention>>> labels_;
  bool model_ = false, in_frame_ = false;
  Error error_;
};

// Calls each() before every member or item; a list's items are called by their
// numbers.
template <class Each>
void for_each_named(JsonReader& json, Each each) {
  std::string name;
  if (json.peek() == JsonReader::Kind::list) {
    json.begin_list();
    for (std::uint64_t i = 0; json.next_item(); ++i) each(std::to_string(i));
  } else {
    json.begin_object();
    while (json.next_member(name)) each(name);
  }
}

void GymnasiumReader::read_top() {
  if (json_.peek() == JsonReader::Kind::list) return read_states();
  std::string name;
  json_.begin_object();
  while (json_.next_member(name)) {
    if (!model_ && !in_frame_)
      in_frame_ = name == "discount" && json_.peek() == JsonReader::Kind::number;
    if (in_frame_) {
      read_frame(name);
    } else {
      read_state(name);
    }
  }
}

void GymnasiumReader::read_frame(const std::string& name) {
  if (name == "discount") {
    json_.take(a_.discount);
  } else if (name == "alternating") {
    json_.take(a_.alternating);
  } else if (name == "reward") {
    json_.take(a_.reward_name);
  } else if (name == "actions" && !model_) {
    std::string action;
    json_.begin_list();
    while (json_.next_item()) {
      if (json_.take(action) && proper(action)) actions_.insert(action);
    }
  } else if (name == "start") {
    start_weighted_ = json_.peek() == JsonReader::Kind::object;
    read_mentions(start_);
  } else if (name == "terminal") {
    read_mentions(terminal_);
  } else if (name == "labels") {
    read_labels();
  } else if (name == "P" && !model_) {
    read_states();
  } else {
    json_.fail(
        "discount, alternating, actions, start, terminal, labels, "
        "reward and P expected, each "
        "once, actions before P, found '" +
        name + "'");
  }
}

// ["A", "B"], or {"A": 0.25, "B": 0.75}.
void GymnasiumReader::read_mentions(std::vector<Mention>& to) {
  std::string name;
  double weight = 0.0;
  if (json_.peek() == JsonReader::Kind::object) {
    json_.begin_object();
    while (json_.next_member(name)) {
      const std::uint32_t number = number_of(name);
      if (json_.take(weight)) to.push_back({number, weight});
    }
    return;
  }
  json_.begin_list();
  std::uint32_t number = 0;
  while (json_.next_item()) {
    if (read_successor(number)) to.push_back({number, 0.0});
  }
}

void GymnasiumReader::read_labels() {
  std::string name;
  json_.begin_object();
  while (json_.next_member(name)) {
    for (const auto& [known, states] : labels_) {
      if (known == name) json_.fail("each label once expected");
    }
    labels_.emplace_back(name, std::vector<Mention>());
    read_mentions(labels_.back().second);
  }
}

void GymnasiumReader::read_states() {
  model_ = true;
  for_each_named(json_, [&](const std::string& name) { read_state(name); });
}

bool GymnasiumReader::proper(std::string_view name) {
  const std::string_view fault = name_fault(name);
  return fault.empty() || json_.fail(std::string(fault));
}

std::uint32_t GymnasiumReader::number_of(std::string_view name) {
  const std::uint32_t number = states_.insert(name);
  if (number == place_.size()) {
    place_.push_back(nobody);
    first_line_.push_back(json_.line());
  }
  return number;
}

void GymnasiumReader::read_state(std::string_view name) {
  model_ = true;
  if (!proper(name)) return;
  const std::uint32_t number = number_of(name);
  const std::uint64_t states = a_.choice_begin.size();
  if (place_[number] != nobody) {
    json_.fail("state " + std::string(name) + " once expected");
    return;
  }
  if (states == max_states) {
    json_.fail("at most " + std::to_string(max_states) + " states expected");
    return;
  }
  place_[number] = static_cast<std::uint32_t>(states);
  a_.choice_begin.push_back(a_.action.size());
  read_actions();
}

void GymnasiumReader::read_actions() {
  for_each_named(json_, [&](const std::string& action) { read_outcomes(action); });
}

void GymnasiumReader::read_outcomes(std::string_view action) {
  if (!proper(action)) return;
  a_.action.push_back(actions_.insert(action));
  a_.outcome_begin.push_back(a_.next.size());
  a_.choice_line.push_back(static_cast<std::uint32_t>(json_.line()));
  json_.begin_list();
  while (json_.next_item()) read_outcome();
}

// [probability, next, reward, done]
bool GymnasiumReader::read_outcome() {
  double probability = 0.0, reward = 0.0;
  std::uint32_t next = 0;
  const auto item = [&] {
    return json_.next_item() || json_.fail("[probability, next, reward, done] expected");
  };
  if (!json_.begin_list() || !item() || !json_.take(probability) || !item() ||
      !read_successor(next) || !item() || !json_.take(reward) || !item() || !read_done()) {
    return false;
  }
  if (json_.next_item()) return json_.fail("[probability, next, reward, done] expected");
  a_.probability.push_back(probability);
  a_.next.push_back(next);
  a_.outcome_reward.push_back(reward);
  return json_.good();
}

bool GymnasiumReader::read_successor(std::uint32_t& number) {
  std::string name;
  if (json_.peek() == JsonReader::Kind::text) {
    if (!json_.take(name)) return false;
  } else {
    double value = 0.0;  // 36.0 is what some exports make of 36
    if (!json_.take(value)) return false;
    if (!(value >= 0.0 && value < 9e15) || value != std::floor(value)) {
      return json_.fail("a state's name or number expected");
    }
    name = std::to_string(static_cast<std::uint64_t>(value));
  }
  if (!proper(name)) return false;
  number = number_of(name);
  return true;
}

bool GymnasiumReader::read_done() {
  bool done = false;
  double number = 0.0;
  if (json_.peek() == JsonReader::Kind::number) {
    if (!json_.take(number)) return false;
    if (number != 0.0 && number != 1.0) return json_.fail("true or false expected");
    done = number == 1.0;
  } else if (!json_.take(done)) {
    return false;
  }
  done_.push_back(done);
  return true;
}

// From numbers of names to states.
bool GymnasiumReader::find_successors() {
  for (std::uint32_t number = 0; number < place_.size(); ++number) {
    if (place_[number] != nobody) continue;
    error_ = Error{path_, first_line_[number], 0,
                   "state '" + std::string(states_[number]) + "' is no state of P", ""};
    return false;
  }
  for (State& next : a_.next) next = place_[next];
  a_.choice_begin.push_back(a_.action.size());
  a_.outcome_begin.push_back(a_.next.size());
  return true;
}

bool GymnasiumReader::mentioned_states(const std::vector<Mention>& from, std::vector<State>& states,
                                       std::vector<double>* weights) {
  std::vector<std::pair<State, double>> list;
  for (const Mention& mention : from) list.emplace_back(place_[mention.number], mention.weight);
  std::sort(list.begin(), list.end());
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0 && list[i].first == list[i - 1].first) {
      error_ =
          Error{path_, 0, 0, "a state stands twice in a list of start, terminal or labels", ""};
      return false;
    }
    states.push_back(list[i].first);
    if (weights) weights->push_back(list[i].second);
  }
  return true;
}

bool GymnasiumReader::find_mentioned() {
  if (!mentioned_states(start_, a_.start, start_weighted_ ? &a_.start_probability : nullptr) ||
      !mentioned_states(terminal_, a_.terminal, nullptr)) {
    return false;
  }
  std::sort(labels_.begin(), labels_.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [name, states] : labels_) {
    if (!mentioned_states(states, a_.labels.emplace_back(Label{name, {}}).states, nullptr)) {
      return false;
    }
  }
  return true;
}

bool GymnasiumReader::pure_end(State s) const {
  const std::uint64_t begin = a_.outcome_begin[a_.choice_begin[s]];
  const std::uint64_t end = a_.outcome_begin[a_.choice_begin[s + 1]];
  for (std::uint64_t o = begin; o < end; ++o) {
    if (a_.next[o] != s || !done_[o] || a_.outcome_reward[o] != 0.0) return false;
  }
  return true;
}

void GymnasiumReader::place_ends() {
  const auto states = static_cast<State>(a_.choice_begin.size() - 1);
  std::vector<bool> ends(states, false);
  for (const State s : a_.terminal) ends[s] = true;
  a_.terminal.clear();
  for (State s = 0; s < states; ++s) {
    const bool choices = a_.choice_begin[s] < a_.choice_begin[s + 1];
    const bool declared = ends[s];
    ends[s] = declared || pure_end(s);
    if (declared || (ends[s] && choices)) a_.terminal.push_back(s);
  }
  std::vector<std::uint32_t> number(states);  // in states_, per state
  for (std::uint32_t i = 0; i < place_.size(); ++i) number[place_[i]] = i;
  std::vector<State> end_of(states, nobody);
  for (std::size_t o = 0; o < a_.next.size(); ++o) {
    State& next = a_.next[o];
    if (!done_[o] || ends[next]) continue;
    if (end_of[next] == nobody) {
      end_of[next] = static_cast<State>(a_.choice_begin.size() - 1);
      a_.choice_begin.push_back(a_.choice_begin.back());
      std::string name = std::string(states_[number[next]]) + " done";
      while (states_.find(name)) name += "'";
      made_names_.push_back(std::move(name));
    }
    next = end_of[next];
  }
}

}  // namespace

Result<MdpArrays> read_gymnasium(std::string_view content, const std::string& path) {
  return GymnasiumReader(content, path).read();
}

}  // namespace quoll
