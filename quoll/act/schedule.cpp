#include "quoll/act/schedule.hpp"

#include "quoll/base/text.hpp"

namespace quoll {
namespace {

std::optional<double> number_or_share(std::string_view text, double whole) {
  if (whole == 0.0 || !text.ends_with('%')) return parse_number(text);
  const auto share = parse_number(text.substr(0, text.size() - 1));
  return share ? std::optional(*share / 100.0 * whole) : std::nullopt;
}

}  // namespace

Result<Schedule> parse_schedule(std::string_view text, double low, double high,
                                std::string_view place, double whole) {
  const Error wrong{std::string(place), 0, 0,
                    "a number in [" + shortest(low) + ", " + shortest(high) +
                        (whole == 0.0 ? "]" : "], a percentage") +
                        " or FROM:TO:STEPS (such as 1:0.05:10000) expected, not '" +
                        std::string(text) + "'",
                    ""};
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() != 1 && parts.size() != 3) return wrong;
  const auto from = number_or_share(parts[0], whole);
  if (!from || !(*from >= low && *from <= high)) return wrong;
  if (parts.size() == 1) return Schedule{*from, *from, 0};
  const auto to = number_or_share(parts[1], whole);
  const auto steps = parse_count(parts[2]);
  if (!to || !(*to >= low && *to <= high) || !steps || *steps == 0) return wrong;
  return Schedule{*from, *to, *steps};
}

}  // namespace quoll
