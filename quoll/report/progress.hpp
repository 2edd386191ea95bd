#pragma once
// The progress of a long run as one line; printing it is the caller's.

#include <cstdint>
#include <string>
#include <string_view>

namespace quoll {

struct Progress {
  std::uint64_t done = 0;
  std::uint64_t total = 0;    ///< 0 = not known: no bar, no ETA
  double seconds = 0;         ///< since the start
  std::string_view extra{};   ///< e.g. "return 0.93"
  std::uint64_t resumed = 0;  ///< part of `done` that was done before this clock started
  std::string_view unit = "steps";
};

/// "\r" and a bar with share, rate and ETA, exactly `width` - 1 columns wide so that it covers the
/// line before it.
std::string progress_bar(const Progress& progress, std::uint32_t width, bool unicode = true);

/// The same as one plain line for a pipe, with "\n".
std::string progress_line(const Progress& progress);

/// "0.3 s", "12 s", "3 min 20 s", "2 h 5 min", "4 d 3 h".
std::string duration_text(double seconds);

/// "950", "12.3 k", "4.56 M", "1.2 G".
std::string scaled_text(double count);

}  // namespace quoll
