#include "quoll/learn/readers.hpp"

#include <algorithm>

#include "quoll/base/text.hpp"
#include "quoll/nn/optimiser.hpp"

namespace quoll {
namespace {

constexpr std::string_view priorities[] = {"prioritised"};

// What readers may be named, and which of them was chosen.
struct Choices {
  std::string_view flag;
  std::span<const std::string_view> words;  // empty = the rest
  std::vector<std::string_view> chosen;     // the first as it is told
};

bool has(std::span<const std::string_view> words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::vector<Choices> choices_of(const LearnSettings& settings, const LearnerEntry& entry,
                                const Exploration& exploration) {
  const DeepSettings& deep = settings.deep;
  Choices optimiser{"--optimiser", nn::optimiser_names, {deep.optimiser}};
  if (entry.traits.optimiser.empty()) {
    optimiser.flag = "--method";
    optimiser.chosen = {entry.method};
  } else if (deep.optimiser == "auto") {
    optimiser.chosen = {entry.traits.optimiser};
  }
  const std::string_view keeps = entry.traits.networks       ? "networks"
                                 : entry.traits.approximates ? "linear"
                                                             : "tables";
  return {{"--explore", exploration_names, {exploration.name()}},
          {"--rule", rule_names, {settings.rule}},
          {"--returns", returns_names, {returns_names[static_cast<std::size_t>(deep.returns)]}},
          {"--prioritised", priorities, {deep.prioritised ? "prioritised" : "off"}},
          std::move(optimiser),
          {"--method", {}, {entry.method, keeps}}};
}

// A list of words with `between` between them.
std::vector<std::string_view> words_of(std::string_view list, std::string_view between) {
  std::vector<std::string_view> words;
  for (;;) {
    const std::size_t end = list.find(between);
    words.push_back(trim(list.substr(0, end)));
    if (end == std::string_view::npos) return words;
    list.remove_prefix(end + between.size());
  }
}

std::string flag_of(const Setting& setting) {
  std::string flag = "--" + std::string(setting.name);
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

// Of one list of readers, one must be chosen.
Result<void> check_list(const Setting& setting, std::string_view list,
                        const std::vector<Choices>& choices) {
  const std::vector<std::string_view> readers = words_of(list, ",");
  const auto asked = std::find_if(choices.begin(), choices.end(), [&](const Choices& one) {
    return one.words.empty() || has(one.words, readers.front());
  });
  const bool read = std::any_of(asked->chosen.begin(), asked->chosen.end(),
                                [&](std::string_view word) { return has(readers, word); });
  if (read) return {};
  return Error{flag_of(setting), 0, 0,
               "is for " + std::string(list) + ", but " + std::string(asked->flag) + " is " +
                   std::string(asked->chosen.front()),
               ""};
}

}  // namespace

bool ignores(const LearnerEntry& entry, std::string_view setting) {
  return has(words_of(entry.traits.ignores, ","), setting);
}

Result<void> check_readers(const LearnSettings& settings, const LearnerEntry& entry,
                           const Exploration& exploration) {
  LearnSettings given = settings, usual;
  const std::vector<Setting> list = settings_of(given), usual_list = settings_of(usual);
  const std::vector<Choices> choices = choices_of(settings, entry, exploration);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Setting& setting = list[i];
    if (text_of(setting) == text_of(usual_list[i])) continue;
    if (ignores(entry, setting.name)) {
      return Error{flag_of(setting), 0, 0,
                   (entry.rule.empty() ? "--method " + std::string(entry.method)
                                       : "--rule " + std::string(entry.rule)) +
                       " does not read it",
                   ""};
    }
    if (setting.readers.empty()) continue;
    for (const std::string_view readers : words_of(setting.readers, " with ")) {
      const Result<void> read = check_list(setting, readers, choices);
      if (!read) return read;
    }
  }
  return {};
}

}  // namespace quoll
