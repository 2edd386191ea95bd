#include "quoll/model/templates.hpp"

#include <gtest/gtest.h>

#include "quoll/model/check.hpp"
#include "quoll/model/digest.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

TEST(Templates, BothAreTheSameWorldWithoutFindings) {
  const auto toml = parse_model(toml_template(), "template.toml");
  ASSERT_TRUE(toml) << message(toml.error());
  const auto csv = parse_model(csv_template(), "template.csv");
  ASSERT_TRUE(csv) << message(csv.error());
  EXPECT_EQ(digest(*toml), digest(*csv));
  EXPECT_EQ(csv->states(), 4u);
  EXPECT_EQ(csv->choices(), 5u);
  EXPECT_EQ(csv->discount(), 0.95);
  EXPECT_EQ(csv->state_name(csv->start()[0]), "GOOD");
  for (const Finding& finding : check(*csv)) ADD_FAILURE() << finding.sentence;
}

}  // namespace
}  // namespace quoll
