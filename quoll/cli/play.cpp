// quoll play WORLD: one lane of a world, step by step, by a policy, by given actions or by hand.

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <iostream>
#include <optional>

#include "quoll/act/policy.hpp"
#include "quoll/base/file.hpp"
#include "quoll/base/json_tree.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/policy_file.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/experiment/player.hpp"
#include "quoll/report/drawing_svg.hpp"

namespace quoll::cli {
namespace {

struct PlaySettings {
  std::uint64_t seed = 1;
  std::uint64_t steps = 0;
  std::uint64_t episode_steps = 0;
  double discount = 0.0;

  void describe(Describer& d) {
    d("seed", seed, "which random numbers the world and the uniform policy take");
    d("steps", steps, "stop after so many steps in all; 0 = at the episode's end, or 1,000,000");
    d("episode_steps", episode_steps,
      "steps after which an episode is cut off; 0 = the world's own limit");
    d("discount", discount, 0, 1, "discount factor of the discounted return; 0 = the world's own");
  }
};

struct PlayOptions {
  WorldOption world;
  GivenSettings given;
  std::string policy, actions, state, draws, render, record, drawing;
  bool json = false;
  bool go_on = false;
};

/// "@FILE" -> the file's text, else the text itself.
Result<std::string> text_or_file(const std::string& given) {
  if (!given.starts_with('@')) return given;
  return read_file(given.substr(1));
}

/// Words between commas, blanks and line ends.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words(1);
  for (const char letter : text) {
    if (letter == ',' || letter == ' ' || letter == '\n' || letter == '\r' || letter == '\t') {
      if (!words.back().empty()) words.emplace_back();
    } else {
      words.back() += letter;
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

Result<std::shared_ptr<const std::vector<double>>> read_draws(const std::string& given) {
  if (given.empty()) return std::shared_ptr<const std::vector<double>>();
  const Result<std::string> text = text_or_file(given);
  if (!text) return text.error();
  std::vector<double> draws;
  for (const std::string& word : words_of(*text)) {
    double draw = 0.0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), draw);
    if (read.ec != std::errc() || read.ptr != word.data() + word.size() || !(draw >= 0.0)) {
      return Error{"--draws", 0, 0, "numbers from 0 on expected, not '" + word + "'", ""};
    }
    draws.push_back(draw);
  }
  return std::make_shared<const std::vector<double>>(std::move(draws));
}

/// Who decides: the next action, or nothing when there is none left (end of input, `quit`).
class Chooser {
 public:
  virtual ~Chooser() = default;
  virtual Result<std::optional<Action>> choose(const Player& player) = 0;
  virtual std::string name() const = 0;
};

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

class TableActions final : public Chooser {
 public:
  TableActions(std::string file, std::vector<Action> actions)
      : file_(std::move(file)), policy_(std::move(actions)) {}
  Result<std::optional<Action>> choose(const Player& player) override {
    const Action action = policy_(player.now().number);
    if (action != no_action) return std::optional<Action>(action);
    if (player.actions() == 0) return std::optional<Action>();
    return Error{"--policy", 0, 0,
                 "the policy has no action for the state " + json_text(player.now().state), ""};
  }
  std::string name() const override { return "policy " + file_; }

