#include "quoll/env/policy_reader.hpp"

#include "quoll/base/file.hpp"

namespace quoll {
namespace {

PolicyReader reader_in_use = nullptr;

}  // namespace

void set_policy_reader(PolicyReader reader) {
  reader_in_use = reader;
}

bool names_a_policy(std::string_view text) {
  return text.ends_with(".csv") || text.ends_with(".json") || text.ends_with(".quoll");
}

Result<SavedPolicy> read_saved_policy(const std::string& path, std::string_view world,
                                      const Parameters& parameters) {
  if (path.ends_with(".csv")) {
    Result<std::string> rows = read_file(path);
    if (!rows) return rows.error();
    return SavedPolicy{std::move(*rows), {}};
  }
  if (reader_in_use != nullptr) return reader_in_use(path, world, parameters);
  return Error{path, 0, 0, "a file .csv expected: this program reads no other policies", ""};
}

}  // namespace quoll
