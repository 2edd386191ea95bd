#include <gtest/gtest.h>

#include <set>

#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

TEST(Formats, EachHasItsOwnNameAndExtension) {
  std::set<std::string_view> names;
  std::set<std::string_view> extensions;
  for (const Format& format : formats()) {
    EXPECT_TRUE(names.insert(format.name).second);
    EXPECT_TRUE(extensions.insert(format.extension).second);
    EXPECT_EQ(format.extension.front(), '.');
    EXPECT_FALSE(format.summary.empty());
    EXPECT_TRUE(format.read_arrays != nullptr || format.read_with != nullptr ||
                format.write != nullptr);
    EXPECT_EQ(format.read_with != nullptr, format.parameters != nullptr);
    const auto found = format_of("folder.d/world" + std::string(format.extension));
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, &format);
  }
}

TEST(Formats, UnknownExtensionsNameTheKnownOnes) {
  const auto format = format_of("world.tolm");
  ASSERT_FALSE(format);
  const std::string text = message(format.error());
  EXPECT_TRUE(text.starts_with("world.tolm: expected a file name that ends in .toml, .csv, "))
      << text;
  EXPECT_TRUE(text.ends_with("; did you mean '.toml'?")) << text;
  for (const Format& known : formats()) {
    EXPECT_NE(text.find(known.extension), std::string::npos) << known.extension;
  }
  EXPECT_FALSE(format_of(".toml"));
  EXPECT_FALSE(format_of("world"));
}

TEST(Formats, ReadingAMissingFileNamesIt) {
  for (const char* path : {"no-such-file.toml", "no-such-file.csv", "no-such-file.txt",
                           "no-such-file.map", "no-such-file.yaml"}) {
    const auto mdp = read_model(path);
    ASSERT_FALSE(mdp) << path;
    EXPECT_EQ(mdp.error().file, path);
    EXPECT_FALSE(mdp.error().expected.empty());
  }
}

TEST(Formats, ParsingNeedsNoFile) {
  const auto mdp = parse_model("[states.A]\non = \"B\"\n[states.B]\n", "built-in.toml");
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_EQ(mdp->states(), 2u);
  const auto wrong = parse_model("[states.A]\non = \"C\"\n", "built-in.toml");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(message(wrong.error()), "built-in.toml:2:6: no state 'C'");
}

TEST(Formats, OnlySomeTakeParameters) {
  const auto mdp = parse_model("map\nSG\n", "small.txt", {{"goal", "1,0"}});
  ASSERT_FALSE(mdp);
  EXPECT_EQ(message(mdp.error()),
            "--with: a world from a .txt file takes no parameters, not 'goal'");
}

}  // namespace
}  // namespace quoll
