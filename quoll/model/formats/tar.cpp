#include "quoll/model/formats/tar.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "quoll/base/text.hpp"

namespace quoll {
namespace {

constexpr std::size_t block = 512;
constexpr std::size_t longest_name = 4096;

// Fields of a head: first byte and length.
constexpr std::pair<std::size_t, std::size_t> name_at{0, 100}, size_at{124, 12},
    checksum_at{148, 8}, kind_at{156, 1}, magic_at{257, 5}, prefix_at{345, 155};

std::string_view field(std::string_view head, std::pair<std::size_t, std::size_t> place) {
  return head.substr(place.first, place.second);
}

std::string_view text(std::string_view head, std::pair<std::size_t, std::size_t> place) {
  const std::string_view all = field(head, place);
  return all.substr(0, all.find('\0'));
}

unsigned char byte(char letter) {
  return static_cast<unsigned char>(letter);
}

// Octal digits between blanks or zero bytes; or, with the top bit set, a big-endian number.
std::optional<std::uint64_t> number(std::string_view digits) {
  std::uint64_t value = 0;
  if (byte(digits.front()) == 0x80) {
    for (const char letter : digits.substr(1)) {
      if (value >> 55 != 0) return std::nullopt;
      value = value << 8 | byte(letter);
    }
    return value;
  }
  const std::string_view octal = trim(digits.substr(0, digits.find('\0')));
  if (octal.empty() || octal.size() > 21) return std::nullopt;
  for (const char letter : octal) {
    if (letter < '0' || letter > '7') return std::nullopt;
    value = value * 8 + static_cast<std::uint64_t>(letter - '0');
  }
  return value;
}

// The sum of a head's bytes, those of the sum itself counted as blanks.
std::uint64_t checksum(std::string_view head) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < block; ++i) {
    const bool own = i >= checksum_at.first && i < checksum_at.first + checksum_at.second;
    sum += own ? ' ' : byte(head[i]);
  }
  return sum;
}

// "30 path=annotations/...\n": the value of one key of a pax header.
std::optional<std::string_view> pax_value(std::string_view records, std::string_view key) {
  std::optional<std::string_view> found;
  while (!records.empty()) {
    const std::size_t blank = records.find(' ');
    if (blank == std::string_view::npos) return found;
    const auto length = parse_count(records.substr(0, blank));
    if (!length || *length <= blank + 1 || *length > records.size()) return found;
    const std::string_view record = records.substr(blank + 1, *length - blank - 2);
    if (record.substr(0, key.size()) == key && record.substr(key.size()).starts_with('=')) {
      found = record.substr(key.size() + 1);
    }
    records.remove_prefix(*length);
  }
  return found;
}

std::string plain_name(std::string_view name) {
  while (name.starts_with("./")) name.remove_prefix(2);
  while (name.starts_with('/')) name.remove_prefix(1);
  return std::string(name);
}

Error damaged(std::size_t at, const char* what) {
  return Error{"", 0, 0, "tar archive: " + std::string(what) + " at byte " + std::to_string(at),
               ""};
}

void put_octal(std::string& head, std::pair<std::size_t, std::size_t> place, std::uint64_t value) {
  for (std::size_t i = place.second - 1; i-- > 0; value /= 8) {
    head[place.first + i] = static_cast<char>('0' + value % 8);
  }
}

}  // namespace

Result<std::vector<TarEntry>> tar_entries(std::string_view archive) {
  std::vector<TarEntry> entries;
  std::string long_name;                  // of the next file, told by an entry before it
  std::optional<std::uint64_t> pax_size;  // likewise
  std::size_t at = 0;
  while (at < archive.size()) {
    if (archive.size() - at < block) return damaged(at, "cut");
    const std::string_view head = archive.substr(at, block);
    if (std::all_of(head.begin(), head.end(), [](char letter) { return letter == 0; })) break;
    const auto sum = number(field(head, checksum_at));
    if (!sum || *sum != checksum(head)) return damaged(at, "a file's head expected");
    const char kind = head[kind_at.first];
    const bool regular = kind == '0' || kind == '\0';
    auto size = number(field(head, size_at));
    if (regular && pax_size) size = pax_size;
    at += block;
    if (!size) return damaged(at, "a size expected before the content");
    if (*size > archive.size() - at) return damaged(at, "cut: a longer content promised");
    const std::string_view content = archive.substr(at, *size);
    at += std::min<std::size_t>(*size + tar_padding(*size), archive.size() - at);
    if (kind == 'x' || kind == 'L') {
      const auto name =
          kind == 'L' ? content.substr(0, content.find('\0')) : pax_value(content, "path");
      if (name) long_name = name->substr(0, longest_name);
      if (kind == 'x') {
        const auto digits = pax_value(content, "size");
        pax_size = digits ? parse_count(*digits) : std::nullopt;
      }
      continue;
    }
    if (regular) {
      std::string name(text(head, name_at));
      const std::string_view prefix = text(head, prefix_at);
      if (field(head, magic_at) == "ustar" && head[magic_at.first + 5] == 0 && !prefix.empty()) {
        name = std::string(prefix) + "/" + name;
      }
      entries.push_back({plain_name(long_name.empty() ? name : long_name), content});
    }
    long_name.clear();
    pax_size.reset();
  }
  return entries;
}

std::string tar_head(std::string_view name, std::uint64_t size) {
  std::string head(block, '\0');
  head.replace(name_at.first, name.size(), name);
  put_octal(head, {100, 8}, 0644);  // permissions
  put_octal(head, {108, 8}, 0);     // owner, group, time: the same file for everybody
  put_octal(head, {116, 8}, 0);
  put_octal(head, {136, 12}, 0);
  if (size >> 33 == 0) {
    put_octal(head, size_at, size);
  } else {
    head[size_at.first] = static_cast<char>(0x80);
    for (std::size_t i = 0; i < 8; ++i) {
      head[size_at.first + 11 - i] = static_cast<char>(size >> 8 * i & 0xff);
    }
  }
  head[kind_at.first] = '0';
  head.replace(magic_at.first, 8,
               std::string_view("ustar\0"
                                "00",
                                8));
  put_octal(head, {checksum_at.first, 7}, checksum(head));
  head[checksum_at.first + 7] = ' ';
  return head;
}

std::uint64_t tar_padding(std::uint64_t size) {
  return (block - size % block) % block;
}

std::string tar_end() {
  return std::string(2 * block, '\0');
}

}  // namespace quoll
