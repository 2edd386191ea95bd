#include "quoll/base/json.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace quoll {
namespace {

TEST(Json, WritesCompactAndPretty) {
  const auto write = [](JsonStyle style) {
    JsonWriter json(style);
    json.begin_object().member("world", "adventure").member("states", 6);
    json.key("start").begin_array().value(true).null().begin_object().end_object().end_array();
    json.key("none").begin_array().end_array();
    json.end_object();
    return json.text();
  };
  EXPECT_EQ(write(JsonStyle::compact),
            R"({"world":"adventure","states":6,"start":[true,null,{}],"none":[]})");
  EXPECT_EQ(
      write(JsonStyle::pretty),
      "{\n  \"world\": \"adventure\",\n  \"states\": 6,\n  \"start\": [\n    true,\n    null,\n"
      "    {}\n  ],\n  \"none\": []\n}");
}

TEST(Json, EscapesStrings) {
  EXPECT_EQ(json_string("a\"b\\c/\n\t\r"), R"("a\"b\\c/\n\t\r")");
  EXPECT_EQ(json_string(std::string_view("\0\x01\x1f\x7f", 4)), R"("\u0000\u0001\u001f\u007f")");
  EXPECT_EQ(json_string("HÖHLE \xff"), "\"HÖHLE \xEF\xBF\xBD\"");
}

// 0.1f is 0.100000001490116...: shortest as float "0.1", as double 0.10000000149011612.
TEST(Json, PrintsShortestNumbers) {
  const auto text = [](auto number) { return JsonWriter().value(number).text(); };
  EXPECT_EQ(text(0.1f), "0.1");
  EXPECT_EQ(text(0.1), "0.1");
  EXPECT_EQ(text(static_cast<double>(0.1f)), "0.10000000149011612");
  EXPECT_EQ(JsonWriter().number(static_cast<double>(51.2f), true).text(), "51.2");
  EXPECT_EQ(text(100.0), "100");
  EXPECT_EQ(text(-0.0), "-0");
  EXPECT_EQ(text(1e300), "1e+300");
  EXPECT_EQ(text(std::numeric_limits<std::uint64_t>::max()), "18446744073709551615");
  EXPECT_EQ(text(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
  EXPECT_EQ(text(std::uint8_t{7}), "7");
}

TEST(Json, HasNoWordForNanAndInfinity) {
  JsonWriter json;
  json.begin_array();
  json.value(std::numeric_limits<double>::quiet_NaN());
  json.value(-std::numeric_limits<double>::infinity());
  json.value(std::numeric_limits<float>::infinity());
  json.end_array();
  EXPECT_EQ(json.text(), "[null,null,null]");
}

TEST(Json, KeepsListsUpToTheLimit) {
  JsonWriter json;
  json.begin_object();
  EXPECT_TRUE(json.rows("values", 3, false, [&](std::uint64_t i) { json.value(i); }));
  json.end_object();
  EXPECT_EQ(json.text(), R"({"values":[0,1,2]})");
}

TEST(Json, OmitsLongerListsAndSaysSo) {
  JsonWriter json;
  const auto row = [&](std::uint64_t i) { json.value(i); };
  json.begin_object();
  EXPECT_FALSE(json.rows("q", json_complete_rows + 1, false, row));
  EXPECT_FALSE(json.rows("policy", json_complete_rows + 2, false, row));
  json.member("seed", 1).end_object();
  EXPECT_EQ(json.text(), R"({"q":[],"policy":[],"seed":1,"omitted":200003})");
}

TEST(Json, WritesAllRowsWhenAsked) {
  JsonWriter json;
  std::uint64_t last = 0;
  json.begin_object();
  EXPECT_TRUE(json.rows("q", json_complete_rows + 1, true, [&](std::uint64_t i) {
    json.value(i);
    last = i;
  }));
  json.end_object();
  EXPECT_EQ(last, json_complete_rows);
  EXPECT_TRUE(json.text().ends_with(",99999,100000]}"));
}

TEST(Json, CanBeTakenInPieces) {
  JsonWriter json;
  json.begin_array().value(1);
  std::string text = json.take();
  json.value(2).end_array();
  EXPECT_EQ(text + json.take(), "[1,2]");
}

}  // namespace
}  // namespace quoll
