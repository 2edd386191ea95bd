#include "quoll/base/tree.hpp"

namespace quoll {

const Tree* Tree::find(std::string_view key) const {
  const auto* const object = std::get_if<Object>(&value);
  if (!object) return nullptr;
  for (const auto& [name, field] : *object) {
    if (name == key) return &field;
  }
  return nullptr;
}

void TreeReader::fail(std::string reason) {
  if (good()) reason_ = std::move(reason);
}

void TreeReader::differs(const std::string& name, const std::string& expected) {
  const std::string place = path_ + (path_.empty() || name.empty() ? "" : ".") + name;
  fail((place.empty() ? "" : place + ": ") + expected);
}

void TreeReader::take_bool(bool& field) {
  if (const auto* const found = std::get_if<bool>(&at_->value)) {
    field = *found;
  } else if (const auto* const whole = std::get_if<std::int64_t>(&at_->value);
             whole && (*whole == 0 || *whole == 1)) {
    field = *whole == 1;
  } else {
    differs("", "true or false expected");
  }
}

void TreeReader::take_number(double& field) {
  if (const auto* const real = std::get_if<double>(&at_->value)) {
    field = *real;
  } else if (const auto* const single = std::get_if<float>(&at_->value)) {
    field = double{*single};
  } else if (const auto* const whole = std::get_if<std::int64_t>(&at_->value)) {
    field = static_cast<double>(*whole);
  } else {
    differs("", "a number expected");
  }
  if (good() && !std::isfinite(field)) differs("", "a finite number expected");
}

void TreeReader::take_whole(std::int64_t& field, std::int64_t low, std::int64_t high) {
  if (const auto* const whole = std::get_if<std::int64_t>(&at_->value);
      whole && *whole >= low && *whole <= high) {
    field = *whole;
  } else {
    differs("", "a whole number from " + std::to_string(low) + " to " + std::to_string(high) +
                    " expected");
  }
}

void TreeReader::take_text(std::string& field) {
  if (const auto* const text = std::get_if<std::string>(&at_->value)) {
    field = *text;
  } else {
    differs("", "a text expected");
  }
}

}  // namespace quoll
