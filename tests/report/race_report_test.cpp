// Tables, pictures and pages of races.

#include <gtest/gtest.h>

#include <cmath>

#include "quoll/report/race_page.hpp"
#include "quoll/report/race_svg.hpp"
#include "quoll/report/race_text.hpp"
#include "tests/report/picture.hpp"

namespace quoll {
namespace {

EntrantResult entrant(const std::string& word, std::initializer_list<std::uint64_t> steps,
                      double step_seconds, std::uint64_t cap) {
  EntrantResult result;
  result.word = result.settings = word;
  for (const std::uint64_t count : steps) {
    const HeatEnd end = count < cap ? HeatEnd::reached : HeatEnd::steps;
    const double seconds = static_cast<double>(count) * step_seconds;
    result.heats.push_back({result.heats.size() + 1, end, count, seconds, 1200});
  }
  return result;
}

RaceResult race() {
  RaceResult result;
  result.world = "lake";
  result.command = "lake --discount 0.99";
  result.mode = RaceMode::all;
  result.discount = 0.99;
  result.states = 64;
  result.choices = 212;
  result.seeds = 3;
  result.cap_steps = 1'000'000;
  result.entrants = {entrant("lecture", {90'000, 100'000, 120'000}, 1e-8, 1'000'000),
                     entrant("quick", {10, 20, 40}, 1e-6, 1'000'000),
                     entrant("slow", {500'000, 1'000'000, 1'000'000}, 1e-7, 1'000'000)};
  result.entrants[0].note = "episodes of 32 steps";
  EntrantResult refused;
  refused.word = "planner";
  refused.refused = "needs what is not there";
  result.entrants.push_back(refused);
  summarise(result);
  return result;
}

TEST(RaceText, TellsWinsLossesAndFailures) {
  EXPECT_EQ(
      race_text(race()),
      "race lake   steps and seconds until within 1 % of optimal in every state (any state "
      "may be chosen); discount 0.99, 3 seeds from 1, at most 1,000,000 steps\n"
      "\n"
      "entrant  steps  quartiles       fewer      time  quartiles            less  a step  "
      "failed  memory\n"
      "lecture  100 k  95 k .. 110 k      1x      1 ms  950 us .. 1.1 ms       1x   10 ns     "
      "0/3  1.2 kB\n"
      "quick       20  15 .. 30       5,000x     20 us  15 us .. 30 us        50x    1 us     "
      "0/3  1.2 kB\n"
      "slow     > 1 M  750 k .. 1 M   < 0.1x  > 100 ms  75 ms .. 100 ms   < 0.01x  100 ns     "
      "2/3  1.2 kB\n"
      "\n"
      "lecture: episodes of 32 steps\n"
      "a failed seed counts as 1,000,000 steps, and as the seconds these take at its own "
      "speed\n"
      "planner does not run: needs what is not there\n");
}

TEST(RaceText, NumbersForPeople) {
  EXPECT_EQ(seconds_text(4.5e-8), "45 ns");
  EXPECT_EQ(seconds_text(0.9999e-6), "1 us");
  EXPECT_EQ(seconds_text(0.094), "94 ms");
  EXPECT_EQ(seconds_text(1.28), "1.28 s");
  EXPECT_EQ(seconds_text(200), "3 min 20 s");
  EXPECT_EQ(bytes_text(512), "512 B");
  EXPECT_EQ(bytes_text(12'300), "12.3 kB");
  EXPECT_EQ(times_text(18'000.4), "18,000x");
  EXPECT_EQ(times_text(5.94), "5.9x");
}

TEST(RaceText, FactorsAreBoundsWhereAMedianFailed) {
  RaceResult result = race();
  const EntrantResult& good = result.entrants[1];
  const EntrantResult& failed = result.entrants[2];
  EXPECT_EQ(factor_cell(good, good, 1.0), "1x");
  EXPECT_EQ(factor_cell(failed, good, 50'000.0), "> 50,000x");
  EXPECT_EQ(factor_cell(good, failed, 0.5), "< 0.5x");
  EXPECT_EQ(factor_cell(failed, failed, 1.0), "-");
  EXPECT_EQ(factor_cell(good, good, std::nan("")), "-");
}

TEST(RaceSvg, DrawsARowPerEntrantWithBandAndMedian) {
  const Picture picture = race_svg(race());
  testing::expect_sound(picture);
  std::size_t bands = 0;
  for (std::size_t i = picture.svg.find("fill-opacity"); i != std::string::npos;
       i = picture.svg.find("fill-opacity", i + 1)) {
    ++bands;
  }
  EXPECT_EQ(bands, 6u);  // three entrants, two panels
  EXPECT_NE(picture.svg.find("&gt; 1 M (2/3 failed)"), std::string::npos);
  EXPECT_EQ(picture.svg.find("planner"), std::string::npos);
}

TEST(RaceSvg, SurvivesNothingAndManyAndLongNames) {
  RaceResult none = race();
  for (EntrantResult& one : none.entrants) one.heats.clear();
  summarise(none);
  testing::expect_sound(race_svg(none));
  RaceResult many = race();
  const EntrantResult copied = many.entrants[1];
  for (int i = 0; i < 20; ++i) {
    many.entrants.push_back(copied);
    many.entrants.back().word = "method:with=a:very=long:list=of:settings=" + std::to_string(i);
  }
  testing::expect_sound(race_svg(many));
}

TEST(RaceSvg, KeepsTicksApartOnAnyScale) {
  for (const std::uint64_t most : {1ull, 100ull, 1'000'000ull, 1'000'000'000'000ull}) {
    RaceResult wide = race();
    wide.cap_steps = most * 10;
    wide.entrants = {entrant("lecture", {1, 1, 1}, 1e-9, most * 10),
                     entrant("other", {most, most, most}, 1e-6, most * 10)};
    summarise(wide);
    testing::expect_sound(race_svg(wide));
  }
}

TEST(RacePage, HoldsMeansFactorsAndLosses) {
  PageRace one{race(), "lake", "colder than usual", "lake-all.svg"};
  PageRace two = one;
  two.name = "pond";
  two.result.entrants[1] = entrant("quick", {200'000, 200'000, 200'000}, 1e-6, 1'000'000);
  summarise(two.result);
  const std::vector<PageRace> races{one, two};
  const std::string page = race_page({"Worlds", "quoll race --suite", races});
  // Geometric mean of 5,000 and 0.5; of 50 and 0.005 in time; a win and a loss.
  EXPECT_NE(page.find("| `quick` | 50x | 50x | 0.5x | 1 | 1 | 0 | 0 | 0 of 6 |"), std::string::npos)
      << page;
  EXPECT_NE(page.find("| `slow` | 0.1x | 0.1x | 0.01x | 0 | 2 | 2 | 0 | 4 of 6 |"),
            std::string::npos);
  EXPECT_NE(page.find("| `planner` | - | - | - | 0 | 0 | 0 | 2 | 0 of 0 |"), std::string::npos);
  EXPECT_NE(page.find("| pond | 100 k | 0.5x | < 0.1x |"), std::string::npos);
  EXPECT_NE(page.find("- `planner` does not run: needs what is not there\n"), std::string::npos);
  EXPECT_NE(page.find("`quoll race lake --discount 0.99 --mode all`: 64 states, 212 pairs, chance. "
                      "Note: colder than usual."),
            std::string::npos);
  EXPECT_NE(page.find("![lake](lake-all.svg)"), std::string::npos);
  EXPECT_EQ(page.find("## From the start"), std::string::npos);
}

}  // namespace
}  // namespace quoll
