#pragma once
// Who decides in a played episode: given actions, a policy, chance, or a person.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/cli/options.hpp"
#include "quoll/experiment/player.hpp"

namespace quoll::cli {

/// --policy, --unknown and --actions.
struct ActionOptions {
  std::string policy;
  std::string unknown;  ///< what a policy does where it has no action; empty = stop
  std::optional<std::string> actions;

  void declare(Options& options);
};

/// Who decides: the next action, or nothing when there is none left (end of input, `quit`).
class Chooser {
 public:
  virtual ~Chooser() = default;
  virtual Result<std::optional<Action>> choose(const Player& player) = 0;
  virtual std::string name() const = 0;
};

/// The one that the options ask for. Errors name the option.
Result<std::unique_ptr<Chooser>> chooser(const ActionOptions& options, const World& world,
                                         std::uint64_t seed);

/// "@FILE" -> the file's text, else the text itself.
Result<std::string> text_or_file(const std::string& given);

/// Words between commas, blanks and line ends; one that holds such stands in quotes. Errors begin
/// with `place`.
Result<std::vector<std::string>> words_of(std::string_view text, const std::string& place);

}  // namespace quoll::cli
