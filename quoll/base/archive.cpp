#include "quoll/base/archive.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace quoll {
namespace {

constexpr std::size_t longest_name = 255;
// Length of the name, a name of no letters, type, count: no field is shorter.
constexpr std::size_t shortest_field = 1 + 0 + 1 + 8;

static_assert(std::endian::native == std::endian::little ||
              std::endian::native == std::endian::big);

/// Least significant byte first, from and to the order of this machine.
void order(std::byte* bytes, std::uint64_t count, std::size_t size) {
  if constexpr (std::endian::native == std::endian::big) {
    for (std::uint64_t item = 0; item < count; ++item, bytes += size) {
      std::reverse(bytes, bytes + size);
    }
  }
}

/// A name from a file, which may hold any byte, for a one-line message.
std::string printable(std::string_view name) {
  std::string result(name);
  for (char& letter : result) {
    if (letter < ' ' || letter > '~') letter = '?';
  }
  return result;
}

}  // namespace

void Archive::fail(std::string reason) {
  if (!good_) return;
  good_ = false;
  error_.expected = std::move(reason);
}

bool Archive::expect(std::string_view name, char type, std::uint64_t count) {
  const std::uint64_t found = length(name, type, 0, count);
  if (good_ && found != count) differs(name, found, count);
  return good_;
}

std::uint64_t Archive::length(std::string_view name, char type, std::size_t size,
                              std::uint64_t count) {
  if (!good_) return 0;
  name = name.substr(0, longest_name);
  if (saving_) {
    output_.push_back(static_cast<std::byte>(name.size()));
    for (const char letter : name) output_.push_back(static_cast<std::byte>(letter));
    output_.push_back(static_cast<std::byte>(type));
    for (int shift = 0; shift < 64; shift += 8) {
      output_.push_back(static_cast<std::byte>(count >> shift & 0xff));
    }
    return count;
  }

  const auto left = [&] { return input_.size() - position_; };
  const std::string wanted = "field '" + std::string(name) + "'";
  if (left() < shortest_field ||
      left() < shortest_field + static_cast<std::size_t>(input_[position_])) {
    fail(wanted + " expected, but the content ends");
    return 0;
  }
  const auto size_of_name = static_cast<std::size_t>(input_[position_++]);
  const std::string_view found_name(reinterpret_cast<const char*>(input_.data() + position_),
                                    size_of_name);
  position_ += size_of_name;
  if (found_name != name) {
    fail(wanted + " expected, not '" + printable(found_name) + "'");
    return 0;
  }
  const char found_type = static_cast<char>(input_[position_++]);
  if (found_type != type) {
    fail(wanted + " of type '" + type + "' expected, not '" + printable({&found_type, 1}) + "'");
    return 0;
  }
  std::uint64_t found = 0;
  for (int shift = 0; shift < 64; shift += 8) {
    found |= std::to_integer<std::uint64_t>(input_[position_++]) << shift;
  }
  const bool nested = type == 'v' || type == 'o';
  const std::size_t smallest = nested ? shortest_field : std::max<std::size_t>(size, 1);
  if (type != 'g' && found > left() / smallest) {
    fail(wanted + " claims " + std::to_string(found) + " values, more than the content holds");
    return 0;
  }
  return found;
}

void Archive::payload(char type, void* data, std::uint64_t count, std::size_t size) {
  if (!good_ || count == 0) return;
  const std::uint64_t total = count * size;
  auto* const bytes = static_cast<std::byte*>(data);
  if (saving_) {
    output_.insert(output_.end(), bytes, bytes + total);
    order(output_.data() + output_.size() - total, count, size);
    return;
  }
  if (input_.size() - position_ < total) {
    fail("the content ends within a value");
    return;
  }
  const auto source = input_.subspan(position_, total);
  // Any other bit pattern in a bool is undefined behaviour.
  if (type == 'b' &&
      std::any_of(source.begin(), source.end(), [](std::byte b) { return b > std::byte{1}; })) {
    fail("a truth value is 0 or 1");
    return;
  }
  std::memcpy(bytes, source.data(), total);
  order(bytes, count, size);
  position_ += total;
}

void Archive::differs(std::string_view name, std::uint64_t found, std::uint64_t expected) {
  fail("field '" + std::string(name) + "' with " + std::to_string(expected) +
       " values expected, not " + std::to_string(found));
}

}  // namespace quoll
