#include "quoll/cli/play_actions.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "quoll/act/policy.hpp"
#include "quoll/base/file.hpp"
#include "quoll/base/json_tree.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/policy_file.hpp"
#include "quoll/model/formats/mentions.hpp"

namespace quoll::cli {
namespace {

class GivenActions final : public Chooser {
 public:
  explicit GivenActions(std::vector<std::string> words) : words_(std::move(words)) {}
  Result<std::optional<Action>> choose(const Player& player) override {
    if (taken_ == words_.size()) return std::optional<Action>();
    Result<Action> found = player.find_action(words_[taken_++]);
    if (!found) {
      Error error = found.error();
      error.file = "--actions";
      return error;
    }
    return std::optional<Action>(*found);
  }
  std::string name() const override { return "given actions"; }

 private:
  std::vector<std::string> words_;
  std::size_t taken_ = 0;
};

class UniformActions final : public Chooser {
 public:
  explicit UniformActions(std::uint64_t seed) : coin_(stream(seed, "behaviour")) {}
  Result<std::optional<Action>> choose(const Player& player) override {
    const Action count = player.actions();
    if (count == 0) return std::optional<Action>();
    return std::optional<Action>(coin_.below(count));
  }
  std::string name() const override { return "policy uniform"; }

 private:
  Rng coin_;
};

class PolicyActions final : public Chooser {
 public:
  /// `guess` = a random action where the policy has none.
  PolicyActions(std::string file, std::unique_ptr<Policy> policy, bool guess, std::uint64_t seed)
      : file_(std::move(file)), policy_(std::move(policy)), guess_(guess), random_(seed) {}
  Result<std::optional<Action>> choose(const Player& player) override {
    const Action action = player.action_of(*policy_);
    if (action != no_action) return std::optional<Action>(action);
    if (player.actions() == 0) return std::optional<Action>();
    if (guess_) return random_.choose(player);
    return Error{"--policy", 0, 0,
                 "the policy has no action for the state " + json_text(player.now().state) +
                     "; --unknown random goes on by chance",
                 ""};
  }
  std::string name() const override { return "policy " + file_; }

 private:
  std::string file_;
  std::unique_ptr<Policy> policy_;
  bool guess_;
  UniformActions random_;
};

/// A line per action on stdin; asks on stderr when a person sits there.
class HandActions final : public Chooser {
 public:
  Result<std::optional<Action>> choose(const Player& player) override {
    const bool person = isatty(0) != 0;
    for (;;) {
      if (person) fmt::print(stderr, "action ({})? ", choices(player));
      std::string line;
      if (!std::getline(std::cin, line)) return std::optional<Action>();
      const Result<std::vector<std::string>> words = words_of(line, "");
      if (words && words->empty()) continue;
      if (words && (words->front() == "quit" || words->front() == "q")) {
        return std::optional<Action>();
      }
      const Result<Action> found =
          words ? player.find_action(words->front()) : Result<Action>(words.error());
      if (found) return std::optional<Action>(*found);
      if (!person) return found.error();
      fmt::print(stderr, "{}\n", message(found.error()));
    }
  }
  std::string name() const override { return "by hand"; }

 private:
  static std::string choices(const Player& player) {
    std::string text;
    for (Action a = 0; a < player.actions() && a < 12; ++a) {
      text += (a ? ", " : "") + player.action_name(a);
    }
    return text + (player.actions() > 12 ? ", ..." : "") + "; quit";
  }
};

}  // namespace

void ActionOptions::declare(Options& options) {
  options.option("--policy", &policy, "FILE|uniform",
                 "who decides: a .csv, .json or .quoll file, or uniform");
  options.option("--unknown", &unknown, "stop | random",
                 "with a policy: where it has no action stop, or take a random one [stop]");
  options.option("--actions", &actions, "A,B,...|@FILE",
                 "the actions to take, by name or number; without --policy and --actions they are "
                 "read from stdin, one a line");
}

Result<std::string> text_or_file(const std::string& given) {
  if (!given.starts_with('@')) return given;
  return read_file(given.substr(1));
}

Result<std::vector<std::string>> words_of(std::string_view text, const std::string& place) {
  std::vector<Mention> mentions;
  std::uint64_t number = 0;
  for (const std::string_view line : split(text, '\n')) {
    const Result<void> parsed = parse_mentions(line, 0, ++number, mentions);
    if (!parsed) {
      Error error = parsed.error();
      error.file = place;
      return error;
    }
  }
  std::vector<std::string> words;
  for (Mention& mention : mentions) words.push_back(std::move(mention.text));
  return words;
}

Result<std::unique_ptr<Chooser>> chooser(const ActionOptions& options, const World& world,
                                         std::uint64_t seed) {
  if (!options.policy.empty() && options.actions) {
    return Error{"--actions", 0, 0, "a policy or actions expected, not both", ""};
  }
  const bool guess = options.unknown == "random";
  if (!options.unknown.empty() && !guess && options.unknown != "stop") {
    return Error{"--unknown", 0, 0, "stop or random expected, not '" + options.unknown + "'",
                 nearest(options.unknown, std::vector<std::string>{"stop", "random"})};
  }
  if (!options.unknown.empty() && (options.policy.empty() || options.policy == "uniform")) {
    return Error{"--unknown", 0, 0, "has an effect only with --policy FILE", ""};
  }
  if (options.actions) {
    const Result<std::string> text = text_or_file(*options.actions);
    if (!text) return text.error();
    Result<std::vector<std::string>> words = words_of(*text, "--actions");
    if (!words) return words.error();
    return std::unique_ptr<Chooser>(std::make_unique<GivenActions>(std::move(*words)));
  }
  if (options.policy == "uniform") {
    return std::unique_ptr<Chooser>(std::make_unique<UniformActions>(seed));
  }
  if (options.policy.empty()) return std::unique_ptr<Chooser>(std::make_unique<HandActions>());
  Result<std::unique_ptr<Policy>> policy = read_acting(options.policy, world);
  if (!policy) return policy.error();
  return std::unique_ptr<Chooser>(
      std::make_unique<PolicyActions>(options.policy, std::move(*policy), guess, seed));
}

}  // namespace quoll::cli
