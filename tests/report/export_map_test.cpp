#include "quoll/report/export_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string_view>

#include "quoll/model/builder.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

using namespace std::string_view_literals;

// r0c0 r0c1 r0c2
//      wall r1c2 = goal
Mdp lane() {
  auto mdp = parse_model("height 2\nwidth 3\nmap\n...\n@@.\n", "lane.map", {{"goal", "2,1"}});
  EXPECT_TRUE(mdp) << message(mdp.error());
  return *std::move(mdp);
}

Mdp framed(double yaw) {
  MdpArrays arrays = lane().arrays();
  arrays.layout->frame = Layout::Frame{0.5, 10.0, 20.0, yaw};
  return *Mdp::make(std::move(arrays));
}

const std::vector<Action> policy{0, 0, 0, no_action};  // E, E, S
const std::vector<double> cost{3, 2, 1, -0.0};

TEST(ExportMap, RowsOfMoves) {
  const Mdp mdp = lane();
  const auto text = moves_csv({&mdp, policy, cost});
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, "x,y,state,move,cost\n0,0,r0c0,E,3\n1,0,r0c1,E,2\n2,0,r0c2,S,1\n2,1,r1c2,,0\n");
  const auto learned = moves_csv({&mdp, policy, {}});
  ASSERT_TRUE(learned);
  EXPECT_EQ(*learned, "x,y,state,move\n0,0,r0c0,E\n1,0,r0c1,E\n2,0,r0c2,S\n2,1,r1c2,\n");
}

TEST(ExportMap, PlacesInMetres) {
  // Two rows of half a metre above (10, 20): the middle of r0c0 is (10.25, 20.75).
  const Mdp mdp = framed(0.0);
  const auto text = moves_csv({&mdp, policy, cost});
  ASSERT_TRUE(text);
  EXPECT_EQ(*text,
            "x,y,state,move,cost\n10.25,20.75,r0c0,E,3\n10.75,20.75,r0c1,E,2\n"
            "11.25,20.75,r0c2,S,1\n11.25,20.25,r1c2,,0\n");
}

TEST(ExportMap, AnImageOfTheCost) {
  const Mdp mdp = framed(1.5);
  const std::vector<double> some{3, std::numeric_limits<double>::infinity(), 1, 0};
  const auto image = cost_image({&mdp, policy, some}, "cost.pgm");
  ASSERT_TRUE(image);
  // 3 is level 100, 1 a third of it; the infinite cost and both walls are unknown.
  EXPECT_EQ(image->pgm, "P5\n3 2\n255\n\x64\xFF\x21\xFF\xFF\x00"sv);
  EXPECT_EQ(image->yaml,
            "# cost to go: 0 at level 0, 3 at level 100, 255 where there is none\n"
            "image: cost.pgm\nmode: raw\nresolution: 0.5\norigin: [10, 20, 1.5]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST(ExportMap, OfStatesInOneCellTheCheapestCounts) {
  auto mdp = parse_model("height 1\nwidth 2\nmap\n..\n", "lane.map",
                         {{"goal", "1,0"}, {"heading", "true"}});
  ASSERT_TRUE(mdp);
  std::vector<double> costs(16, 4.0);
  costs[2] = 2.0;
  costs[8] = 0.0;
  const auto image = cost_image({&*mdp, std::vector<Action>(16, 0), costs}, "cost.pgm");
  ASSERT_TRUE(image);
  EXPECT_EQ(image->pgm, "P5\n2 1\n255\n\x64\x00"sv);
}

TEST(ExportMap, NeedsAGrid) {
  const auto mdp = MdpBuilder(0.5).move("A", "go", "B").build();
  ASSERT_TRUE(mdp);
  const std::vector<Action> actions{0, no_action};
  const std::vector<double> costs{0, 0};
  EXPECT_FALSE(moves_csv({&*mdp, actions, costs}));
  EXPECT_FALSE(cost_image({&*mdp, actions, costs}, "cost.pgm"));
}

}  // namespace
}  // namespace quoll
