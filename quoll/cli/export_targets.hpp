#pragma once
// What `quoll export` writes: one line for each form.

#include <span>
#include <string>
#include <string_view>

#include "quoll/report/export_policy.hpp"
#include "quoll/report/network_export.hpp"

namespace quoll::cli {

struct ExportTarget {
  std::string_view name, extension;  ///< no extension: only by name
  std::string_view summary;
  Result<std::string> (*policy)(const PolicyExport& policy);  ///< nullptr = networks only
  std::string (*network)(const NetworkExport& network);       ///< nullptr = tables only
};
std::span<const ExportTarget> export_targets();

}  // namespace quoll::cli
