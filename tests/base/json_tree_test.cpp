#include "quoll/base/json_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace quoll {
namespace {

TEST(JsonTree, ReadsBackWhatItWrites) {
  const Tree tree(Tree::Object{
      {"none", Tree()},
      {"flag", Tree(false)},
      {"whole", Tree(std::int64_t{-7})},
      {"real", Tree(0.1)},
      {"text", Tree(std::string("a \"b\"\n"))},
      {"list", Tree(Tree::List{Tree(1.5), Tree(Tree::List{}), Tree(Tree::Object{})})}});
  const std::string text = json_text(tree);
  EXPECT_EQ(text, R"({"none":null,"flag":false,"whole":-7,"real":0.1,"text":"a \"b\"\n",)"
                  R"("list":[1.5,[],{}]})");
  const Result<Tree> read = read_json(text, "x.json");
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, tree);
}

TEST(JsonTree, AFloatIsWrittenAsAFloat) {
  EXPECT_EQ(json_text(Tree(0.1f)), "0.1");
  EXPECT_EQ(json_text(Tree(double{0.1f})), "0.10000000149011612");
}

TEST(JsonTree, WhatIsNoNumberInJsonIsAText) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(json_text(Tree(Tree::List{Tree(infinity), Tree(-infinity), Tree(std::nanf(""))})),
            R"(["inf","-inf","nan"])");
}

TEST(JsonTree, SaysWhereItIsNotJson) {
  const Result<Tree> read = read_json("{\"a\": 1,\n \"b\": }", "x.json");
  ASSERT_FALSE(read);
  EXPECT_EQ(message(read.error()), "x.json:2:7: a JSON value expected");
  EXPECT_FALSE(read_json("", "x"));
  EXPECT_FALSE(read_json("1 2", "x"));
  EXPECT_FALSE(read_json("nan", "x"));
}

TEST(JsonTree, ADeepNestIsRefusedBeforeItHurts) {
  EXPECT_TRUE(read_json(std::string(100, '[') + std::string(100, ']'), "x"));
  const Result<Tree> deep = read_json(std::string(1'000'000, '['), "x");
  ASSERT_FALSE(deep);
  EXPECT_EQ(deep.error().expected, "JSON nested at most 100 deep expected");
}

}  // namespace
}  // namespace quoll
