#include "quoll/model/name_index.hpp"

#include <cstring>
#include <limits>
#include <utility>

namespace quoll {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t longest_inside = 11;
constexpr std::uint32_t long_name = 0xff;

// `count` bytes, at most 8, as a number.
std::uint64_t load(const char* bytes, std::size_t count) {
  std::uint64_t word = 0;
  if (count == 8) {
    std::memcpy(&word, bytes, 8);
  } else if (count >= 4) {
    // Two overlapping halves: no loop, no byte beyond the name is touched.
    std::uint32_t head = 0;
    std::uint32_t tail = 0;
    std::memcpy(&head, bytes, 4);
    std::memcpy(&tail, bytes + count - 4, 4);
    word = head | (std::uint64_t{tail} << (8 * (count - 4)));
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      word |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
    }
  }
  return word;
}

}  // namespace

NameIndex::NameIndex() : slots_(64, Slot{0, 0, nobody}), offsets_{0} {}

NameIndex::Key NameIndex::key_of(std::string_view name) {
  const std::size_t size = name.size();
  if (size <= longest_inside) {
    const std::uint64_t low = load(name.data(), size < 8 ? size : 8);
    const std::uint64_t rest = size > 8 ? load(name.data() + 8, size - 8) : 0;
    return {low, static_cast<std::uint32_t>(rest | (size << 24))};
  }
  std::uint64_t hash = size;
  std::size_t at = 0;
  for (; at + 8 <= size; at += 8) hash = mix(hash ^ load(name.data() + at, 8)) + golden_gamma;
  hash = mix(hash ^ load(name.data() + at, size - at));
  const auto more = static_cast<std::uint32_t>(mix(hash + golden_gamma) >> 40);
  return {hash, (long_name << 24) | more};
}

// Returns the key because a function that only prefetches counts as one without effect for g++ 12.
NameIndex::Key NameIndex::prefetch(std::string_view name) const {
  const Key key = key_of(name);
  __builtin_prefetch(&slots_[hash(key) & (slots_.size() - 1)]);
  return key;
}

// The slot of this name, or the free one where it belongs. Linear probing; at most 3/4 are taken.
std::size_t NameIndex::place_of(Key key, std::string_view name) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t place = hash(key) & mask;
  while (true) {
    const Slot& slot = slots_[place];
    if (slot.number == nobody) return place;
    if (slot.low == key.low && slot.high == key.high &&
        (key.high >> 24 != long_name || (*this)[slot.number] == name)) {
      return place;
    }
    place = (place + 1) & mask;
  }
}

std::uint32_t NameIndex::insert(std::string_view name, Key key) {
  std::size_t place = place_of(key, name);
  if (slots_[place].number != nobody) return slots_[place].number;
  if ((std::uint64_t{size()} + 1) * 4 > slots_.size() * 3) {
    grow();
    place = place_of(key, name);
  }
  const std::uint32_t number = size();
  slots_[place] = {key.low, key.high, number};
  text_ += name;
  offsets_.push_back(text_.size());
  return number;
}

std::optional<std::uint32_t> NameIndex::find(std::string_view name) const {
  const std::uint32_t number = slots_[place_of(key_of(name), name)].number;
  if (number == nobody) return std::nullopt;
  return number;
}

void NameIndex::grow() {
  std::vector<Slot> old(slots_.size() * 2, Slot{0, 0, nobody});
  old.swap(slots_);
  const std::size_t mask = slots_.size() - 1;
  for (const Slot& slot : old) {
    if (slot.number == nobody) continue;
    std::size_t place = hash({slot.low, slot.high}) & mask;
    while (slots_[place].number != nobody) place = (place + 1) & mask;
    slots_[place] = slot;
  }
}

Names NameIndex::take(std::span<const std::uint32_t> number) {
  slots_ = std::vector<Slot>(64, Slot{0, 0, nobody});
  std::string text = std::move(text_);
  std::vector<std::uint64_t> offsets = std::move(offsets_);
  text_.clear();
  offsets_.assign(1, 0);
  if (number.empty()) {
    // Copies of the exact size: shrink_to_fit does nothing in a build without exceptions.
    std::string exact_text(text.data(), text.size());
    std::vector<std::uint64_t> exact_offsets(offsets.begin(), offsets.end());
    return Names::stored(std::move(exact_text), std::move(exact_offsets));
  }
  // Offsets in the new order come first from the lengths, then each name goes to its place.
  std::vector<std::uint64_t> placed(number.size() + 1, 0);
  for (std::size_t i = 0; i < number.size(); ++i) {
    placed[number[i] + 1] = offsets[i + 1] - offsets[i];
  }
  for (std::size_t i = 0; i < number.size(); ++i) placed[i + 1] += placed[i];
  std::string ordered(text.size(), '\0');
  for (std::size_t i = 0; i < number.size(); ++i) {
    std::memcpy(ordered.data() + placed[number[i]], text.data() + offsets[i],
                offsets[i + 1] - offsets[i]);
  }
  return Names::stored(std::move(ordered), std::move(placed));
}

}  // namespace quoll
