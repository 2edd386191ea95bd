// Unified Markov Binary: the arrays of a model in one tar archive. An uncompressed file is mapped
// and each array copied once, into its place in MdpArrays.
//
//   index.json                 counts, types, names of labels and rewards
//   state-to-choices.bin       choice_begin     uint64, absent: one choice per state
//   choice-to-branches.bin     outcome_begin    uint64, absent: one outcome per choice
//   branch-to-target.bin       next             uint64
//   branch-to-probability.bin  probability      double or rational
//   state-is-initial.bin       start            a bit per state
//   actions/choices/           action           uint32, and their names
//   annotations/, valuations/  rewards, labels, names of states

#include <algorithm>
#include <bit>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "quoll/base/bytes.hpp"
#include "quoll/base/compression.hpp"
#include "quoll/base/json_tree.hpp"
#include "quoll/base/mapped_file.hpp"
#include "quoll/base/text.hpp"
#include "quoll/model/formats/distinct_actions.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/tar.hpp"
#include "quoll/model/formats/umb.hpp"

namespace quoll {
namespace {

using umb::Type;

class UmbReader {
 public:
  explicit UmbReader(std::string_view archive) : archive_(archive) {}

  Result<MdpArrays> read() {
    if (open() && counts() && structure() && probabilities() && starts() && actions() &&
        rewards() && labels() && names()) {
      return std::move(a_);
    }
    return error_;
  }

 private:
  bool fail(std::string expected) {
    error_ = Error{"", 0, 0, std::move(expected), ""};
    return false;
  }
  template <class T>
  bool taken(Result<T> result, T& to) {
    if (!result) {
      error_ = result.error();
      return false;
    }
    to = *std::move(result);
    return true;
  }

  bool done(const Result<void>& result) {
    if (!result) error_ = result.error();
    return static_cast<bool>(result);
  }

  bool open();
  bool count(const char* key, std::uint64_t most, std::uint64_t& value);
  bool counts();
  bool bits(const std::string& name, std::vector<State>& list);
  bool structure();
  bool probabilities();
  bool starts();
  bool actions();
  bool rewards();
  bool reward_structure(const std::string& id, const Tree& annotation, RewardStructure& into);
  bool labels();
  bool names();

