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

/// The settings of a world with what was given.
template <class Settings>
Result<Settings> read_parameters(std::string_view world, const Parameters& given) {
  Settings settings;
  if (Result<void> done = assign_parameters(world, settings_of(settings), given); !done) {
    return done.error();
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
