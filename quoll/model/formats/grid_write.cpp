// Models as grid pictures. The rules behind the model are guessed from its moves; the guess is
// built and compared, so that what is written reads back equal or is refused with the reason.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quoll/model/formats/format.hpp"
#include "quoll/model/grid.hpp"

namespace quoll {
namespace {

constexpr std::string_view spare_letters =
    "ABCDEFHIJKLMNOQRTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";

Error refuse(const std::string& why) {
  return {"", 0, 0, "this model cannot be written as a grid: " + why, ""};
}

// r with base + r == sum, or nothing: one of the neighbours of sum - base if any.
std::optional<double> difference(double sum, double base) {
  const double r = sum - base;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double guess : {r, std::nextafter(r, -infinity), std::nextafter(r, infinity)}) {
    if (base + guess == sum) return guess;
  }
  return std::nullopt;
}

class GridGuess {
 public:
  explicit GridGuess(const Mdp& mdp) : mdp_(mdp), layout_(*mdp.layout()), entering_(mdp.states()) {}

  Result<Grid> make() {
    grid_.moves = static_cast<std::uint32_t>(mdp_.arrays().action_names.size());
    grid_.discount = mdp_.discount();
    for (State s = 0; s < mdp_.states(); ++s) {
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) look(s, c, o);
      }
    }
    if (contradiction_) {
      return refuse("moves into state " + mdp_.state_name(*contradiction_) +
                    " have different rewards");
    }
    if (grid_.slip > 1) return refuse("its moves lead elsewhere");
    grid_.move_reward = move_reward_.value_or(0.0);
    grid_.rows.assign(layout_.rows, std::string(layout_.columns, '#'));
    for (State s = 0; s < mdp_.states(); ++s) {
      const auto letter = letter_of(s);
      if (!letter) return refuse("too many different rewards for letters");
      put(s, *letter);
    }
    return put_starts();
  }

 private:
  void put(State s, char letter) {
    grid_.rows[layout_.cell[s] / layout_.columns][layout_.cell[s] % layout_.columns] = letter;
  }

  // One outcome tells the reward of its cell or of a move that stays, and the slip by its
  // direction.
  void look(State s, std::uint64_t c, std::uint64_t o) {
    const State next = mdp_.next(o);
    const double reward = mdp_.reward(c, o);
    if (next == s) {
      move_reward_ = reward;
      if (mdp_.outcome_end(c) - mdp_.outcome_begin(c) == 2 && grid_.slip == 0) {
        slip_if_straight(s, c, mdp_.probability(o));
      }
      return;
    }
    if (entering_[next] && *entering_[next] != reward) contradiction_ = next;
    entering_[next] = reward;
    if (!is_straight(s, c, next)) grid_.slip = 2 * mdp_.probability(o);
  }

  bool is_straight(State s, std::uint64_t c, State next) const {
    const auto [right, down] = layout_.direction[mdp_.arrays().action[c]];
    const std::int64_t columns = layout_.columns;
    const std::int64_t from = layout_.cell[s];
    const std::int64_t to = layout_.cell[next];
    return to / columns - from / columns == down && to % columns - from % columns == right;
  }

  // A move between two walls: who slips stays, so the chance to stay is the slip.
  void slip_if_straight(State s, std::uint64_t c, double staying) {
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
      if (mdp_.next(o) != s && !is_straight(s, c, mdp_.next(o))) return;
    }
    grid_.slip = staying;
  }

  std::optional<char> letter_of(State s) {
    const double reward = entering_[s].value_or(grid_.move_reward);
    const bool end = mdp_.terminal(s);
    if (reward == grid_.move_reward) return end ? 'G' : '.';
    if (end && reward == grid_.move_reward - 100.0) return 'P';
    const auto key = std::pair(end, std::bit_cast<std::uint64_t>(reward));
    const auto known = letters_.find(key);
    if (known != letters_.end()) return known->second;
    const auto added = difference(reward, grid_.move_reward);
    if (!added || letters_.size() == spare_letters.size()) return std::nullopt;
    const char letter = spare_letters[letters_.size()];
    letters_[key] = letter;
    grid_.reward[letter] = *added;
    if (end) grid_.terminal += letter;
    return letter;
  }

  bool default_start() const {
    std::size_t at = 0;
    for (State s = 0; s < mdp_.states(); ++s) {
      if (mdp_.terminal(s)) continue;
      if (at == mdp_.start().size() || mdp_.start()[at] != s) return false;
      ++at;
    }
    return at == mdp_.start().size();
  }

  Result<Grid> put_starts() {
    if (!mdp_.arrays().start_probability.empty())
      return refuse("its starts are not equally likely");
    if (default_start()) return std::move(grid_);
    std::optional<double> reward;
    for (const State s : mdp_.start()) {
      if (mdp_.terminal(s)) return refuse("start " + mdp_.state_name(s) + " is an end");
      if (entering_[s]) {
        if (reward && *reward != *entering_[s]) return refuse("its starts have different rewards");
        reward = entering_[s];
      }
      put(s, 'S');
    }
    if (reward && *reward != grid_.move_reward) {
      const auto added = difference(*reward, grid_.move_reward);
      if (!added) return refuse("the reward of its starts cannot be written");
      grid_.reward['S'] = *added;
    }
    return std::move(grid_);
  }

  const Mdp& mdp_;
  const Layout& layout_;
  Grid grid_;
  std::vector<std::optional<double>> entering_;  // per state: reward of moves into it
  std::optional<double> move_reward_;
  std::optional<State> contradiction_;
  std::map<std::pair<bool, std::uint64_t>, char> letters_;
};

