// quoll play WORLD: one lane of a world, step by step, by a policy, by given actions or by hand.

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "quoll/base/json_tree.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/play_actions.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/experiment/player.hpp"
#include "quoll/model/formats/fields.hpp"
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
  ActionOptions actions;
  std::optional<std::string> state, draws, record, drawing;
  std::string render;
  bool json = false;
  bool go_on = false;
};

Result<std::shared_ptr<const std::vector<double>>> read_draws(
    const std::optional<std::string>& given) {
  if (!given) return std::shared_ptr<const std::vector<double>>();
  const Result<std::string> text = text_or_file(*given);
  if (!text) return text.error();
  const Result<std::vector<std::string>> words = words_of(*text, "--draws");
  if (!words) return words.error();
  std::vector<double> draws;
  for (const std::string& word : *words) {
    const std::optional<double> draw = parse_number(word);
    if (!draw || !(*draw >= 0.0) || !std::isfinite(*draw)) {
      return Error{"--draws", 0, 0, "numbers from 0 on expected, not '" + word + "'", ""};
    }
    draws.push_back(*draw);
  }
  return std::make_shared<const std::vector<double>>(std::move(draws));
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

/// A step as learn --from-data reads it: the state it was taken in stands in front.
std::string csv_line(std::uint64_t episode, const std::string& before, const Moment& now) {
  return fmt::format("{},{},{},{},{},{},{:d},{:d}\n", episode, now.t - 1, before,
                     as_field(now.action_name), shortest(now.reward), as_field(state_text(now)),
                     now.terminated, now.truncated);
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
    if (options_.record) {
      if (now.action) log_ += csv_line(episode_, before_, now);
      before_ = as_field(state_text(now));
    }
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
  std::string log_ = "episode,t,state,action,reward,next_state,terminated,truncated\n";
  std::string before_;  ///< the state shown last, as a field
  bool printed_ = true;
};

/// Writes what --record and --drawing ask for; called before the first step too, so that a name
/// that cannot be written is told at once.
Result<void> write_files(const PlayOptions& options, const World& world, const Player& player,
                         const std::string& log) {
  const std::initializer_list<std::string> inputs = {options.world.name, options.actions.policy};
  if (options.record) {
    const Result<void> written = write_output(*options.record, log, inputs);
    if (!written) return written;
  }
  if (!options.drawing) return {};
  const Drawing drawing = player.drawing();
  if (drawing.width <= 0.0) {
    return Error{"--drawing", 0, 0,
                 "the world " + world.name + " has no picture; --render text shows its states", ""};
  }
  const Picture picture =
      drawing_svg(drawing, fmt::format("{}, step {}", world.name, player.now().t));
  return write_output(*options.drawing, picture.svg, inputs);
}

Result<void> check_forms(const PlayOptions& options) {
  if (options.drawing && !options.drawing->ends_with(".svg")) {
    return Error{"--drawing", 0, 0,
                 "a name that ends in .svg expected, not '" + *options.drawing + "'", ""};
  }
  if (!options.render.empty() && options.render != "text") {
    return Error{"--render", 0, 0,
                 "text expected, not '" + options.render + "' (a picture: --drawing FILE.svg)", ""};
  }
  return {};
}

Result<void> begin(const PlayOptions& options, const World& world, Player& player) {
  if (options.state) {
    const Result<void> done = place(player, *options.state);
    if (!done) return done;
  } else {
    player.restart();
    if (!player.draws_left()) {
      return Error{"--draws", 0, 0, "a draw in its range expected for the start", ""};
    }
  }
  if (options.render == "text" && !options.json && player.text().empty()) {
    return Error{"--render", 0, 0, "the world " + world.name + " has no text form", ""};
  }
  return {};
}

Result<int> played(const PlayOptions& options) {
  PlaySettings asked;
  if (const Result<void> applied = options.given.apply(settings_of(asked)); !applied) {
    return applied.error();
  }
  if (const Result<void> fit = check_forms(options); !fit) return fit.error();
  const Result<World> world = options.world.open(options.given);
  if (!world) return world.error();
  const auto draws = read_draws(options.draws);
  if (!draws) return draws.error();
  const Result<std::unique_ptr<Chooser>> who = chooser(options.actions, *world, asked.seed);
  if (!who) return who.error();
  Player player(*world, {1, asked.seed, asked.episode_steps, *draws},
                asked.discount > 0.0 ? asked.discount : world->discount);
  if (const Result<void> begun = begin(options, *world, player); !begun) return begun.error();
  catch_interrupts();
  Session session(options, player, **who);
  const Result<void> ready = write_files(options, *world, player, session.log());
  if (!ready) return ready.error();
  const Result<void> ran = session.run(asked.steps);
  const Result<void> written = write_files(options, *world, player, session.log());
  if (!ran) return ran.error();
  if (!written) return written.error();
  return session.printed() ? int{done} : int{user_error};
}

}  // namespace

void declare_play(Options& options) {
  auto given = std::make_shared<PlayOptions>();
  given->world.declare(options);
  given->actions.declare(options);
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
