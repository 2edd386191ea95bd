// quoll <verb> <world> [options]

#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>

#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"

namespace quoll::cli {
namespace {

// The flags an app knows, for the nearest to a misspelt one.
std::string nearest_flag(const CLI::App& app, const std::string& word) {
  Nearest nearest(word);
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) nearest.offer("--" + name);
  }
  return nearest.best();
}

const CLI::App* chosen_verb(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? nullptr : chosen.front();
}

// CLI11's errors as one line that says what was expected and the nearest known word.
Exit explain_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* verb = chosen_verb(app);
  if (const auto* extra = dynamic_cast<const CLI::ExtrasError*>(&error)) {
    static_cast<void>(extra);
    const auto remaining = (verb ? verb : &app)->remaining();
    const std::string word = remaining.empty() ? "" : remaining.front();
    if (!verb) {
      Nearest nearest(word);
      for (const Verb& one : verbs()) nearest.offer(one.name);
      return fail({"", 0, 0, "no verb '" + word + "'; see 'quoll --help'", nearest.best()});
    }
    if (word.rfind('-', 0) == 0) {
      return fail({verb->get_name(), 0, 0, "no option '" + word + "'",
                   nearest_flag(*verb, word.substr(0, word.find('=')))});
    }
    return fail({verb->get_name(), 0, 0, "one word too many: '" + word + "'", ""});
  }
  std::string text = error.what();
  text = text.substr(0, text.find('\n'));
  return fail({verb ? verb->get_name() : "", 0, 0, text, ""});
}

// Hands an option's words to where they belong.
void add_option(CLI::App& app, const Option& option) {
  CLI::Option* added = std::visit(
      [&](auto target) -> CLI::Option* {
        using Target = decltype(target);
        if constexpr (std::is_same_v<Target, std::function<void(const std::string&)>>) {
          if (option.is_switch()) {
            return app.add_flag_callback(
                option.names, [target] { target("true"); }, option.sentence);
          }
          return app.add_option_function<std::string>(option.names, target, option.sentence)
              ->trigger_on_parse();
        } else if constexpr (std::is_same_v<Target, bool*>) {
          return app.add_flag(option.names, *target, option.sentence);
        } else {
          return app.add_option(option.names, *target, option.sentence);
        }
      },
      option.target);
  if (!option.is_switch()) added->type_name(option.positional() ? "" : option.type);
  if (option.repeated) added->allow_extra_args(false);
  if (option.required) added->required();
}

int run(int argc, char** argv) {
  CLI::App app{"Quoll: Q-learning with the exact answer beside it", "quoll"};
  app.set_version_flag("--version", std::string("quoll " QUOLL_VERSION));
  app.set_help_flag("-h,--help", "this help");
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error&) { return std::string(); });
  int status = done;
  std::vector<Options> all(verbs().size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Verb& verb = verbs()[i];
    CLI::App* sub = app.add_subcommand(std::string(verb.name), std::string(verb.summary));
    sub->set_help_flag("-h,--help", "this help");
    verb.declare(all[i]);
    for (const Option& option : all[i].list()) add_option(*sub, option);
    sub->callback([&options = all[i], &status] { status = options.call(); });
  }
  if (argc < 2) {
    print(app.help());
    return user_error;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const CLI::App* verb = chosen_verb(app);
    return print((verb ? verb : &app)->help()) ? done : user_error;
  } catch (const CLI::Success& success) {
    return print(std::string(success.what()) + "\n") ? done : user_error;
  } catch (const CLI::ParseError& error) {
    return explain_parse_error(app, error);
  }
  return status;
}

}  // namespace
}  // namespace quoll::cli

int main(int argc, char** argv) {
  try {
    return quoll::cli::run(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("quoll: not enough memory for this\n", stderr);
    return quoll::cli::user_error;
  }
}