bool same_names(const Names& a, const Names& b) {
  if (a.size() != b.size()) return false;
  for (std::uint64_t i = 0; i < a.size(); ++i) {
    if (a[i] != b[i]) return false;
  }
  return true;
}

// What of the two models differs first, or nothing.
std::optional<std::string> unlike(const MdpArrays& a, const MdpArrays& b) {
  if (a.choice_begin != b.choice_begin || a.action != b.action) return "its actions differ";
  if (a.outcome_begin != b.outcome_begin || a.next != b.next) return "its moves lead elsewhere";
  if (a.probability != b.probability) return "its probabilities are not those of one slip";
  if (a.reward != b.reward || a.outcome_reward != b.outcome_reward) {
    return "its rewards are not those of cells";
  }
  if (a.start != b.start || a.terminal != b.terminal) return "its starts or ends differ";
  if (a.layout->cell != b.layout->cell || a.layout->direction != b.layout->direction) {
    return "its cells are not in reading order";
  }
  if (!same_names(a.state_names, b.state_names)) return "its states have names of their own";
  if (!same_names(a.action_names, b.action_names)) return "its actions are not N E S W";
  return std::nullopt;
}

// The layout describes each state and action once, within the picture.
bool fits(const Mdp& mdp, const Layout& layout) {
  const std::uint64_t cells = std::uint64_t{layout.rows} * layout.columns;
  if (layout.cell.size() != mdp.states() || cells < mdp.states()) return false;
  if (layout.direction.size() != mdp.arrays().action_names.size()) return false;
  std::uint64_t least = 0;
  for (const std::uint32_t cell : layout.cell) {
    if (cell < least || cell >= cells) return false;
    least = std::uint64_t{cell} + 1;
  }
  return true;
}

}  // namespace

Result<std::string> write_grid(const Mdp& mdp) {
  if (mdp.alternating()) return refuse("two players move in turn in it");
  const Layout* layout = mdp.layout();
  if (layout == nullptr) return refuse("its states are no cells");
  const std::uint64_t actions = mdp.arrays().action_names.size();
  if (actions != 4 && actions != 8) return refuse("it has not 4 or 8 actions");
  if (!fits(mdp, *layout)) return refuse("its cells are not in reading order");
  const auto grid = GridGuess(mdp).make();
  if (!grid) return grid.error();
  const auto again = to_mdp(*grid);
  if (!again) return refuse(again.error().expected);
  if (const auto why = unlike(mdp.arrays(), again->arrays())) return refuse(*why);
  return to_text(*grid);
}

}  // namespace quoll