  std::string_view archive_;
  umb::Files files_;
  Tree index_;
  std::uint64_t states_ = 0, choices_ = 0, branches_ = 0, initial_ = 0, choice_actions_ = 0;
  MdpArrays a_;
  Error error_;
};

bool UmbReader::open() {
  auto entries = tar_entries(archive_);
  if (!entries) return fail(entries.error().expected);
  for (TarEntry& entry : *entries) files_.emplace(std::move(entry.name), entry.content);
  const std::string_view* const index = umb::find(files_, "index.json");
  if (!index) return fail("expected a tar archive with index.json");
  constexpr std::size_t largest = std::size_t{1} << 24;
  if (index->size() > largest) return fail("index.json: at most 16 MiB expected");
  auto tree = read_json(*index, "");
  if (!tree) {
    const Error& error = tree.error();
    return fail("index.json:" + std::to_string(error.line) + ":" + std::to_string(error.column) +
                ": " + error.expected);
  }
  index_ = *std::move(tree);
  const Tree* const version = index_.find("format-version");
  if (!version || !std::holds_alternative<std::int64_t>(version->value)) {
    return fail("index.json: format-version: a whole number expected");
  }
  const auto number = std::get<std::int64_t>(version->value);
  return number == 1 ||
         fail("index.json: format-version 1 expected, found " + std::to_string(number));
}

bool UmbReader::count(const char* key, std::uint64_t most, std::uint64_t& value) {
  const Tree* const tree = umb::at(index_, {"transition-system", key});
  const auto* const whole = tree ? std::get_if<std::int64_t>(&tree->value) : nullptr;
  if (!whole || *whole < 0 || static_cast<std::uint64_t>(*whole) > most) {
    return fail("index.json: transition-system." + std::string(key) +
                ": a whole number from 0 to " + std::to_string(most) + " expected");
  }
  value = static_cast<std::uint64_t>(*whole);
  return true;
}

bool UmbReader::counts() {
  constexpr std::uint64_t any = INT64_MAX / 16;
  std::uint64_t players = 0, branch_actions = 0, observations = 0;
  const Tree* const time = umb::at(index_, {"transition-system", "time"});
  if (!time || time->value != Tree(std::string("discrete")).value) {
    return fail("index.json: transition-system.time: \"discrete\" expected");
  }
  if (!count("#players", UINT32_MAX, players) || !count("#states", max_states, states_) ||
      !count("#initial-states", any, initial_) || !count("#choices", any, choices_) ||
      !count("#choice-actions", UINT32_MAX, choice_actions_) ||
      !count("#branches", any, branches_) ||
      !count("#branch-actions", UINT32_MAX, branch_actions) ||
      !count("#observations", any, observations)) {
    return false;
  }
  if (players > 1) {
    return fail("index.json: transition-system.#players: at most 1 expected, found " +
                std::to_string(players));
  }
  if (branch_actions > 0) a_.remarks.push_back("the actions of branches are not kept");
  if (observations > 0) {
    a_.remarks.push_back(counted(observations, "observation") +
                         ": read as if the state were seen, they are not kept");
  }
  return true;
}

// The states whose bits are set; none if the file is absent.
bool UmbReader::bits(const std::string& name, std::vector<State>& list) {
  const std::string_view* const found = umb::find(files_, name);
  if (!found) return true;
  auto set = umb::set_bits(*found, states_);
  if (!set) return fail(name + ": " + set.error().expected);
  list = *std::move(set);
  return true;
}

// Every count is compared with bytes that are there before anything of its size is allocated.
bool UmbReader::structure() {
  const std::string name = "branch-to-target.bin";
  const std::string_view* targets = nullptr;
  if (!taken(umb::file_of(files_, name, branches_ * 8), targets)) return false;
  if (!targets && branches_ > 0) return fail(name + ": missing");
  if (!taken(umb::offsets(files_, "choice-to-branches.bin", choices_, branches_),
             a_.outcome_begin) ||
      !taken(umb::offsets(files_, "state-to-choices.bin", states_, choices_), a_.choice_begin)) {
    return false;
  }
  if (a_.choice_begin.empty()) {
    a_.choice_begin.resize(states_ + 1);
    std::iota(a_.choice_begin.begin(), a_.choice_begin.end(), std::uint64_t{0});
  }
  a_.next.resize(branches_);
  std::uint64_t largest = 0;
  for (std::uint64_t b = 0; b < branches_; ++b) {
    const auto target = load_little<std::uint64_t>(targets->data() + 8 * b);
    largest = target > largest ? target : largest;
    a_.next[b] = static_cast<State>(target);
  }
  return branches_ == 0 || largest < states_ ||
         fail(name + ": state " + std::to_string(largest) + " of " + std::to_string(states_));
}

bool UmbReader::probabilities() {
  const Tree* const given = umb::at(index_, {"transition-system", "branch-probability-type"});
  if (!given) return true;  // a system without chance
  Type type;
  if (!taken(umb::type_of(given), type)) return false;
  const std::string name = "branch-to-probability.bin";
  if (!umb::find(files_, name) && branches_ > 0) return fail(name + ": missing");
  return done(umb::numbers(files_, name, type, branches_, a_.probability));
}

bool UmbReader::starts() {
  const std::string name = "state-is-initial.bin";
  if (!bits(name, a_.start)) return false;
  return a_.start.size() == initial_ || fail(name + ": " + counted(initial_, "state") +
                                             " expected, found " + std::to_string(a_.start.size()));
}

bool UmbReader::actions() {
  a_.action.assign(choices_, 0);
  if (choice_actions_ == 0) {  // numbered within each state
    std::uint64_t most = 0;
    for (std::uint64_t s = 0; s < states_; ++s) {
      const std::uint64_t begin = a_.choice_begin[s], end = a_.choice_begin[s + 1];
      most = end - begin > most ? end - begin : most;
      for (std::uint64_t c = begin; c < end; ++c) {
        a_.action[c] = static_cast<std::uint32_t>(c - begin);
      }
    }
    a_.action_names = Names::numbered("", most);
    return true;
  }
  const std::string name = "actions/choices/values.bin";
  const std::string_view* found = nullptr;
  if (!taken(umb::file_of(files_, name, choices_ * 4), found)) return false;
  std::uint32_t largest = 0;
  for (std::uint64_t c = 0; found && c < choices_; ++c) {
    a_.action[c] = load_little<std::uint32_t>(found->data() + 4 * c);
    largest = a_.action[c] > largest ? a_.action[c] : largest;
  }
  if (largest >= choice_actions_) {
    return fail(name + ": action " + std::to_string(largest) + " of " +
                std::to_string(choice_actions_));
  }
  // Of unnamed actions only those in use count.
  Names given = Names::numbered("", std::uint64_t{largest} + 1);
  if (umb::find(files_, "actions/choices/string-mapping.bin") &&
      !taken(umb::strings(files_, "actions/choices/", choice_actions_), given)) {
    return false;
  }
  name_actions(a_, std::move(given));
  return true;
}

// Rewards of states count for each of their choices, those of choices for each of their branches.
bool UmbReader::reward_structure(const std::string& id, const Tree& annotation,
                                 RewardStructure& into) {
  const std::string folder = "annotations/rewards/" + id + "/";
  Type type;
  if (!taken(umb::type_of(annotation.find("type")), type)) return false;
  if (annotation.find("probability-type")) return fail(folder + ": rewards by chance not known");
  std::vector<double> by_state;
  const auto values = [&](const char* of, std::uint64_t count, std::vector<double>& to) {
    return done(umb::numbers(files_, folder + of + "/values.bin", type, count, to));
  };
  if (!values("states", states_, by_state) || !values("choices", choices_, into.reward) ||
      !values("branches", branches_, into.outcome_reward)) {
    return false;
  }
  if (by_state.empty() && into.reward.empty() && into.outcome_reward.empty() && choices_ > 0) {
    return fail(folder + ": values of states, choices or branches expected");
  }
  const bool alone = into.reward.empty() && by_state.empty() && !into.outcome_reward.empty();
  if (!alone) into.reward.resize(choices_);
  for (std::uint64_t s = 0; !by_state.empty() && s < states_; ++s) {
    for (std::uint64_t c = a_.choice_begin[s]; c < a_.choice_begin[s + 1]; ++c) {
      into.reward[c] += by_state[s];
    }
  }
  if (alone || into.outcome_reward.empty()) return true;
  for (std::uint64_t c = 0; c < choices_; ++c) {
    const std::uint64_t begin = a_.outcome_begin.empty() ? c : a_.outcome_begin[c];
    const std::uint64_t end = a_.outcome_begin.empty() ? c + 1 : a_.outcome_begin[c + 1];
    for (std::uint64_t b = begin; b < end; ++b) into.outcome_reward[b] += into.reward[c];
  }
  return true;
}

// An annotation's name for people.
std::string alias(const std::string& id, const Tree& annotation) {
  const Tree* const given = annotation.find("alias");
  const auto* const text = given ? std::get_if<std::string>(&given->value) : nullptr;
  return text ? *text : id;
}

bool UmbReader::rewards() {
  const Tree* const group = umb::at(index_, {"annotations", "rewards"});
  const auto* const list = group ? std::get_if<Tree::Object>(&group->value) : nullptr;
  if (!list || list->empty()) {
    a_.reward.resize(choices_);
    return true;
  }
  // Values of few states become values of many choices: not more of them than bytes justify.
  if (list->size() * choices_ > 16 * archive_.size()) {
    return fail("annotations/rewards/: fewer structures expected in a file of this size");
  }
  std::set<std::string> known;
  for (const auto& [id, annotation] : *list) {
    RewardStructure structure;
    structure.name = alias(id, annotation);
    if (!known.insert(structure.name).second) {
      return fail("index.json: rewards " + structure.name + " stand twice");
    }
    if (!reward_structure(id, annotation, structure)) return false;
    if (&annotation == &list->front().second) {
      a_.reward_name = std::move(structure.name);
      a_.reward = std::move(structure.reward);
      a_.outcome_reward = std::move(structure.outcome_reward);
    } else {
      a_.other_rewards.push_back(std::move(structure));
    }
  }
  return true;
}

bool UmbReader::labels() {
  const Tree* const group = umb::at(index_, {"annotations", "aps"});
  const auto* const list = group ? std::get_if<Tree::Object>(&group->value) : nullptr;
  if (!list) return true;
  std::set<std::string> known;
  for (const auto& [id, annotation] : *list) {
    Label label{alias(id, annotation), {}};
    if (!bits("annotations/aps/" + id + "/states/values.bin", label.states)) return false;
    if (!known.insert(label.name).second || !known.insert("/" + id).second) {
      return fail("index.json: label " + label.name + " stands twice");
    }
    a_.labels.push_back(std::move(label));
  }
  std::sort(a_.labels.begin(), a_.labels.end(),
            [](const Label& a, const Label& b) { return a.name < b.name; });
  return true;
}

bool UmbReader::names() {
  a_.state_names = Names::numbered("", states_);
  if (const Tree* const description = umb::at(index_, {"valuations", "states"})) {
    auto given = umb::state_names(*description, files_, states_);
    if (given) {
      a_.state_names = *std::move(given);
    } else {
      a_.remarks.push_back("states are numbered: " + given.error().expected);
    }
  }
  const Tree* const tool = umb::at(index_, {"file-data", "tool"});
  const Tree* const own = umb::at(index_, {"file-data", "parameters"});
  if (!tool || tool->value != Tree(std::string("Quoll")).value || !own) return true;
  return done(umb::read_own(*own, files_, a_));
}

}  // namespace

Result<MdpArrays> read_umb(std::string_view content, const std::string& path) {
  if (!is_compressed(content)) return UmbReader(content).read();
  const Result<std::string> archive = decompress(content, path);
  if (!archive) return archive.error();
  return UmbReader(*archive).read();
}

Result<MdpArrays> read_umb_path(const std::string& path, const Parameters&) {
  const Result<MappedFile> file = MappedFile::open(path);
  if (!file) return file.error();
  return read_umb(file->bytes(), path);
}

}  // namespace quoll
