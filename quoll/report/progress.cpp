#include "quoll/report/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "quoll/base/utf8.hpp"

namespace quoll {

namespace {

/// Units per second of this clock, or 0 before anything can be said.
double rate(const Progress& p) {
  const std::uint64_t fresh = p.done - std::min(p.done, p.resumed);
  return p.seconds > 0 ? static_cast<double>(fresh) / p.seconds : 0;
}

std::string eta(const Progress& p) {
  const double speed = rate(p);
  if (p.total == 0 || speed <= 0 || p.done >= p.total) return "";
  return "ETA " + duration_text(static_cast<double>(p.total - p.done) / speed);
}

std::string counts(const Progress& p) {
  const std::string done = scaled_text(static_cast<double>(p.done));
  if (p.total == 0) return fmt::format("{} {}", done, p.unit);
  return fmt::format("{}/{} {}", done, scaled_text(static_cast<double>(p.total)), p.unit);
}

std::string facts(const Progress& p) {
  std::string text = counts(p);
  if (rate(p) > 0) text += fmt::format("  {} {}/s", scaled_text(rate(p)), p.unit);
  if (const std::string left = eta(p); !left.empty()) text += "  " + left;
  if (!p.extra.empty()) text += fmt::format("  {}", p.extra);
  return text;
}

double share_done(const Progress& p) {
  if (p.total == 0) return 0;
  return std::min(1.0, static_cast<double>(p.done) / static_cast<double>(p.total));
}

/// A bar `columns` wide; Unicode fills the last letter by eighths.
std::string bar(double share, std::size_t columns, bool unicode) {
  static constexpr std::array<std::string_view, 8> eighths{"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  const auto ticks = static_cast<std::size_t>(share * static_cast<double>(columns) * 8);
  std::string out;
  std::size_t used = ticks / 8;
  for (std::size_t i = 0; i < used; ++i) out += unicode ? "█" : "#";
  if (unicode && ticks % 8 != 0) {
    out += eighths[ticks % 8];
    ++used;
  }
  for (; used < columns; ++used) out += unicode ? "░" : "-";
  return out;
}

}  // namespace

std::string duration_text(double seconds) {
  if (!(seconds < 1e9)) return "very long";
  if (seconds < 9.95) return fmt::format("{:.1f} s", std::max(0.0, seconds));
  const auto whole = static_cast<std::uint64_t>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  if (whole < 86400) return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
  return fmt::format("{} d {} h", whole / 86400, whole % 86400 / 3600);
}

std::string scaled_text(double count) {
  static constexpr std::array<std::string_view, 5> units{"", " k", " M", " G", " T"};
  std::size_t unit = 0;
  // 999.5 would print as 1000, so the next unit begins there.
  while (count >= 999.5 && unit + 1 < units.size()) {
    count /= 1000;
    ++unit;
  }
  if (count == std::floor(count) && count < 1000)
    return fmt::format("{:.0f}{}", count, units[unit]);
  return fmt::format("{:.3g}{}", count, units[unit]);
}

std::string progress_bar(const Progress& p, std::uint32_t width, bool unicode) {
  const std::string text = facts(p);
  std::string line;
  if (p.total > 0) {
    const double share = share_done(p);
    const std::string percent = fmt::format(" {:3.0f} %  ", std::floor(share * 100));
    const std::size_t needed = display_width(percent) + display_width(text);
    const std::size_t room = needed + 1 < width ? width - needed - 1 : 0;
    if (room >= 8) line = bar(share, std::min<std::size_t>(room, 30), unicode);
    line += percent;
  }
  // The last column stays free: many terminals wrap when it is written.
  const std::size_t columns = width > 0 ? width - 1 : 0;
  line = fit_width(line + text, columns, unicode ? "…" : "");
  line.append(columns - std::min(columns, display_width(line)), ' ');
  return "\r" + line;
}

std::string progress_line(const Progress& p) {
  if (p.total == 0) return facts(p) + "\n";
  return fmt::format("{:.0f} %  {}\n", std::floor(share_done(p) * 100), facts(p));
}

}  // namespace quoll
