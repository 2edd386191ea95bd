#include "quoll/base/text.hpp"
#include "quoll/cli/faces.hpp"
#include "quoll/cli/verb.hpp"
#include "quoll/env/world.hpp"

namespace quoll::cli {
namespace {

// "a | b | c" -> "a b c": the words a flag takes; empty for numbers and files.
std::string words_of(const std::string& type) {
  std::string words;
  const auto parts = split(type, '|');
  if (parts.size() < 2) return words;
  for (const std::string_view part : parts) {
    if (part.find(' ') != std::string_view::npos) return "";
    words += (words.empty() ? "" : " ") + std::string(part);
  }
  return words;
}

std::string flags_of(const Options& options) {
  std::string flags = "--help";
  for (const Option& option : options.list()) {
    if (option.positional()) continue;
    for (const std::string_view name : split(option.names, ',')) flags += " " + std::string(name);
  }
  return flags;
}

}  // namespace

std::string bash_completion() {
  std::string verb_names, world_names, cases, values;
  for (const WorldEntry* const world : worlds()) world_names += " " + std::string(world->name);
  for (const Verb& verb : verbs()) {
    Options options;
    verb.declare(options);
    verb_names += (verb_names.empty() ? "" : " ") + std::string(verb.name);
    cases += "    " + std::string(verb.name) + ") flags=\"" + flags_of(options) + "\" ;;\n";
    for (const Option& option : options.list()) {
      const std::string words = words_of(option.type);
      if (words.empty()) continue;
      for (const std::string_view name : split(option.names, ',')) {
        values += "    " + std::string(verb.name) + ":" + std::string(name) + ") words=\"" + words +
                  "\" ;;\n";
      }
    }
  }
  return "# bash completion for quoll, made by 'quoll --completion bash'\n"
         "_quoll() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} flags= words=\n"
         "  local verb=${COMP_WORDS[1]}\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W \"" +
         verb_names +
         " --help --version\" -- \"$word\"))\n"
         "    return\n"
         "  fi\n"
         "  case $verb:$before in\n" +
         values +
         "  esac\n"
         "  case $verb in\n" +
         cases +
         "  esac\n"
         "  if [ -n \"$words\" ]; then\n"
         "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "  elif [ \"${word#-}\" != \"$word\" ]; then\n"
         "    COMPREPLY=($(compgen -W \"$flags\" -- \"$word\"))\n"
         "  else\n"
         "    COMPREPLY=($(compgen -f -W \"" +
         std::string(trim(world_names)) +
         "\" -- \"$word\"))\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _quoll quoll\n";
}

}  // namespace quoll::cli
