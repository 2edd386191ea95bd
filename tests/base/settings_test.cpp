#include "quoll/base/settings.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace quoll {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double above_zero = std::numeric_limits<double>::denorm_min();

enum class Explore : std::uint8_t { uniform, greedy, epsilon_greedy };
constexpr std::array<std::string_view, 3> explorations{"uniform", "greedy", "epsilon-greedy"};

struct Sample {
  double discount = 0.8;
  double anything = 0;
  std::uint64_t seeds = 1;
  std::int64_t offset = -3;
  bool quiet = false;
  std::string output = "run";
  Explore explore = Explore::greedy;

  void describe(Describer& describer) {
    describer("discount", discount, above_zero, 1, "What a reward one step later is worth.");
    describer("anything", anything, "Any number.");
    describer("seeds", seeds, 1, infinity, "Number of runs.");
    describer("offset", offset, -5, 5, "A whole number of either sign.");
    describer("quiet", quiet, "Print no progress.");
    describer("output_file", output, "Where the result goes.");
    describer.choice("explore", explore, explorations, "How actions are tried.");
  }
};

class SettingsTest : public ::testing::Test {
 protected:
  const Setting& of(std::string_view name) { return *find(settings_, name); }
  std::string refusal(std::string_view name, std::string_view text) {
    const auto result = assign(of(name), text, "--" + std::string(name));
    return result ? "taken" : message(result.error());
  }

  Sample sample_;
  std::vector<Setting> settings_ = settings_of(sample_);
};

TEST_F(SettingsTest, EachFieldTakesItsText) {
  EXPECT_TRUE(assign(of("discount"), " 1/2 ", "x"));
  EXPECT_EQ(sample_.discount, 0.5);
  EXPECT_TRUE(assign(of("anything"), "-inf", "x"));
  EXPECT_EQ(sample_.anything, -infinity);
  EXPECT_TRUE(assign(of("seeds"), "1e3", "x"));
  EXPECT_EQ(sample_.seeds, 1000u);
  EXPECT_TRUE(assign(of("offset"), "-5", "x"));
  EXPECT_EQ(sample_.offset, -5);
  EXPECT_TRUE(assign(of("quiet"), "yes", "x"));
  EXPECT_TRUE(sample_.quiet);
  EXPECT_TRUE(assign(of("output_file"), " kept as it is ", "x"));
  EXPECT_EQ(sample_.output, " kept as it is ");
  EXPECT_TRUE(assign(of("explore"), "epsilon-greedy", "x"));
  EXPECT_EQ(sample_.explore, Explore::epsilon_greedy);
}

TEST_F(SettingsTest, TextReadsBackUnchanged) {
  sample_.discount = 0.1 + 0.2;
  sample_.anything = -1e300;
  sample_.offset = 4;
  sample_.quiet = true;
  sample_.explore = Explore::uniform;
  Sample copy;
  const auto targets = settings_of(copy);
  for (std::size_t i = 0; i < settings_.size(); ++i) {
    EXPECT_TRUE(assign(targets[i], text_of(settings_[i]), "x")) << settings_[i].name;
  }
  EXPECT_EQ(copy.discount, sample_.discount);
  EXPECT_EQ(copy.anything, sample_.anything);
  EXPECT_EQ(copy.offset, 4);
  EXPECT_TRUE(copy.quiet);
  EXPECT_EQ(copy.output, "run");
  EXPECT_EQ(copy.explore, Explore::uniform);
}

TEST_F(SettingsTest, RefusalsNamePlaceRangeAndText) {
  EXPECT_EQ(refusal("discount", "2"), "--discount: a number in (0, 1] expected, not '2'");
  EXPECT_EQ(refusal("discount", "0"), "--discount: a number in (0, 1] expected, not '0'");
  EXPECT_EQ(refusal("discount", "nan"), "--discount: a number in (0, 1] expected, not 'nan'");
  EXPECT_EQ(refusal("anything", "nan"), "--anything: a number expected, not 'nan'");
  EXPECT_EQ(refusal("seeds", "0"), "--seeds: a whole number of at least 1 expected, not '0'");
  EXPECT_EQ(refusal("seeds", "1.5"), "--seeds: a whole number of at least 1 expected, not '1.5'");
  EXPECT_EQ(refusal("offset", "-6"), "--offset: a whole number in [-5, 5] expected, not '-6'");
  EXPECT_EQ(refusal("offset", "--1"), "--offset: a whole number in [-5, 5] expected, not '--1'");
  EXPECT_EQ(refusal("quiet", "ja"), "--quiet: true | false expected, not 'ja'");
  EXPECT_EQ(refusal("explore", "epsilon-gredy"),
            "--explore: one of uniform | greedy | epsilon-greedy expected, not 'epsilon-gredy'; "
            "did you mean 'epsilon-greedy'?");
}

TEST_F(SettingsTest, ARefusedTextChangesNothing) {
  EXPECT_FALSE(assign(of("discount"), "7", "x"));
  EXPECT_EQ(sample_.discount, 0.8);
  EXPECT_FALSE(assign(of("explore"), "", "x"));
  EXPECT_EQ(sample_.explore, Explore::greedy);
}

TEST_F(SettingsTest, ARefusalIsOneBearableLine) {
  const std::string text = refusal("discount", "a\nb" + std::string(1000, 'x'));
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_LT(text.size(), 150u);
}

TEST_F(SettingsTest, WholeNumbersAreComparedWithoutRounding) {
  std::uint64_t count = 0;
  // 2^53 + 1 is no double: rounded it would seem to be inside.
  const Setting bounded{"n", "", &count, 0, 0x1p53};
  EXPECT_TRUE(assign(bounded, "9007199254740992", "x"));
  EXPECT_FALSE(assign(bounded, "9007199254740993", "x"));
  std::int64_t number = 0;
  const Setting any{"i", "", &number};
  EXPECT_TRUE(assign(any, "-9223372036854775808", "x"));
  EXPECT_EQ(number, std::numeric_limits<std::int64_t>::min());
  EXPECT_FALSE(assign(any, "9223372036854775808", "x"));
  const Setting negative{"i", "", &number, -10, -2};
  EXPECT_TRUE(assign(negative, "-2", "x"));
  EXPECT_FALSE(assign(negative, "-1", "x"));
  EXPECT_FALSE(assign(negative, "0", "x"));
}

TEST_F(SettingsTest, Ranges) {
  EXPECT_EQ(range_of(of("discount")), "number in (0, 1]");
  EXPECT_EQ(range_of(of("anything")), "number");
  EXPECT_EQ(range_of(of("seeds")), "whole number of at least 1");
  EXPECT_EQ(range_of(of("offset")), "whole number in [-5, 5]");
  EXPECT_EQ(range_of(of("quiet")), "true | false");
  EXPECT_EQ(range_of(of("output_file")), "text");
  EXPECT_EQ(range_of(of("explore")), "uniform | greedy | epsilon-greedy");
  double value = 0;
  EXPECT_EQ(range_of({"x", "", &value, 0, std::nextafter(1.0, 0.0)}), "number in [0, 1)");
  EXPECT_EQ(range_of({"x", "", &value, above_zero, infinity}), "number above 0");
  EXPECT_EQ(range_of({"x", "", &value, -infinity, 0.1}), "number of at most 0.1");
}

TEST_F(SettingsTest, FindTreatsDashAsUnderscore) {
  EXPECT_EQ(find(settings_, "output-file"), &of("output_file"));
  EXPECT_EQ(find(settings_, "output"), nullptr);
  EXPECT_EQ(find(settings_, ""), nullptr);
}

}  // namespace
}  // namespace quoll
