#pragma once
// What every picture promises.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "quoll/report/svg.hpp"

namespace quoll::testing {

/// Names what is wrong with the tags of an XML text, or "".
inline std::string xml_fault(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t i = text.find('<'); i != std::string::npos; i = text.find('<', i + 1)) {
    const std::size_t end = text.find('>', i);
    if (end == std::string::npos) return "a tag does not end";
    const std::string tag = text.substr(i + 1, end - i - 1);
    if (tag.find('<') != std::string::npos) return "< inside " + tag;
    std::size_t quotes = 0;
    for (const char c : tag) quotes += c == '"';
    if (quotes % 2 != 0) return "odd quotation marks in " + tag;
    const std::string name =
        tag.substr(tag[0] == '/', tag.find_first_of(" /", 1) - (tag[0] == '/'));
    if (tag[0] == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return "unexpected end of " + tag;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
  }
  return open.empty() ? "" : "never closed: " + open.back();
}

/// No two labels overlap, all lie inside, no number is missing, the text is well-formed.
inline void expect_sound(const Picture& picture) {
  const Box canvas{0, 0, picture.width, picture.height};
  for (std::size_t i = 0; i < picture.labels.size(); ++i) {
    const SvgLabel& label = picture.labels[i];
    EXPECT_TRUE(canvas.contains(label.box)) << label.text;
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(label.box.overlaps(picture.labels[j].box))
          << label.text << " and " << picture.labels[j].text;
    }
  }
  EXPECT_EQ(xml_fault(picture.svg), "");
  EXPECT_EQ(picture.svg.find("nan"), std::string::npos);
  EXPECT_EQ(picture.svg.find("inf"), std::string::npos);
}

}  // namespace quoll::testing
