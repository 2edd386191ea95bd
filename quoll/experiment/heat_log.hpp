#pragma once
// The heats of a suite, line by line in a CSV, so that a suite cut short goes on where it was.

#include <map>
#include <string>
#include <string_view>

#include "quoll/base/error.hpp"
#include "quoll/experiment/heat.hpp"

namespace quoll {

/// What a heat is a heat of; with the seed that is all it depends on.
struct HeatPlace {
  std::string command;  ///< the world with its parameters, as typed
  RaceMode mode = RaceMode::start;
  std::uint64_t cap_steps = 0;
  double cap_seconds = 0.0;
};

/// A file of lines `world,mode,entrant,seed,cap_steps,cap_seconds,end,steps,seconds,bytes`. No
/// field holds a comma.
class HeatLog {
 public:
  /// Reads what is there; a last line that was cut is dropped, and run again. Error: a file that is
  /// something else, with its line.
  static Result<HeatLog> open(const std::string& path);

  /// The heat of these settings (EntrantResult::settings), or nullptr. Valid until the next add().
  const Heat* find(const HeatPlace& place, std::string_view settings, std::uint64_t seed) const;
  /// Remembers a heat, and writes its line at once.
  Result<void> add(const HeatPlace& place, std::string_view settings, const Heat& heat);

 private:
  std::string path_;
  std::map<std::string, Heat> heats_;
};

}  // namespace quoll
