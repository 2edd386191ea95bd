// quoll <verb> <world> [options]

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/faces.hpp"
#include "quoll/cli/opponent_file.hpp"
#include "quoll/env/policy_reader.hpp"

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

std::string upper_case(std::string text) {
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return text;
}

// What a word or flag that needs one expects, from its own description.
std::string expectation(const CLI::Option& option) {
  if (option.get_positional())
    return upper_case(option.get_name()) + " expected: " + option.get_description();
  return option.get_name() + " needs a value: " + option.get_type_name();
}

// CLI11's errors as one line that says what was expected and the nearest known word.
Exit explain_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* verb = chosen_verb(app);
  const std::string place = verb ? verb->get_name() : "";
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const auto remaining = (verb ? verb : &app)->remaining();
    const std::string word = remaining.empty() ? "" : remaining.front();
    if (verb && word.rfind('-', 0) == 0) {
      return fail({place, 0, 0, "no option '" + word.substr(0, word.find('=')) + "'",
                   nearest_flag(*verb, word.substr(0, word.find('=')))});
    }
    return fail({place, 0, 0, "one word too many: '" + word + "'", ""});
  }
  if (verb && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    for (const CLI::Option* option : verb->get_options()) {
      if (option->get_required() && option->count() == 0) {
        return fail({place, 0, 0, expectation(*option), ""});
      }
    }
  }
  std::string text = error.what();
  text = text.substr(0, text.find('\n'));
  if (verb && dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    // "--seed: 1 required ... missing": the flag stands in front.
    const CLI::Option* option = verb->get_option_no_throw(text.substr(0, text.find(':')));
    if (option) {
      const bool twice = option->count() > 1;
      return fail(
          {place, 0, 0, twice ? option->get_name() + " stands twice" : expectation(*option), ""});
    }
  }
  return fail({place, 0, 0, text, ""});
}

// The first word must be a verb: said here, because a parser would complain about something else.
bool first_word_is_wrong(const std::string& word, Exit& status) {
  if (word == "-h" || word == "--help" || word == "--version") return false;
  if (!word.empty() && word.front() == '-') {
    status = fail({"", 0, 0, "a verb expected before '" + word + "'; see 'quoll --help'", ""});
    return true;
  }
  Nearest nearest(word);
  for (const Verb& verb : verbs()) {
    if (verb.name == word) return false;
    nearest.offer(verb.name);
  }
  status = fail({"", 0, 0, "no verb '" + word + "'; see 'quoll --help'", nearest.best()});
  return true;
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
        } else if constexpr (std::is_same_v<Target, unsigned*>) {
          const auto take = [target, names = option.names](const std::string& text) {
            const auto count = parse_count(text);
            if (!count || *count > 65536) {
              throw CLI::ValidationError(
                  names, "a whole number from 0 to 65536 expected, not '" + text + "'");
            }
            *target = static_cast<unsigned>(*count);
          };
          return app.add_option_function<std::string>(option.names, take, option.sentence);
        } else if constexpr (std::is_same_v<Target, std::optional<std::string>*>) {
          const auto take = [target](const std::string& text) { *target = text; };
          return app.add_option_function<std::string>(option.names, take, option.sentence);
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
  // "help VERB" is "VERB --help".
  std::vector<const char*> words(argv, argv + argc);
  if (std::string_view(words[1]) == "help") {
    words.erase(words.begin() + 1);
    words.push_back("--help");
  }
  const std::string first = words[1];
  if (first == "--man") return print(manual_page()) ? done : user_error;
  if (first == "--completion") {
    const std::string shell = argc > 2 ? argv[2] : "";
    if (shell == "bash") return print(bash_completion()) ? done : user_error;
    return fail({"--completion", 0, 0, "bash expected, not '" + shell + "'", ""});
  }
  Exit wrong = done;
  if (first_word_is_wrong(first, wrong)) return wrong;
  try {
    app.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::CallForHelp&) {
    return print(app.help()) ? done : user_error;
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
  // A file beyond the size limit is then a failed write, with its line, and not the end.
  std::signal(SIGXFSZ, SIG_IGN);
  quoll::set_policy_reader(quoll::cli::opponent_policy);
  try {
    return quoll::cli::run(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("quoll: not enough memory for this\n", stderr);
    return quoll::cli::user_error;
  } catch (const std::exception& error) {
    std::fputs((std::string("quoll: ") + error.what() + "\n").c_str(), stderr);
    return quoll::cli::user_error;
  }
}
