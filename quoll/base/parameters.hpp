#pragma once
// The parameters of a world, --with key=value: a settings struct with describe(), like all others.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quoll/base/settings.hpp"

namespace quoll {

using Parameters = std::vector<std::pair<std::string, std::string>>;

/// One parameter, for lists and help.
struct ParameterText {
  std::string name, standard, range, sentence;
};

/// Assigns the given texts to the settings. Errors name the key, its range and the nearest name.
Result<void> assign_parameters(std::string_view world, std::vector<Setting> settings,
                               const Parameters& given);
std::vector<ParameterText> parameter_texts(std::vector<Setting> settings);

/// Whether a parameter of this name ('-' and '_' are the same) is among those given.
bool gives(const Parameters& given, std::string_view name);

/// The settings of a world with what was given. A struct whose parameters depend on each other has
///   std::string_view needs(std::string_view name) const;
/// what the parameter still needs for an effect, such as "rainy=true", empty = nothing: one that is
/// given without what it needs is an error.
template <class Settings>
Result<Settings> read_parameters(std::string_view world, const Parameters& given) {
  Settings settings;
  const std::vector<Setting> list = settings_of(settings);
  if (Result<void> done = assign_parameters(world, list, given); !done) return done.error();
  if constexpr (requires { settings.needs(std::string_view()); }) {
    for (const Setting& one : list) {
      const std::string_view needed = settings.needs(one.name);
      if (!needed.empty() && gives(given, one.name)) {
        return Error{"--with " + std::string(one.name), 0, 0,
                     "has an effect only with " + std::string(needed), ""};
      }
    }
  }
  return settings;
}

/// The parameters as a registry entry lists them.
template <class Settings>
std::vector<ParameterText> parameters_of() {
  Settings settings;
  return parameter_texts(settings_of(settings));
}

}  // namespace quoll
