#include "quoll/model/formats/tar.hpp"

#include <gtest/gtest.h>

#include <string>

namespace quoll {
namespace {

std::string entry(const std::string& name, const std::string& content) {
  return tar_head(name, content.size()) + content + std::string(tar_padding(content.size()), '\0');
}

// Makes the checksum right again after a change of the head.
std::string sealed(std::string head) {
  head.replace(148, 8, 8, ' ');
  unsigned sum = 0;
  for (int i = 0; i < 512; ++i)
    sum += static_cast<unsigned char>(head[static_cast<std::size_t>(i)]);
  char digits[8];
  std::snprintf(digits, sizeof digits, "%06o", sum);
  head.replace(148, 7, std::string(digits, 7));
  return head;
}

std::string of_kind(char kind, const std::string& content) {
  std::string whole = entry("@", content);
  std::string head = whole.substr(0, 512);
  head[156] = kind;
  return sealed(head) + whole.substr(512);
}

TEST(Tar, ReadsWhatItWrites) {
  const std::string text(513, 'x');
  const std::string archive = entry("a/b.bin", text) + entry("./empty", "") + tar_end();
  EXPECT_EQ(archive.size(), 512u + 1024u + 512u + 1024u);
  const auto entries = tar_entries(archive);
  ASSERT_TRUE(entries);
  ASSERT_EQ(entries->size(), 2u);
  EXPECT_EQ((*entries)[0].name, "a/b.bin");
  EXPECT_EQ((*entries)[0].content, text);
  EXPECT_EQ((*entries)[1].name, "empty");
  EXPECT_EQ((*entries)[1].content, "");
}

TEST(Tar, LongNamesOfBothKinds) {
  const std::string name(150, 'n');
  const std::string archive = of_kind('L', name + '\0') + entry("short", "one") +
                              of_kind('x', "13 path=a/bc\n") + entry("short", "two") +
                              of_kind('5', "") + entry("short", "three");
  const auto entries = tar_entries(archive);
  ASSERT_TRUE(entries) << entries.error().expected;
  ASSERT_EQ(entries->size(), 3u);
  EXPECT_EQ((*entries)[0].name, name);
  EXPECT_EQ((*entries)[1].name, "a/bc");
  EXPECT_EQ((*entries)[1].content, "two");
  EXPECT_EQ((*entries)[2].name, "short");
}

TEST(Tar, DamageIsPlaced) {
  const std::string archive = entry("a", "content");
  const auto error = [](const std::string& bytes) {
    const auto entries = tar_entries(bytes);
    return entries ? std::string() : entries.error().expected;
  };
  EXPECT_EQ(error(archive.substr(0, 300)), "tar archive: cut at byte 0");
  EXPECT_EQ(error(archive.substr(0, 515)),
            "tar archive: cut: a longer content promised at byte 512");
  std::string altered = archive;
  altered[3] = 'b';
  EXPECT_EQ(error(altered), "tar archive: a file's head expected at byte 0");
  // 2^62 bytes promised, as GNU tar writes large sizes.
  std::string huge = archive;
  huge.replace(124, 12, std::string("\x80\0\0\0\x40\0\0\0\0\0\0\0", 12));
  EXPECT_EQ(error(sealed(huge)), "tar archive: cut: a longer content promised at byte 512");
  EXPECT_EQ(error(""), "");
}

}  // namespace
}  // namespace quoll
