// Models as Unified Markov Binary that read_umb() takes back with every index and every bit.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <set>
#include <utility>

#include "quoll/base/bytes.hpp"
#include "quoll/base/json_tree.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/tar.hpp"
#include "quoll/model/formats/umb.hpp"

namespace quoll {
namespace {

using umb::Own;
using Object = Tree::Object;

Tree text(std::string_view of) {
  return Tree(std::string(of));
}
Tree whole(std::uint64_t of) {
  return Tree(static_cast<std::int64_t>(of));
}
Tree type(const char* name, std::uint64_t bits) {
  return Tree(Object{{"type", text(name)}, {"size", whole(bits)}});
}

class UmbWriter {
 public:
  explicit UmbWriter(const Mdp& mdp) : m_(mdp), a_(mdp.arrays()) {}

  std::string write() {
    own_.discount = m_.discount();
    own_.alternating = m_.alternating();
    own_.names = name_rule();
    Tree labels = describe_labels();
    Tree rewards = describe_rewards();
    std::string index = json_text(describe(std::move(labels), std::move(rewards)));
    // Address space, not memory: nearly all of it is one of these arrays.
    out_.reserve((std::size_t{1} << 20) + index.size() +
                 8 * (m_.states() * 4 + m_.choices() * (3 + a_.other_rewards.size()) +
                      m_.outcomes() * (3 + a_.other_rewards.size())));
    file("index.json", index.size(), [&] { out_ += index; });
    structure();
    actions();
    for (std::size_t i = 0; i < a_.labels.size(); ++i) {
      bits("annotations/aps/" + ids_[i] + "/states/values.bin", a_.labels[i].states);
    }
    std::size_t id = a_.labels.size();
    reward_values(ids_[id++], a_.reward, a_.outcome_reward);
    for (const RewardStructure& other : a_.other_rewards) {
      reward_values(ids_[id++], other.reward, other.outcome_reward);
    }
    own_annotations();
    names();
    out_ += tar_end();
    return std::move(out_);
  }

 private:
  template <class Fill>
  void file(std::string_view name, std::uint64_t size, Fill fill) {
    out_ += tar_head(name, size);
    fill();
    out_.append(tar_padding(size), '\0');
  }
  template <class Number, class List>
  void numbers(std::string_view name, const List& list) {
    file(name, list.size() * sizeof(Number), [&] {
      for (const auto value : list) {
        if constexpr (std::is_same_v<decltype(value), const double>) {
          append_little(out_, std::bit_cast<std::uint64_t>(value));
        } else {
          append_little(out_, static_cast<Number>(value));
        }
      }
    });
  }
  void bits(std::string_view name, const std::vector<State>& states) {
    std::vector<std::uint64_t> words((m_.states() + 63) / 64, 0);
    for (const State s : states) words[s / 64] |= std::uint64_t{1} << s % 64;
    numbers<std::uint64_t>(name, words);
  }

  // The identifier of an annotation: of small letters, digits, '_' and '-', each once in its group.
  std::string identifier(std::string_view name, std::set<std::string>& taken) {
    std::string id;
    for (const char letter : name.substr(0, 20)) {
      const char small = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter + 32) : letter;
      const bool fits = (small >= 'a' && small <= 'z') || (small >= '0' && small <= '9');
      id += fits || small == '-' ? small : '_';
    }
    if (id.empty()) id = "reward";
    const std::string plain = id;
    for (int i = 2; !taken.insert(id).second; ++i) id = plain + "-" + std::to_string(i);
    ids_.push_back(id);
    return id;
  }

  static Tree annotation(std::string_view alias, const char* applies, Tree of_type) {
    return Tree(Object{{"alias", text(alias)},
                       {"applies-to", Tree(Tree::List{text(applies)})},
                       {"type", std::move(of_type)}});
  }
  Tree describe_labels() {
    Object group;
    std::set<std::string> taken;
    for (const Label& label : a_.labels) {
      group.emplace_back(identifier(label.name, taken),
                         annotation(label.name, "states", type("bool", 1)));
    }
    return Tree(std::move(group));
  }
  Tree describe_rewards() {
    Object group;
    std::set<std::string> taken;
    const auto add = [&](std::string_view name, bool by_outcome) {
      group.emplace_back(identifier(name, taken),
                         annotation(name, by_outcome ? "branches" : "choices", type("double", 64)));
    };
    add(a_.reward_name, !a_.outcome_reward.empty());
    for (const RewardStructure& other : a_.other_rewards) {
      add(other.name, !other.outcome_reward.empty());
    }
    return Tree(std::move(group));
  }
  void reward_values(const std::string& id, const std::vector<double>& by_choice,
                     const std::vector<double>& by_outcome) {
    const std::string folder = "annotations/rewards/" + id + "/";
    if (by_outcome.empty()) {
      numbers<std::uint64_t>(folder + "choices/values.bin", by_choice);
    } else {
      numbers<std::uint64_t>(folder + "branches/values.bin", by_outcome);
    }
  }