 private:
  std::string file_;
  TablePolicy policy_;
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
      const std::vector<std::string> words = words_of(line);
      if (words.empty()) continue;
      if (words[0] == "quit" || words[0] == "q") return std::optional<Action>();
      Result<Action> found = player.find_action(words[0]);
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

Result<std::unique_ptr<Chooser>> chooser(const PlayOptions& options, const World& world,
                                         std::uint64_t seed) {
  if (!options.policy.empty() && !options.actions.empty()) {
    return Error{"--actions", 0, 0, "a policy or actions expected, not both", ""};
  }
  if (!options.actions.empty()) {
    const Result<std::string> text = text_or_file(options.actions);
    if (!text) return text.error();
    return std::unique_ptr<Chooser>(std::make_unique<GivenActions>(words_of(*text)));
  }
  if (options.policy == "uniform") {
    return std::unique_ptr<Chooser>(std::make_unique<UniformActions>(seed));
  }
  if (options.policy.empty()) return std::unique_ptr<Chooser>(std::make_unique<HandActions>());
  Result<std::vector<Action>> actions = read_policy(options.policy, world);
  if (!actions) return actions.error();
  return std::unique_ptr<Chooser>(
      std::make_unique<TableActions>(options.policy, std::move(*actions)));
}

/// --state: @FILE.json, JSON, or the name or number of a state.
Result<void> place(Player& player, const std::string& given) {
  const Result<std::string> text = text_or_file(given);
  if (!text) return text.error();
  if (!given.starts_with('@') && player.restart(Tree(std::string(*text)))) return {};
  const std::string source = given.starts_with('@') ? given.substr(1) : "--state";
  const Result<Tree> tree = read_json(*text, source);
  if (!tree && (given.starts_with('@') || given.find_first_of("[{") == 0)) return tree.error();
  const Tree state = tree ? *tree : Tree(std::string(*text));
  if (Result<void> done = player.restart(state); !done) {
    Error error = done.error();
    error.file = source;
    return error;
  }
  return {};
}

std::string state_text(const Moment& now) {
  if (const auto* const name = std::get_if<std::string>(&now.state.value)) return *name;
  return json_text(now.state);
}

std::string json_line(const Moment& now) {
  JsonWriter json;
  json.begin_object().member("t", now.t).key("state");
  write_tree(json, now.state);
  json.key("observation");
  write_tree(json, now.observation);
  if (now.action) {
    json.member("action", *now.action).member("reward", now.reward);
  } else {
    json.null_member("action").null_member("reward");
  }
  json.member("terminated", now.terminated).member("truncated", now.truncated);
  json.member("return", now.total).member("discounted_return", now.discounted).end_object();
  return json.text() + "\n";
}

std::string csv_line(std::uint64_t episode, const Moment& now) {
  const auto quoted = [](std::string text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) {
      text.insert(at, 1, '"');
    }
    return '"' + text + '"';
  };
  return fmt::format("{},{},{},{},{},{:d},{:d}\n", episode, now.t, quoted(state_text(now)),
                     quoted(now.action ? now.action_name : ""),
                     now.action ? shortest(now.reward) : "", now.terminated, now.truncated);
}

/// Plays and prints as it goes.
class Session {
 public:
  Session(const PlayOptions& options, Player& player, Chooser& chooser)
      : options_(options), player_(player), chooser_(chooser) {}

  Result<void> run(std::uint64_t steps) {
    show();
    std::uint64_t taken = 0;
    const std::uint64_t most = steps == 0 ? 1'000'000 : steps;
    while (taken < most && !interrupted()) {
      if (player_.now().over()) {
        if (!options_.go_on) break;
        player_.restart();
        ++episode_;
        show();
        continue;
      }
      const Result<std::optional<Action>> action = chooser_.choose(player_);
      if (!action) return action.error();
      if (!*action) break;
      player_.step(**action);
      ++taken;
      if (!player_.draws_left()) {
        return Error{"--draws", 0, 0,
                     fmt::format("another draw in its range expected at step {}", taken), ""};
      }
      show();
    }
    return {};
  }
  const std::string& log() const { return log_; }
  bool printed() const { return printed_; }

 private:
  void show() {
    const Moment& now = player_.now();
    if (!options_.record.empty()) log_ += csv_line(episode_, now);
    std::string text;
    if (options_.json) {
      text = json_line(now);
    } else {
      const bool seen = options_.render == "text";
      const bool named = std::holds_alternative<std::string>(now.state.value);
      text = named || !seen ? fmt::format("t {:<4} {}", now.t, state_text(now))
                            : fmt::format("t {}", now.t);
      if (now.action) {
        text += fmt::format("   {}  reward {}  return {}", now.action_name, number_text(now.reward),
                            number_text(now.total));
      }
      if (now.terminated) text += "   terminated";
      if (now.truncated) text += "   truncated";
      text += "\n";
      if (options_.render == "text") text += player_.text() + "\n";
    }
    printed_ = print(text) && printed_;
  }

