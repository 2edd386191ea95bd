#include "quoll/base/tree.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <limits>

namespace quoll {
namespace {

enum class Turn : std::uint8_t { left, right };

struct Inner {
  double x = 0.5;
  template <class A>
  void persist(A& archive) {
    archive("x", x);
  }
};

struct Everything {
  bool flag = true;
  std::int8_t small = -3;
  Turn turn = Turn::right;
  std::array<float, 2> pair{1.5f, 2.5f};
  std::vector<Inner> inner{{0.25}, {4.0}};
  std::string name = "A";

  template <class A>
  void persist(A& archive) {
    archive("flag", flag);
    archive("small", small);
    archive("turn", turn);
    archive("pair", pair);
    archive("inner", inner);
    archive("name", name);
    if (!archive.saving() && small > 100) archive.fail("small is too large");
  }
};

TEST(Tree, AStructIsAnObjectOfItsFields) {
  const Tree tree = tree_of(Everything{});
  ASSERT_TRUE(tree.find("inner"));
  EXPECT_EQ(*tree.find("flag"), Tree(true));
  EXPECT_EQ(*tree.find("small"), Tree(std::int64_t{-3}));
  EXPECT_EQ(*tree.find("turn"), Tree(std::int64_t{1}));
  EXPECT_EQ(std::get<Tree::List>(tree.find("pair")->value)[1], Tree(2.5f));
  EXPECT_EQ(*std::get<Tree::List>(tree.find("inner")->value)[1].find("x"), Tree(4.0));
  EXPECT_FALSE(tree.find("other"));
}

TEST(Tree, WhatIsWrittenIsReadBack) {
  Everything other;
  other.flag = false;
  other.small = 7;
  other.turn = Turn::left;
  other.inner = {};
  other.name = "";
  Everything read;
  ASSERT_TRUE(assign(read, tree_of(other)));
  EXPECT_EQ(tree_of(read), tree_of(other));
}

TEST(Tree, NumbersAndListsStandAlone) {
  std::array<double, 3> position{};
  const Tree list(Tree::List{Tree(1.5), Tree(std::int64_t{2}), Tree(2.5f)});
  ASSERT_TRUE(assign(position, list));
  EXPECT_EQ(position, (std::array<double, 3>{1.5, 2.0, 2.5}));
  int number = 3;
  EXPECT_FALSE(assign(number, Tree(1.5)));
  EXPECT_EQ(number, 3);
}

// What does not fit is named by its path, and nothing is changed.
TEST(Tree, WhatDoesNotFitIsNamed) {
  const auto reason = [](const std::function<void(Tree::Object&)>& change) {
    Tree tree = tree_of(Everything{});
    change(std::get<Tree::Object>(tree.value));
    Everything read;
    const Result<void> done = assign(read, tree);
    EXPECT_EQ(tree_of(read), tree_of(Everything{}));
    return done ? "read" : done.error().expected;
  };
  EXPECT_EQ(reason([](auto& o) { o.pop_back(); }), "name: expected, but missing");
  EXPECT_EQ(reason([](auto& o) { o.emplace_back("more", Tree(true)); }),
            "no further field expected");
  EXPECT_EQ(reason([](auto& o) { o[0].second = Tree(std::int64_t{2}); }),
            "flag: true or false expected");
  EXPECT_EQ(reason([](auto& o) { o[1].second = Tree(std::int64_t{128}); }),
            "small: a whole number from -128 to 127 expected");
  EXPECT_EQ(reason([](auto& o) { o[1].second = Tree(std::int64_t{101}); }), "small is too large");
  EXPECT_EQ(reason([](auto& o) { o[3].second = Tree(Tree::List{Tree(1.0)}); }),
            "pair: a list of 2 expected");
  EXPECT_EQ(reason([](auto& o) {
              std::get<Tree::Object>(std::get<Tree::List>(o[4].second.value)[1].value)[0].second =
                  Tree(std::numeric_limits<double>::infinity());
            }),
            "inner[1].x: a finite number expected");
  EXPECT_EQ(reason([](auto& o) { o[4].second = Tree(std::string("x")); }),
            "inner: a list expected");
  EXPECT_EQ(reason([](auto& o) { o[5].second = Tree(); }), "name: a text expected");
}

}  // namespace
}  // namespace quoll
