#include "quoll/report/table.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/report/worlds.hpp"

namespace quoll {
namespace {

using Align = TextTable::Align;

TEST(TextTable, AlignsByColumnsOfTheTerminal) {
  TextTable table({{"room", Align::left}, {"V", Align::point}, {"n", Align::right}});
  table.row({"Höhle", "51.2", "7"});
  table.row({"洞窟", "-100", "12"});
  table.row({"x"});
  EXPECT_EQ(table.text(),
            "room        V   n\n"
            "Höhle    51.2   7\n"
            "洞窟   -100    12\n"
            "x\n");
}

TEST(NumberText, RoundsForPeople) {
  EXPECT_EQ(number_text(80), "80");
  EXPECT_EQ(number_text(51.2), "51.2");
  EXPECT_EQ(number_text(1.0 / 3), "0.333333");
  EXPECT_EQ(number_text(-0.0), "0");
  EXPECT_EQ(number_text(1234567), "1.23457e+06");
}

// Q* of the lecture's game: Q(s, To-t) = reward + 0.8 V*(t); V* = 64, 80, 80, 100, 100.
TEST(QTable, ShowsTheLecturesGame) {
  const testing::Solved world = testing::solved(testing::adventure());
  std::vector<double> q;
  for (const double value : world.q) q.push_back(static_cast<double>(static_cast<float>(value)));
  std::vector<std::uint32_t> visits(q.size(), 3);
  visits[0] = 1234;
  QTableView view;
  view.mdp = &world.mdp;
  view.q = q;
  view.q_star = world.q;
  view.visits = visits;
  view.policy = world.policy;
  EXPECT_EQ(q_table(view),
            "         move         Q  true Q*  visits\n"
            "GATE  *  To-POOL   64       64     1,234  <- best\n"
            "HALL     To-POOL   64       64         3\n"
            "      *  To-CAVE   80       80         3  <- best\n"
            "POOL     To-GATE   51.2     51.2       3\n"
            "         To-HALL   64       64         3\n"
            "      *  To-CAVE   80       80         3  <- best\n"
            "      *  To-WELL   80       80         3  <- equally good\n"
            "CAVE     To-HALL   64       64         3\n"
            "         To-POOL   64       64         3\n"
            "      *  To-GOAL  100      100         3  <- best\n"
            "WELL     To-POOL   64       64         3\n"
            "      *  To-GOAL  100      100         3  <- best\n"
            "GOAL     (end)\n");
}

TEST(QTable, DoesNotStarWhatWasNeverTried) {
  const Mdp mdp = testing::adventure();
  std::vector<double> q(mdp.choices(), 0.0);
  std::vector<std::uint32_t> visits(mdp.choices(), 0);
  visits[1] = 1;  // HALL, To-POOL
  QTableView view;
  view.mdp = &mdp;
  view.q = q;
  view.visits = visits;
  const std::string text = q_table(view);
  EXPECT_NE(text.find("HALL  *  To-POOL  0       1  <- best\n"), std::string::npos) << text;
  EXPECT_NE(text.find("GATE     To-POOL  0       0\n"), std::string::npos) << text;
}

TEST(QTable, MarksOneCellAndShowsFurtherColumns) {
  const Mdp mdp = testing::adventure();
  const std::vector<double> q(mdp.choices(), 80.0), standard(mdp.choices(), 64.0);
  QTableView view;
  view.mdp = &mdp;
  view.q = q;
  view.q_title = "as printed";
  view.more = {{"standard", standard}};
  view.marked = 0;
  view.mark = "<- first difference";
  view.states = 1;
  EXPECT_EQ(q_table(view),
            "         move     as printed  standard\n"
            "GATE  *  To-POOL          80        64  <- best  <- first difference\n"
            "... and 5 more states (use --json --all or -o FILE)\n");
}

TEST(QTable, LeavesStatesOutForPeople) {
  const Mdp mdp = testing::random_graph(1030, 1, 1, 5);
  const std::vector<double> q(mdp.choices(), 1.0);
  QTableView view;
  view.mdp = &mdp;
  view.q = q;
  EXPECT_TRUE(q_table(view).ends_with("... and 1,010 more states (use --json --all or -o FILE)\n"));
  view.states = 0;
  EXPECT_EQ(q_table(view).find("more states"), std::string::npos);
}

TEST(ValueTable, ShowsTies) {
  const testing::Solved world = testing::solved(testing::adventure());
  ValueTableView view;
  view.mdp = &world.mdp;
  view.lower = view.upper = world.value;
  view.policy = world.policy;
  view.optimal = world.optimal;
  EXPECT_EQ(value_table(view),
            "state   V*  best move\n"
            "GATE    64  To-POOL\n"
            "HALL    80  To-CAVE\n"
            "POOL    80  To-CAVE or To-WELL\n"
            "CAVE   100  To-GOAL\n"
            "WELL   100  To-GOAL\n"
            "GOAL     0  (end)\n");
}

TEST(ValueTable, ShowsIntervalsThatDifferInPrint) {
  const Mdp mdp = testing::adventure();
  const std::vector<double> lower{63.9, 80, 80, 100, 100, 0}, upper{64, 80, 80, 100, 100, 0};
  ValueTableView view;
  view.mdp = &mdp;
  view.lower = lower;
  view.upper = upper;
  view.states = 2;
  EXPECT_EQ(value_table(view),
            "state  V* from  to\n"
            "GATE      63.9  64\n"
            "HALL      80    80\n"
            "... and 4 more states (use --json --all or -o FILE)\n");
}

}  // namespace
}  // namespace quoll
