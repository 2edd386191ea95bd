#pragma once
// File formats of models: one file per format, one line each in the registry.

#include <span>
#include <string>
#include <string_view>

#include "quoll/model/mdp.hpp"

namespace quoll {

struct Format {
  std::string_view name;       ///< "toml"
  std::string_view extension;  ///< ".toml"
  std::string_view summary;
  /// Parses the content of a file; `path` is for messages. Nullptr = cannot be read.
  Result<Mdp> (*read)(std::string_view content, const std::string& path);
  /// The model as text that read() takes back; nullptr = cannot be written.
  Result<std::string> (*write)(const Mdp& mdp);
};

/// All formats, a hand-written constant table.
std::span<const Format> formats();

/// Reads a model file by its extension. Errors as one line (DESIGN: file:line:column).
Result<Mdp> read_model(const std::string& path);

}  // namespace quoll
