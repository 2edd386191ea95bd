#include "quoll/learn/step_size.hpp"

#include "quoll/base/math.hpp"
#include "quoll/base/text.hpp"

namespace quoll {

void StepSize::prepare() {
  if (kind != Kind::power) return;
  std::vector<double> powers(4096);
  for (std::uint32_t n = 1; n < powers.size(); ++n) powers[n] = power(n);
  powers_ = std::make_shared<const std::vector<double>>(std::move(powers));
}

double StepSize::power(std::uint32_t n) const {
  if (value == 1.0) return 1.0 / static_cast<double>(n);
  return math::pow(static_cast<double>(n), -value);
}

std::string StepSize::text() const {
  switch (kind) {
    case Kind::power:
      return "1/N^" + shortest(value);
    case Kind::rescaled_linear:
      return "rescaled-linear";
    case Kind::constant:
      break;
  }
  return shortest(value);
}

Result<StepSize> parse_step_size(std::string_view text, bool deterministic, double discount) {
  StepSize step;
  const std::string_view word = trim(text);
  if (word == "auto" && deterministic) return step;
  if (word == "auto" || word == "rescaled-linear") {
    step.kind = StepSize::Kind::rescaled_linear;
    step.value = horizon(discount);
    return step;
  }
  if (word == "1/N" || word.substr(0, 4) == "1/N^") {
    const auto w = word == "1/N" ? 1.0 : parse_number(word.substr(4));
    if (w && *w > 0.5 && *w <= 1.0) {
      step.kind = StepSize::Kind::power;
      step.value = *w;
      step.prepare();
      return step;
    }
  } else if (const auto number = parse_number(word); number && *number > 0.0 && *number <= 1.0) {
    step.value = *number;
    return step;
  }
  return Error{
      "--step-size", 0, 0,
      "auto, a number in (0, 1], 1/N^w with w in (0.5, 1] or rescaled-linear expected, not '" +
          std::string(text) + "'",
      ""};
}

}  // namespace quoll
