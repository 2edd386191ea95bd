#include "quoll/base/parameters.hpp"

#include <algorithm>

#include "quoll/base/text.hpp"

namespace quoll {

Result<void> assign_parameters(std::string_view world, std::vector<Setting> settings,
                               const Parameters& given) {
  for (const auto& [key, text] : given) {
    const Setting* const setting = find(settings, key);
    if (!setting) {
      Nearest nearest(key);
      std::string names;
      for (const Setting& known : settings) {
        nearest.offer(known.name);
        names += (names.empty() ? "" : ", ") + std::string(known.name);
      }
      return Error{"--with", 0, 0,
                   "the world " + std::string(world) +
                       (names.empty() ? " takes no parameters" : " takes " + names) + ", not '" +
                       key + "'",
                   nearest.best()};
    }
    if (Result<void> done = assign(*setting, text, "--with " + key); !done) return done.error();
  }
  return {};
}

bool gives(const Parameters& given, std::string_view name) {
  const auto letter = [](char c) { return c == '-' ? '_' : c; };
  return std::any_of(given.begin(), given.end(), [&](const auto& one) {
    return std::equal(one.first.begin(), one.first.end(), name.begin(), name.end(),
                      [&](char a, char b) { return letter(a) == letter(b); });
  });
}

std::vector<ParameterText> parameter_texts(std::vector<Setting> settings) {
  std::vector<ParameterText> texts;
  for (const Setting& setting : settings) {
    texts.push_back({std::string(setting.name), text_of(setting), range_of(setting),
                     std::string(setting.sentence)});
  }
  return texts;
}

}  // namespace quoll
