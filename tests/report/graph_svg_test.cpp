#include "quoll/report/graph_svg.hpp"

#include "quoll/report/graph_arrows.hpp"
#include "tests/report/picture.hpp"
#include "tests/report/worlds.hpp"

namespace quoll {
namespace {

using testing::Solved;

GraphView view_of(const Solved& world) {
  GraphView view;
  view.mdp = &world.mdp;
  view.value = world.value;
  view.q = world.q;
  view.optimal = world.optimal;
  return view;
}

/// The picture promises of a graph: also no state is touched by another or by an arrow's label.
void expect_sound_graph(const Picture& picture) {
  testing::expect_sound(picture);
  const Box canvas{0, 0, picture.width, picture.height};
  for (std::size_t i = 0; i < picture.nodes.size(); ++i) {
    EXPECT_TRUE(canvas.contains(picture.nodes[i]));
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(picture.nodes[i].overlaps(picture.nodes[j]));
    for (const SvgLabel& label : picture.labels) {
      // A state's own texts lie inside its box, all others outside every box.
      EXPECT_TRUE(picture.nodes[i].contains(label.box) || !picture.nodes[i].overlaps(label.box))
          << label.text;
    }
  }
}

std::size_t count(const Picture& picture, const std::string& text) {
  std::size_t found = 0;
  for (const SvgLabel& label : picture.labels) found += label.text == text;
  return found;
}

TEST(GraphSvg, DrawsTheLecturesGame) {
  const Solved world = testing::solved(testing::adventure());
  const Result<Picture> picture = graph_svg(view_of(world));
  ASSERT_TRUE(picture);
  expect_sound_graph(*picture);
  EXPECT_EQ(picture->nodes.size(), 6U);
  // Q*: 51.2 for POOL, To-GATE; 64 for six moves into value 80; 80 for three; 100 twice.
  EXPECT_EQ(count(*picture, "51.2"), 1U);
  EXPECT_EQ(count(*picture, "64"), 6U);
  EXPECT_EQ(count(*picture, "80"), 3U);
  EXPECT_EQ(count(*picture, "100"), 2U);
  EXPECT_EQ(count(*picture, "reward 100"), 2U);
  EXPECT_EQ(count(*picture, "V = 64"), 1U);
  EXPECT_EQ(count(*picture, "end"), 1U);
}

TEST(GraphSvg, HasOneThickArrowPerOptimalMove) {
  const Solved world = testing::solved(testing::adventure());
  const std::string svg = graph_svg(view_of(world))->svg;
  std::size_t thick = 0;
  for (std::size_t i =
           svg.find("fill=\"none\" stroke=\"#0072b2\" stroke-width=\"4\" stroke-linejoin");
       i != std::string::npos;
       i = svg.find("fill=\"none\" stroke=\"#0072b2\" stroke-width=\"4\" stroke-linejoin", i + 1)) {
    ++thick;
  }
  EXPECT_EQ(thick, 6U);  // one each in GATE, HALL, CAVE, WELL, two in POOL
}

TEST(GraphSvg, IsTheSameEveryTime) {
  const Solved world = testing::solved(testing::random_graph(12, 2, 2, 3), 50);
  EXPECT_EQ(graph_svg(view_of(world))->svg, graph_svg(view_of(world))->svg);
}

TEST(GraphSvg, KeepsLabelsApartInRandomGraphs) {
  for (std::uint32_t states = 2; states <= graph_states; states += states < 12 ? 1 : 8) {
    SCOPED_TRACE(states);
    const Solved world = testing::solved(testing::random_graph(states, 2, 1, states * 31), 50);
    const Result<Picture> picture = graph_svg(view_of(world));
    ASSERT_TRUE(picture);
    expect_sound_graph(*picture);
  }
}

TEST(GraphSvg, KeepsLabelsApartInCrowdedGraphs) {
  for (const auto& [states, moves, outcomes] :
       {std::array{3, 6, 1}, std::array{2, 9, 2}, std::array{16, 3, 2}, std::array{60, 2, 1}}) {
    SCOPED_TRACE(states);
    const Solved world = testing::solved(
        testing::random_graph(static_cast<std::uint32_t>(states), static_cast<std::uint32_t>(moves),
                              static_cast<std::uint32_t>(outcomes), 11),
        50);
    expect_sound_graph(*graph_svg(view_of(world)));
  }
}

TEST(GraphSvg, ListsEveryMoveEvenWithoutRoom) {
  const Solved world = testing::solved(testing::random_graph(30, 4, 3, 9), 50);
  const Result<Picture> picture = graph_svg(view_of(world));
  ASSERT_TRUE(picture);
  std::size_t probabilities = 0;
  for (const SvgLabel& label : picture->labels) {
    probabilities += label.text.find("p 0.") != std::string::npos ? 1U : 0U;
  }
  std::size_t chances = 0;  // outcomes that share their choice with others
  for (std::uint64_t c = 0; c < world.mdp.choices(); ++c) {
    const std::uint64_t outcomes = world.mdp.outcome_end(c) - world.mdp.outcome_begin(c);
    chances += outcomes > 1 ? outcomes : 0;
  }
  EXPECT_EQ(probabilities, chances);
}

TEST(GraphSvg, DrawsUnjoinedAndLonelyStates) {
  MdpBuilder builder(0.9);
  builder.state("<alone & \"quoted\">");
  builder.move("a", "stay", "a", 1).move("a", "wait", "a").move("b", "go", "c");
  for (int i = 0; i < 6; ++i) builder.move("a", "loop" + std::to_string(i), "a");
  const Solved world = testing::solved(*builder.build(), 20);
  const Result<Picture> picture = graph_svg(view_of(world));
  ASSERT_TRUE(picture);
  expect_sound_graph(*picture);
  EXPECT_EQ(count(*picture, "<alone & \"quoted\">"), 1U);
}

TEST(GraphSvg, WorksWithoutValues) {
  const Mdp mdp = testing::adventure();
  GraphView view;
  view.mdp = &mdp;
  const Result<Picture> picture = graph_svg(view);
  ASSERT_TRUE(picture);
  expect_sound_graph(*picture);
  EXPECT_EQ(count(*picture, "To-WELL"), 1U);
}

TEST(GraphSvg, SaysWhatToUseForLargerWorlds) {
  const Solved world = testing::solved(testing::random_graph(61, 1, 1, 1), 1);
  GraphView view = view_of(world);
  view.world = "big.toml";
  const Result<Picture> picture = graph_svg(view);
  ASSERT_FALSE(picture);
  EXPECT_NE(message(picture.error()).find("show big.toml map"), std::string::npos);
  EXPECT_NE(message(picture.error()).find("solve big.toml --json"), std::string::npos);
}

// The middle of a quadratic with ends (0,0), (30,0) and control (15, 2 b) lies at (15, b).
TEST(GraphArrows, BendToTheirRight) {
  MdpBuilder builder(0.9);
  builder.move("a", "go", "b").move("b", "back", "a");
  const Mdp mdp = *builder.build();
  GraphView view;
  view.mdp = &mdp;
  std::vector<Arrow> arrows = arrows_of(view);
  route(arrows, {{0, 0, 80, 40}, {300, 0, 80, 40}});
  ASSERT_EQ(arrows.size(), 2U);
  EXPECT_NEAR(arrows[0].samples[16].y, 20 + 23, 0.5);  // right of travel to the right is below
  EXPECT_NEAR(arrows[1].samples[16].y, 20 - 23, 0.5);
}

}  // namespace
}  // namespace quoll
