#include "quoll/model/names.hpp"

#include <utility>

#include "quoll/base/text.hpp"

namespace quoll {

namespace {

constexpr std::uint64_t most_names_compared = 100'000;

// The decimal number at the front of `text`, which is moved behind it; no sign, no leading zeros,
// so that each number has one name.
std::optional<std::uint64_t> take_number(std::string_view& text) {
  std::uint64_t value = 0;
  std::size_t digits = 0;
  while (digits < text.size() && text[digits] >= '0' && text[digits] <= '9') {
    if (digits == 18) return std::nullopt;
    value = value * 10 + static_cast<std::uint64_t>(text[digits] - '0');
    ++digits;
  }
  if (digits == 0 || (digits > 1 && text[0] == '0')) return std::nullopt;
  text.remove_prefix(digits);
  return value;
}

}  // namespace

Names Names::numbered(std::string prefix, std::uint64_t count) {
  Names names;
  names.kind_ = Kind::numbered;
  names.text_ = std::move(prefix);
  names.count_ = count;
  return names;
}

Names Names::cells(std::uint32_t columns, std::vector<std::uint32_t> cells) {
  Names names;
  names.kind_ = Kind::cells;
  names.columns_ = columns;
  names.cells_ = std::move(cells);
  return names;
}

Names Names::stored(std::string text, std::vector<std::uint64_t> offsets) {
  Names names;
  names.text_ = std::move(text);
  names.offsets_ = std::move(offsets);
  return names;
}

std::uint64_t Names::size() const {
  switch (kind_) {
    case Kind::numbered:
      return count_;
    case Kind::cells:
      return cells_.size();
    case Kind::stored:
      break;
  }
  return offsets_.empty() ? 0 : offsets_.size() - 1;
}

std::string Names::operator[](std::uint64_t index) const {
  switch (kind_) {
    case Kind::numbered:
      return text_ + std::to_string(index);
    case Kind::cells:
      return "r" + std::to_string(cells_[index] / columns_) + "c" +
             std::to_string(cells_[index] % columns_);
    case Kind::stored:
      break;
  }
  return text_.substr(offsets_[index], offsets_[index + 1] - offsets_[index]);
}

std::optional<std::uint64_t> Names::find(std::string_view name) const {
  if (kind_ == Kind::numbered) {
    if (name.substr(0, text_.size()) != text_) return std::nullopt;
    name.remove_prefix(text_.size());
    const auto index = take_number(name);
    if (!index || !name.empty() || *index >= count_) return std::nullopt;
    return index;
  }
  if (kind_ == Kind::cells) {
    if (name.empty() || name.front() != 'r') return std::nullopt;
    name.remove_prefix(1);
    const auto row = take_number(name);
    if (!row || name.empty() || name.front() != 'c') return std::nullopt;
    name.remove_prefix(1);
    const auto column = take_number(name);
    if (!column || !name.empty() || *column >= columns_ || *row > UINT32_MAX) return std::nullopt;
    const std::uint64_t cell = *row * columns_ + *column;
    for (std::uint64_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i] == cell) return i;
    }
    return std::nullopt;
  }
  const std::string_view text = text_;
  for (std::uint64_t i = 0; i + 1 < offsets_.size(); ++i) {
    if (offsets_[i + 1] - offsets_[i] == name.size() &&
        text.substr(offsets_[i], name.size()) == name) {
      return i;
    }
  }
  return std::nullopt;
}

std::string Names::nearest(std::string_view name) const {
  if (size() > most_names_compared) return "";
  Nearest search(name);
  for (std::uint64_t i = 0; i < size(); ++i) search.offer((*this)[i]);
  return search.best();
}

void Names::push_back(std::string_view name) {
  if (offsets_.empty()) offsets_.push_back(0);
  text_ += name;
  offsets_.push_back(text_.size());
}

std::uint64_t Names::bytes() const {
  return text_.capacity() + offsets_.capacity() * sizeof(std::uint64_t) +
         cells_.capacity() * sizeof(std::uint32_t);
}

}  // namespace quoll
