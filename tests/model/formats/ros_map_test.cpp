#include "quoll/model/formats/ros_map.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "../../refusal.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

// 4 x 3: white ground, a black cell, a gray one of unknown occupancy (level 205).
constexpr std::string_view image =
    "P2\n# a comment\n4 3\n255\n"
    "254 254 0 254\n"
    "254 254 254 205\n"
    "254 0 254 254\n";
constexpr std::string_view yaml =
    "image: lab.pgm\nresolution: 0.5\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

std::string picture(const TerrainMap& map) {
  std::string text;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    text += map.cells[i] == Terrain::ground ? '.' : '#';
    if ((i + 1) % map.columns == 0) text += '\n';
  }
  return text;
}

TerrainMap terrain(std::string_view pixels, const RosMap& map, bool cross_unknown = false) {
  const auto parsed = parse_pgm(pixels, "lab.pgm");
  EXPECT_TRUE(parsed) << message(parsed.error());
  return to_terrain(*parsed, map, cross_unknown);
}

TEST(RosMap, ReadsWhatTheServerReads) {
  const auto map = parse_ros_map(yaml, "lab.yaml");
  ASSERT_TRUE(map) << message(map.error());
  EXPECT_EQ(map->image, "lab.pgm");
  EXPECT_EQ(map->frame.side, 0.5);
  EXPECT_EQ(map->frame.x, -1.0);
  EXPECT_EQ(map->frame.y, 2.0);
  EXPECT_EQ(map->frame.yaw, 0.0);
  EXPECT_FALSE(map->negate);
  EXPECT_FALSE(map->raw);
  EXPECT_EQ(map->occupied, 0.65);
  EXPECT_EQ(map->free, 0.196);
}

TEST(RosMap, OtherSpellingsOfYaml) {
  const auto map = parse_ros_map(
      "---\r\n# a map\r\nimage: \"my #1 lab.pgm\"  # ours\r\nmode: raw\r\nresolution: 5e-2\r\n"
      "origin:\r\n- -10.0\r\n- -2\r\n  - 1.5\r\nnegate: true\r\n",
      "lab.yaml");
  ASSERT_TRUE(map) << message(map.error());
  EXPECT_EQ(map->image, "my #1 lab.pgm");
  EXPECT_EQ(map->frame.side, 0.05);
  EXPECT_EQ(map->frame.x, -10.0);
  EXPECT_EQ(map->frame.y, -2.0);
  EXPECT_EQ(map->frame.yaw, 1.5);
  EXPECT_TRUE(map->negate);
  EXPECT_TRUE(map->raw);
}

TEST(RosMap, FaultsNameTheirPlace) {
  const auto why = [](std::string_view text) {
    return tests::refusal_of(parse_ros_map(text, "m.yaml"));
  };
  EXPECT_EQ(why(""), "m.yaml: expected the key image");
  EXPECT_EQ(why("image: a.pgm\n"), "m.yaml: expected the key resolution");
  EXPECT_EQ(why("image: a.pgm\n resolutoin: 1\n"),
            "m.yaml:2:2: expected image, resolution, origin, negate, occupied_thresh, free_thresh "
            "or mode with a colon, found 'resolutoin'; did you mean 'resolution'?");
  EXPECT_EQ(why("image: a\nimage: b\n"), "m.yaml:2:1: expected one 'image', found a second");
  EXPECT_EQ(why("image:\n"), "m.yaml:1:1: expected the name of an image");
  EXPECT_EQ(why("resolution: 0\n"),
            "m.yaml:1:1: expected a resolution in metres per pixel, 1e-6 to 1e6");
  EXPECT_EQ(why("origin: 1, 2, 3\n"), "m.yaml:1:1: expected origin: [x, y, yaw]");
  EXPECT_EQ(why("origin: [1, 2]\n"), "m.yaml: expected origin: [x, y, yaw]");
  EXPECT_EQ(why("origin: [1, 2, 3, 4]\n"),
            "m.yaml:1:1: expected three numbers for origin: x, y and yaw");
  EXPECT_EQ(why("negate: 2\n"), "m.yaml:1:1: expected negate: 0 or 1");
  EXPECT_EQ(why("mode: binary\n"), "m.yaml:1:1: expected mode: trinary, scale or raw");
  EXPECT_EQ(why("free_thresh: 1.5\n"), "m.yaml:1:1: expected a number from 0 to 1 for free_thresh");
}

TEST(RosMap, LevelsBecomeTerrain) {
  EXPECT_EQ(picture(terrain(image, {})), "..#.\n...#\n.#..\n");
  EXPECT_EQ(picture(terrain(image, {}, true)), "..#.\n....\n.#..\n");
  RosMap negated;
  negated.negate = true;
  EXPECT_EQ(picture(terrain(image, negated)), "##.#\n####\n#.##\n");
  RosMap raw;
  raw.raw = true;  // 0 free, 100 occupied, 19 below 19.6 percent, 255 unknown
  EXPECT_EQ(picture(terrain("P2 5 1 255 0 100 19 20 255", raw)), ".#.##\n");
  EXPECT_EQ(picture(terrain("P2 5 1 255 0 100 19 20 255", raw, true)), ".#...\n");
}

