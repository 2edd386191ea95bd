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

}  // namespace

Result<void> check_readers(const LearnSettings& settings, const LearnerEntry& entry,
                           const Exploration& exploration) {
  LearnSettings given = settings, usual;
  const std::vector<Setting> list = settings_of(given), usual_list = settings_of(usual);
  const std::vector<Choices> choices = choices_of(settings, entry, exploration);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Setting& setting = list[i];
    if (setting.readers.empty() || text_of(setting) == text_of(usual_list[i])) continue;
    std::vector<std::string_view> readers = split(setting.readers, ',');
    for (std::string_view& reader : readers) reader = trim(reader);
    const auto asked = std::find_if(choices.begin(), choices.end(), [&](const Choices& one) {
      return one.words.empty() || has(one.words, readers.front());
    });
    const bool read = std::any_of(asked->chosen.begin(), asked->chosen.end(),
                                  [&](std::string_view word) { return has(readers, word); });
    if (read) continue;
    std::string flag = "--" + std::string(setting.name);
    std::replace(flag.begin(), flag.end(), '_', '-');
    return Error{flag, 0, 0,
                 "is for " + std::string(setting.readers) + ", but " + std::string(asked->flag) +
                     " is " + std::string(asked->chosen.front()),
                 ""};
  }
  return {};
}

}  // namespace quoll
