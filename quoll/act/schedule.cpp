#include "quoll/act/schedule.hpp"

#include "quoll/base/text.hpp"

namespace quoll {

Result<Schedule> parse_schedule(std::string_view text, double low, double high,
                                std::string_view place) {
  const Error wrong{std::string(place), 0, 0,
                    "a number in [" + shortest(low) + ", " + shortest(high) +
                        "] or FROM:TO:STEPS (such as 1:0.05:10000) expected, not '" +
                        std::string(text) + "'",
                    ""};
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() != 1 && parts.size() != 3) return wrong;
  const auto from = parse_number(parts[0]);
  if (!from || !(*from >= low && *from <= high)) return wrong;
  if (parts.size() == 1) return Schedule{*from, *from, 0};
  const auto to = parse_number(parts[1]);
  const auto steps = parse_count(parts[2]);
  if (!to || !(*to >= low && *to <= high) || !steps || *steps == 0) return wrong;
  return Schedule{*from, *to, *steps};
}

}  // namespace quoll