  const PlayOptions& options_;
  Player& player_;
  Chooser& chooser_;
  std::uint64_t episode_ = 0;
  std::string log_ = "episode,t,state,action,reward,terminated,truncated\n";
  bool printed_ = true;
};

Result<void> write_drawing(const PlayOptions& options, const World& world, const Player& player) {
  if (options.drawing.empty()) return {};
  const Drawing drawing = player.drawing();
  if (drawing.width <= 0.0) {
    return Error{"--drawing", 0, 0,
                 "the world " + world.name + " has no picture; --render text shows its states", ""};
  }
  const Picture picture =
      drawing_svg(drawing, fmt::format("{}, step {}", world.name, player.now().t));
  return write_output(options.drawing, picture.svg, {options.world.name, options.policy});
}

Result<int> played(const PlayOptions& options) {
  PlaySettings asked;
  if (const Result<void> applied = options.given.apply(settings_of(asked)); !applied) {
    return applied.error();
  }
  if (!options.drawing.empty() && !options.drawing.ends_with(".svg")) {
    return Error{"--drawing", 0, 0,
                 "a name that ends in .svg expected, not '" + options.drawing + "'", ""};
  }
  if (!options.render.empty() && options.render != "text") {
    return Error{"--render", 0, 0,
                 "text expected, not '" + options.render + "' (a picture: --drawing FILE.svg)", ""};
  }
  const Result<World> world = options.world.open();
  if (!world) return world.error();
  const auto draws = read_draws(options.draws);
  if (!draws) return draws.error();
  const Result<std::unique_ptr<Chooser>> who = chooser(options, *world, asked.seed);
  if (!who) return who.error();
  Player player(*world, {1, asked.seed, asked.episode_steps, *draws},
                asked.discount > 0.0 ? asked.discount : world->discount);
  if (options.state.empty()) {
    player.restart();
    if (!player.draws_left()) {
      return Error{"--draws", 0, 0, "a draw in its range expected for the start", ""};
    }
  } else if (const Result<void> done = place(player, options.state); !done) {
    return done.error();
  }
  if (options.render == "text" && !options.json && player.text().empty()) {
    return Error{"--render", 0, 0, "the world " + world->name + " has no text form", ""};
  }
  catch_interrupts();
  Session session(options, player, **who);
  const Result<void> ran = session.run(asked.steps);
  if (!ran) return ran.error();
  if (!options.record.empty()) {
    const Result<void> written =
        write_output(options.record, session.log(), {options.world.name, options.policy});
    if (!written) return written.error();
  }
  if (const Result<void> drawn = write_drawing(options, *world, player); !drawn) {
    return drawn.error();
  }
  return session.printed() ? int{done} : int{user_error};
}

}  // namespace

void declare_play(Options& options) {
  auto given = std::make_shared<PlayOptions>();
  given->world.declare(options);
  options.option("--policy", &given->policy, "FILE|uniform",
                 "who decides: a .csv, .json or .quoll file, or uniform");
  options.option("--actions", &given->actions, "A,B,...|@FILE",
                 "the actions to take, by name or number; without --policy and --actions they are "
                 "read from stdin, one a line");
  options.option("--state", &given->state, "STATE|@FILE.json",
                 "begin in this state: its name or number, or the JSON that --json shows");
  options.option("--draws", &given->draws, "NUMBERS|@FILE",
                 "the world's random draws, in order, instead of a generator");
  options.option("--render", &given->render, "text", "show each state as text");
  options.option("--drawing", &given->drawing, "FILE.svg", "a picture of the last state");
  options.option("--record", &given->record, "LOG.csv", "write every step to a file");
  options.flag("--continue", &given->go_on, "begin another episode after an end");
  options.flag("--json", &given->json, "print one JSON object a line");
  PlaySettings defaults;
  given->given.declare_flags(options, settings_of(defaults));
  options.run([given] {
    const Result<int> status = played(*given);
    return status ? *status : int{fail(status.error())};
  });
}

}  // namespace quoll::cli
