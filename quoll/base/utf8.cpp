#include "quoll/base/utf8.hpp"

#include <array>

namespace quoll {

namespace {

constexpr char32_t replacement = 0xFFFD;

unsigned char byte(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// Length of the sequence a first byte announces, and the range its second byte must lie in.
struct Lead {
  std::size_t length;
  unsigned char low, high;
};

Lead lead(unsigned char first) {
  if (first >= 0xC2 && first <= 0xDF) return {2, 0x80, 0xBF};
  if (first == 0xE0) return {3, 0xA0, 0xBF};
  if (first == 0xED) return {3, 0x80, 0x9F};
  if (first >= 0xE1 && first <= 0xEF) return {3, 0x80, 0xBF};
  if (first == 0xF0) return {4, 0x90, 0xBF};
  if (first >= 0xF1 && first <= 0xF3) return {4, 0x80, 0xBF};
  if (first == 0xF4) return {4, 0x80, 0x8F};
  return {0, 0, 0};
}

struct Range {
  char32_t first, last;
};

// Blocks of combining marks and of wide characters; Unicode 15 EastAsianWidth.txt, in whole blocks.
constexpr std::array<Range, 9> zero_wide{{{0x300, 0x36F},
                                          {0x483, 0x489},
                                          {0x591, 0x5BD},
                                          {0x1AB0, 0x1AFF},
                                          {0x1DC0, 0x1DFF},
                                          {0x200B, 0x200F},
                                          {0x20D0, 0x20FF},
                                          {0xFE00, 0xFE0F},
                                          {0xFE20, 0xFE2F}}};
constexpr std::array<Range, 12> double_wide{{{0x1100, 0x115F},
                                             {0x2E80, 0x303E},
                                             {0x3041, 0x33FF},
                                             {0x3400, 0x4DBF},
                                             {0x4E00, 0x9FFF},
                                             {0xA000, 0xA4CF},
                                             {0xAC00, 0xD7A3},
                                             {0xF900, 0xFAFF},
                                             {0xFE30, 0xFE6F},
                                             {0xFF00, 0xFF60},
                                             {0x1F300, 0x1FAFF},
                                             {0x20000, 0x3FFFD}}};

template <std::size_t N>
bool within(const std::array<Range, N>& ranges, char32_t c) {
  for (const Range& range : ranges) {
    if (c >= range.first && c <= range.last) return true;
  }
  return false;
}

std::size_t columns(char32_t c) {
  if (c < 0x20 || (c >= 0x7F && c < 0xA0)) return 0;
  if (c < 0x300) return 1;
  if (within(zero_wide, c)) return 0;
  return within(double_wide, c) ? 2 : 1;
}

/// Bytes of the escape sequence "ESC [ ... letter" that `text` begins with, or 0.
std::size_t escape_length(std::string_view text) {
  if (text.size() < 2 || text[0] != '\x1b' || text[1] != '[') return 0;
  std::size_t i = 2;
  while (i < text.size() && !(text[i] >= '@' && text[i] <= '~')) ++i;
  return i < text.size() ? i + 1 : text.size();
}

}  // namespace

CodePoint decode(std::string_view text) {
  const unsigned char first = byte(text, 0);
  if (first < 0x80) return {first, 1, true};
  const Lead expected = lead(first);
  if (expected.length == 0) return {replacement, 1, false};
  char32_t value = first & (0x7FU >> expected.length);
  for (std::size_t i = 1; i < expected.length; ++i) {
    const unsigned char low = i == 1 ? expected.low : 0x80;
    const unsigned char high = i == 1 ? expected.high : 0xBF;
    if (i >= text.size() || byte(text, i) < low || byte(text, i) > high) {
      return {replacement, i, false};
    }
    value = (value << 6) | (byte(text, i) & 0x3FU);
  }
  return {value, expected.length, true};
}

void encode(char32_t value, std::string& out) {
  const auto put = [&](char32_t bits) { out += static_cast<char>(bits); };
  if (value < 0x80) {
    put(value);
  } else if (value < 0x800) {
    put(0xC0 | (value >> 6));
    put(0x80 | (value & 0x3F));
  } else if (value < 0x10000) {
    put(0xE0 | (value >> 12));
    put(0x80 | ((value >> 6) & 0x3F));
    put(0x80 | (value & 0x3F));
  } else {
    put(0xF0 | (value >> 18));
    put(0x80 | ((value >> 12) & 0x3F));
    put(0x80 | ((value >> 6) & 0x3F));
    put(0x80 | (value & 0x3F));
  }
}

std::string valid_utf8(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const CodePoint point = decode(text);
    if (point.valid) {
      out += text.substr(0, point.length);
    } else {
      encode(replacement, out);
    }
    text.remove_prefix(point.length);
  }
  return out;
}

std::size_t display_width(std::string_view text) {
  std::size_t width = 0;
  while (!text.empty()) {
    if (const std::size_t escape = escape_length(text)) {
      text.remove_prefix(escape);
      continue;
    }
    const CodePoint point = decode(text);
    width += columns(point.value);
    text.remove_prefix(point.length);
  }
  return width;
}

std::string fit_width(std::string_view text, std::size_t room, std::string_view mark) {
  if (display_width(text) <= room) return std::string(text);
  const std::size_t mark_width = display_width(mark);
  if (mark_width > room) return fit_width(text, room, "");
  std::string out;
  std::size_t width = mark_width;
  while (!text.empty()) {
    const std::size_t escape = escape_length(text);
    const CodePoint point = decode(text);
    const std::size_t wide = escape ? 0 : columns(point.value);
    if (width + wide > room) break;
    width += wide;
    out += text.substr(0, escape ? escape : point.length);
    text.remove_prefix(escape ? escape : point.length);
  }
  return out.append(mark);
}

}  // namespace quoll
