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
    EXPECT_TRUE(format.read_arrays != nullptr || format.write != nullptr);
    const auto found = format_of("folder.d/world" + std::string(format.extension));
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, &format);
  }
}

TEST(Formats, UnknownExtensionsNameTheKnownOnes) {
  const auto format = format_of("world.tolm");
  ASSERT_FALSE(format);
  EXPECT_EQ(message(format.error()),
            "world.tolm: expected a file name that ends in .toml, .csv or .txt; "
            "did you mean '.toml'?");
  EXPECT_FALSE(format_of(".toml"));
  EXPECT_FALSE(format_of("world"));
}

TEST(Formats, ReadingAMissingFileNamesIt) {
  for (const char* path : {"no-such-file.toml", "no-such-file.csv", "no-such-file.txt"}) {
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

}  // namespace
}  // namespace quoll
