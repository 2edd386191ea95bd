#pragma once
// A player who moves as a saved policy says, for worlds that take one as a parameter. What a saved
// run is, this floor does not know: whoever can read one says so once, at the program's beginning.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "quoll/base/error.hpp"
#include "quoll/base/parameters.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// Who chooses by what is observed where it is to move. Acting is for one thread at a time; a copy
/// shares nothing with it.
class SeeingPlayer {
 public:
  using Act = std::function<Action(std::span<const float>)>;

  SeeingPlayer() = default;
  /// `make` gives the same player anew, from any thread.
  explicit SeeingPlayer(std::function<Act()> make) : make_(std::move(make)) {
    if (make_) act_ = make_();
  }
  SeeingPlayer(const SeeingPlayer& other) : SeeingPlayer(other.make_) {}
  SeeingPlayer(SeeingPlayer&&) noexcept = default;
  SeeingPlayer& operator=(SeeingPlayer other) noexcept {
    make_.swap(other.make_);
    act_.swap(other.act_);
    return *this;
  }
  ~SeeingPlayer() = default;

  explicit operator bool() const { return bool{act_}; }
  Action operator()(std::span<const float> observation) const { return act_(observation); }

 private:
  std::function<Act()> make_;
  Act act_;
};

/// What a policy file holds.
struct SavedPolicy {
  std::string rows;     ///< CSV, header state,action, names as in the world
  SeeingPlayer player;  ///< or somebody for worlds without a table; then there are no rows
};

/// The policy in a file, for the opponent in the world called `world` with these parameters.
/// Error: not a policy of that world, among others.
using PolicyReader = Result<SavedPolicy> (*)(const std::string& path, std::string_view world,
                                             const Parameters& parameters);

/// Files that end in .csv are read as they are; .json and .quoll by the reader that was set.
Result<SavedPolicy> read_saved_policy(const std::string& path, std::string_view world,
                                      const Parameters& parameters);

/// For the beginning of a program, before any world is opened; nullptr takes it back.
void set_policy_reader(PolicyReader reader);

/// Whether a text is the name of a policy file, by its ending.
bool names_a_policy(std::string_view text);

}  // namespace quoll
