#include "quoll/base/text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <clocale>
#include <cmath>
#include <limits>

#include "quoll/base/random.hpp"

namespace quoll {
namespace {

TEST(Text, TrimTakesBlanksFromBothEnds) {
  EXPECT_EQ(trim("  a b\t\r\n"), "a b");
  EXPECT_EQ(trim(" \t "), "");
  EXPECT_EQ(trim(""), "");
}

TEST(Text, SplitKeepsEmptyPieces) {
  using Pieces = std::vector<std::string_view>;
  EXPECT_EQ(split("a, b ,,c", ','), (Pieces{"a", "b", "", "c"}));
  EXPECT_EQ(split("", ','), Pieces{""});
  EXPECT_EQ(split(",", ','), (Pieces{"", ""}));
}

TEST(Text, NumbersPeopleWrite) {
  EXPECT_EQ(parse_number("1"), 1.0);
  EXPECT_EQ(parse_number("+1.5"), 1.5);
  EXPECT_EQ(parse_number("-1e-3"), -0.001);
  EXPECT_EQ(parse_number(".5"), 0.5);
  EXPECT_EQ(parse_number("5."), 5.0);
  EXPECT_EQ(parse_number("1E+2"), 100.0);
  EXPECT_EQ(parse_number("1/3"), 1.0 / 3.0);
  EXPECT_EQ(parse_number("-1/4"), -0.25);
  EXPECT_EQ(parse_number("0.1/0.4"), 0.1 / 0.4);
  EXPECT_EQ(parse_number("inf"), HUGE_VAL);
  EXPECT_EQ(parse_number("-Infinity"), -HUGE_VAL);
  EXPECT_TRUE(std::isnan(parse_number("nan").value()));
  EXPECT_TRUE(std::signbit(parse_number("-0").value()));
  EXPECT_EQ(parse_number("5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(parse_number("1.7976931348623157e308"), std::numeric_limits<double>::max());
}

TEST(Text, OtherTextIsNoNumber) {
  for (const char* text :
       {"",      "+",     "-",     ".",     "e5",     "1e",    "1e+",   "1x",     "0x10",
        "1,5",   "--1",   "+-1",   "1 2",   " 1",     "1 ",    "1/",    "/3",     "1/0",
        "1/3/5", "1/-3",  "inf/2", "1/inf", "nan(1)", "infin", "1e400", "1e-400", "1e308/1e-308",
        "2_000", "1.2.3", "1e5.5"}) {
    EXPECT_FALSE(parse_number(text)) << "'" << text << "'";
  }
  EXPECT_FALSE(parse_number(std::string_view("1\0", 2)));
}

TEST(Text, NumbersDoNotDependOnTheLocale) {
  // Where the machine has no such locale the test still says that C is served.
  const char* const german = std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(parse_number("1.5"), 1.5);
  EXPECT_EQ(shortest(1.5), "1.5");
  if (german != nullptr) std::setlocale(LC_ALL, "C");
}

TEST(Text, Counts) {
  EXPECT_EQ(parse_count("0"), 0u);
  EXPECT_EQ(parse_count("007"), 7u);
  EXPECT_EQ(parse_count("2_000"), 2000u);
  EXPECT_EQ(parse_count("1e6"), 1'000'000u);
  EXPECT_EQ(parse_count("1E+6"), 1'000'000u);
  EXPECT_EQ(parse_count("1.5e3"), 1500u);
  EXPECT_EQ(parse_count("1500e-2"), 15u);
  EXPECT_EQ(parse_count("1.000000000000000000000000e1"), 10u);
  EXPECT_EQ(parse_count("0e999999"), 0u);
  EXPECT_EQ(parse_count("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
}

TEST(Text, OtherTextIsNoCount) {
  for (const char* text : {"",
                           "-1",
                           "+1",
                           "1.5",
                           "1.0",
                           "10M",
                           "1e",
                           "1e-1",
                           "1.5e0",
                           "1e20",
                           "1e99999999999",
                           "_1",
                           "1_",
                           "1__0",
                           "1_e3",
                           "1e1_0",
                           "1e++3",
                           "1e+-3",
                           ".5e1",
                           "5.e1",
                           " 1",
                           "0x1",
                           "18446744073709551616",
                           "e3"}) {
    EXPECT_FALSE(parse_count(text)) << "'" << text << "'";
  }
}

TEST(Text, ShortestInTheLayoutPeopleExpect) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(100.0), "100");
  EXPECT_EQ(shortest(100000.0), "100000");
  EXPECT_EQ(shortest(-2.5), "-2.5");
  EXPECT_EQ(shortest(123456.789), "123456.789");
  EXPECT_EQ(shortest(0.0001), "0.0001");
  EXPECT_EQ(shortest(0.00001), "1e-05");
  EXPECT_EQ(shortest(1e15), "1000000000000000");
  EXPECT_EQ(shortest(1e16), "1e+16");
  EXPECT_EQ(shortest(1e30), "1e+30");
  EXPECT_EQ(shortest(0.0), "0");
  EXPECT_EQ(shortest(-0.0), "-0");
  EXPECT_EQ(shortest(HUGE_VAL), "inf");
  EXPECT_EQ(shortest(-HUGE_VAL), "-inf");
  EXPECT_EQ(shortest(-std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(shortest(0.1f), "0.1");
  EXPECT_EQ(shortest(16777216.0f), "16777216");
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(double{0.1f}), "0.10000000149011612");
}

TEST(Text, ShortestReadsBackUnchanged) {
  Rng rng = stream(1, "shortest");
  for (int i = 0; i < 100'000; ++i) {
    const auto wide = std::bit_cast<double>(rng.next());
    if (std::isfinite(wide)) {
      ASSERT_EQ(parse_number(shortest(wide)), wide);
    }
    const auto narrow = std::bit_cast<float>(static_cast<std::uint32_t>(rng.next() >> 32));
    if (std::isfinite(narrow)) {
      ASSERT_EQ(static_cast<float>(parse_number(shortest(narrow)).value()), narrow);
    }
  }
}

TEST(Text, NearestCountsSwapsAsOneAndIgnoresCase) {
  const std::vector<std::string> names{"GATE", "HALL", "POOL", "CAVE", "epsilon_greedy"};
  EXPECT_EQ(nearest("Hall", names), "HALL");
  EXPECT_EQ(nearest("POLO", names), "POOL");
  EXPECT_EQ(nearest("CVAE", names), "CAVE");  // one swap: within 1 + 4/4
  EXPECT_EQ(nearest("CAE", names), "CAVE");   // 1 of 1 + 3/4 = 1
  EXPECT_EQ(nearest("epsilon-gredy", names), "epsilon_greedy");
  EXPECT_EQ(nearest("GOAL", names), "POOL");  // 2 changes of 2 allowed; HALL costs 3
  EXPECT_EQ(nearest("WELLNESS", names), "");  // HALL costs 5 of 3
  EXPECT_EQ(nearest("", names), "");
  EXPECT_EQ(nearest("HALL", std::vector<std::string>{}), "");
}

TEST(Text, NearestOfEqualsIsTheFirst) {
  const std::vector<std::string_view> names{"cat", "bat", "rat"};
  EXPECT_EQ(nearest("hat", names), "cat");
  EXPECT_EQ(nearest("x", std::vector<std::string_view>{"y"}), "") << "no letter in common";
}

TEST(Text, NearestKeepsToItsThreshold) {
  // 1 + 8/4 = 3 edits are allowed for eight letters.
  EXPECT_EQ(nearest("abcdefgh", std::vector<std::string_view>{"abcdeXYZ"}), "abcdeXYZ");
  EXPECT_EQ(nearest("abcdefgh", std::vector<std::string_view>{"abcdWXYZ"}), "");
  EXPECT_EQ(nearest("abcdefgh", std::vector<std::string_view>{"abcdefghijkl"}), "");
}

TEST(Text, Grouped) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(1234567), "1,234,567");
}

TEST(Text, ACountHasItsNoun) {
  EXPECT_EQ(counted(0, "step"), "0 steps");
  EXPECT_EQ(counted(1, "step"), "1 step");
  EXPECT_EQ(counted(12345, "step"), "12,345 steps");
}

}  // namespace
}  // namespace quoll