TEST(Pgm, BytesWordsAndText) {
  using namespace std::string_view_literals;
  const auto levels = [](std::string_view text) {
    const auto parsed = parse_pgm(text, "a.pgm");
    EXPECT_TRUE(parsed) << message(parsed.error());
    return parsed ? parsed->levels : std::vector<std::uint16_t>();
  };
  using Levels = std::vector<std::uint16_t>;
  EXPECT_EQ(levels("P5 2 2 255\n\x01\xFF\n\x20"sv), (Levels{1, 255, 10, 32}));
  EXPECT_EQ(levels("P5\n#x\n2 1\n300\n\x01\x2C\x00\x05"sv), (Levels{300, 5}));
  EXPECT_EQ(levels("P2 2 1 9\n1 # one\r\n9\n"), (Levels{1, 9}));
}

TEST(Pgm, FaultsNameTheirPlace) {
  const auto why = [](std::string_view text) {
    return tests::refusal_of(parse_pgm(text, "a.pgm"));
  };
  EXPECT_EQ(why("P6 1 1 255\n..."), "a.pgm:1:1: expected a PGM image (P2 or P5)");
  EXPECT_EQ(why("P5\n0 1"), "a.pgm:2:2: expected a width in pixels");
  EXPECT_EQ(why("P5\n1 x"), "a.pgm:2:3: expected a height in pixels");
  EXPECT_EQ(why("P5\n1 1\n65536\n."), "a.pgm:3:6: expected a white level from 1 to 65535");
  EXPECT_EQ(why("P5\n1 9999999999\n"), "a.pgm:2:3: expected a height in pixels");
  EXPECT_EQ(why("P5 999999999 999999999 255\n..."),
            "a.pgm:2:1: expected 999999999 x 999999999 pixels, found a file that ends before");
  EXPECT_EQ(why("P2 2 1 9 1"), "a.pgm:1:9: expected 2 x 1 pixels, found a file that ends before");
  EXPECT_EQ(why("P2 2 1 9 1 10"), "a.pgm:1:14: expected a level up to 9");
  EXPECT_EQ(why("P2 2 1 9 1 ab"), "a.pgm:1:12: expected a level");
  EXPECT_EQ(why("P2 1 1 9 1 2"), "a.pgm:1:12: expected 1 x 1 pixels, found more");
}

class RosFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = testing::TempDir() + "ros_map_test-" + std::to_string(getpid()) + "/";
    std::filesystem::create_directory(folder_);
    std::ofstream(folder_ + "lab.pgm") << image;
    std::ofstream(folder_ + "lab.yaml") << yaml;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string folder_;
};

TEST_F(RosFiles, PlacesAreInMetres) {
  // The lower left corner of the image is (-1, 2), a cell is half a metre: (0.9, 2.1) is the lower
  // right cell, (-0.8, 3.4) the upper left one.
  const auto mdp = read_model(folder_ + "lab.yaml", {{"goal", "0.9,2.1"}, {"start", "-0.8,3.4"}});
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_EQ(mdp->state_name(mdp->start()[0]), "r0c0");
  EXPECT_TRUE(mdp->terminal(*mdp->find_state("r2c3")));
  EXPECT_EQ(mdp->reward(0), -0.5);  // r0c0, E
  EXPECT_EQ(mdp->states(), 8u);     // but not r0c3, which is cut off
  ASSERT_TRUE(mdp->layout()->frame);
  EXPECT_EQ(mdp->layout()->frame->x, -1.0);
  const auto outside = read_model(folder_ + "lab.yaml", {{"goal", "1.1,2.1"}});
  ASSERT_FALSE(outside);
  EXPECT_EQ(message(outside.error()),
            "--with goal: a place on the map of 4 x 3 cells expected, not '1.1,2.1'");
}

TEST_F(RosFiles, TurnedMapsAreTurnedBack) {
  // A quarter turn to the left: the image's right is north, its top is west.
  std::ofstream(folder_ + "lab.yaml") << "image: lab.pgm\nresolution: 0.5\n"
                                         "origin: [1, 0, 1.5707963267948966]\n";
  const auto mdp = read_model(folder_ + "lab.yaml", {{"goal", "0.75,1.75"}});
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_TRUE(mdp->terminal(*mdp->find_state("r2c3")));
}

TEST_F(RosFiles, TheImageAloneCountsInPixels) {
  const auto mdp = read_model(folder_ + "lab.pgm", {{"goal", "3,2"}, {"unknown", "true"}});
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_EQ(mdp->states(), 10u);
  EXPECT_FALSE(mdp->layout()->frame);
}

TEST_F(RosFiles, AMissingImageIsNamed) {
  std::filesystem::remove(folder_ + "lab.pgm");
  const auto mdp = read_model(folder_ + "lab.yaml", {{"goal", "0.9,2.1"}});
  ASSERT_FALSE(mdp);
  EXPECT_EQ(mdp.error().file, folder_ + "lab.pgm");
}

}  // namespace
}  // namespace quoll