  // How the names of the states come about; the prefix of numbered ones.
  std::string name_rule() {
    if (a_.state_names.is_stored()) return "stored";
    const auto same = [&](const Names& names) {
      for (std::uint64_t s = 0; s < m_.states(); ++s) {
        if (names[s] != a_.state_names[s]) return false;
      }
      return true;
    };
    if (a_.layout && same(Names::cells(a_.layout->columns, a_.layout->cell))) return "cells";
    const std::string first = a_.state_names[0];
    own_.prefix = first.substr(0, first.size() - 1);
    if (first.back() == '0' && same(Names::numbered(own_.prefix, m_.states()))) return "numbered";
    own_.prefix.clear();
    return "stored";
  }

  Tree describe(Tree labels, Tree rewards) {
    Tree parameters = tree_of(own_);
    Object marks{{"terminal", annotation("terminal", "states", type("bool", 1))}};
    if (!a_.start_probability.empty()) {
      marks.emplace_back("start", annotation("start", "states", type("double", 64)));
    }
    if (a_.layout) {
      const Layout& layout = *a_.layout;
      Own::Picture picture{layout.rows, layout.columns, {}, {}, {}};
      for (const auto& [right, down] : layout.direction) {
        picture.right.push_back(right);
        picture.down.push_back(down);
      }
      if (layout.frame) {
        picture.frame = {layout.frame->side, layout.frame->x, layout.frame->y, layout.frame->yaw};
      }
      std::get<Object>(parameters.value).emplace_back("layout", tree_of(picture));
      marks.emplace_back("cell", annotation("cell", "states", type("uint", 64)));
    }
    Object system{
        {"time", text("discrete")},          {"#players", whole(1)},
        {"#states", whole(m_.states())},     {"#initial-states", whole(m_.start().size())},
        {"#choices", whole(m_.choices())},   {"#choice-actions", whole(a_.action_names.size())},
        {"#branches", whole(m_.outcomes())}, {"#branch-actions", whole(0)},
        {"#observations", whole(0)},         {"branch-probability-type", type("double", 64)}};
    Object index{
        {"format-version", whole(1)},
        {"format-revision", whole(0)},
        {"model-data", Tree(Object{})},
        {"file-data", Tree(Object{{"tool", text("Quoll")}, {"parameters", std::move(parameters)}})},
        {"transition-system", Tree(std::move(system))},
        {"annotations", Tree(Object{{"aps", std::move(labels)},
                                    {"rewards", std::move(rewards)},
                                    {"quoll", Tree(std::move(marks))}})}};
    if (own_.names == "stored") index.emplace_back("valuations", describe_names());
    return Tree(std::move(index));
  }
  // A valuation of one text.
  Tree describe_names() const {
    const Tree variable(Object{{"name", text("name")}, {"type", type("string", 64)}});
    const Tree valuation(Object{{"variables", Tree(Tree::List{variable})}});
    return Tree(Object{{"states", Tree(Object{{"unique", Tree(true)},
                                              {"#strings", whole(m_.states())},
                                              {"classes", Tree(Tree::List{valuation})}})}});
  }

  void structure() {
    numbers<std::uint64_t>("state-to-choices.bin", a_.choice_begin);
    if (!a_.outcome_begin.empty()) {
      numbers<std::uint64_t>("choice-to-branches.bin", a_.outcome_begin);
    }
    numbers<std::uint64_t>("branch-to-target.bin", a_.next);
    file("branch-to-probability.bin", m_.outcomes() * 8, [&] {
      for (std::uint64_t o = 0; o < m_.outcomes(); ++o) {
        append_little(out_, std::bit_cast<std::uint64_t>(m_.probability(o)));
      }
    });
    bits("state-is-initial.bin", a_.start);
  }

  void strings(const std::string& folder, const Names& names) {
    std::string all;
    std::vector<std::uint64_t> offsets{0};
    for (std::uint64_t i = 0; i < names.size(); ++i) {
      all += names[i];
      offsets.push_back(all.size());
    }
    numbers<std::uint64_t>(folder + "string-mapping.bin", offsets);
    file(folder + "strings.bin", all.size(), [&] { out_ += all; });
  }
  void actions() {
    numbers<std::uint32_t>("actions/choices/values.bin", a_.action);
    strings("actions/choices/", a_.action_names);
  }

  void own_annotations() {
    bits(umb::own_ends, a_.terminal);
    if (!a_.start_probability.empty()) {
      std::vector<double> chance(m_.states(), 0.0);
      for (std::size_t i = 0; i < a_.start.size(); ++i) {
        chance[a_.start[i]] = a_.start_probability[i];
      }
      numbers<std::uint64_t>(umb::own_starts, chance);
    }
    if (a_.layout) numbers<std::uint64_t>(umb::own_cells, a_.layout->cell);
  }
  void names() {
    if (own_.names != "stored") return;
    file("valuations/states/valuations.bin", m_.states() * 8, [&] {
      for (std::uint64_t s = 0; s < m_.states(); ++s) append_little(out_, s);
    });
    strings("valuations/states/", a_.state_names);
  }

  const Mdp& m_;
  const MdpArrays& a_;
  Own own_;
  std::vector<std::string> ids_;  // of labels, then of rewards
  std::string out_;
};

}  // namespace

Result<std::string> write_umb(const Mdp& mdp) {
  const Result<void> proper = proper_names(mdp);
  if (!proper) return proper.error();
  return UmbWriter(mdp).write();
}

}  // namespace quoll
