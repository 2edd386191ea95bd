#include "quoll/act/rows.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "quoll/act/exploration.hpp"

namespace quoll {
namespace {

// The same rows of 1 to 4 values in both layouts; few different values, so that ties abound.
template <class Value>
struct BothLayouts {
  std::vector<Value> four, ragged;
  std::vector<std::uint32_t> four_visits, ragged_visits;
  std::vector<std::uint64_t> begin{0};

  explicit BothLayouts(std::uint64_t seed) {
    Rng rng = stream(seed, "rows");
    for (int row = 0; row < 500; ++row) {
      const std::uint32_t legal = 1 + rng.below(4);
      for (std::uint32_t a = 0; a < 4; ++a) {
        const auto value = static_cast<Value>(static_cast<int>(rng.below(3)) - 1);
        const std::uint32_t count = rng.below(4);
        four.push_back(a < legal ? value : FourRows<Value>::padding);
        four_visits.push_back(count);
        if (a >= legal) continue;
        ragged.push_back(value);
        ragged_visits.push_back(count);
      }
      begin.push_back(ragged.size());
    }
  }
};

template <class Value>
void same_choices() {
  const BothLayouts<Value> table(1);
  const FourRows<Value> four;
  const RaggedRows<Value> ragged{table.begin.data()};
  Rng rng = stream(2, "draws");
  for (State s = 0; s < 500; ++s) {
    const auto left = four.view(table.four.data(), s);
    const auto right = ragged.view(table.ragged.data(), s);
    ASSERT_EQ(left.best, right.best);
    ASSERT_EQ(four.legal(left), ragged.legal(right));
    ASSERT_EQ(four.ties(left), ragged.ties(right));
    ASSERT_EQ(four.first(table.four.data(), s, left), ragged.first(table.ragged.data(), s, right));
    for (int draw = 0; draw < 8; ++draw) {
      const auto bits = static_cast<std::uint32_t>(rng.next());
      ASSERT_EQ(four.pick(table.four.data(), s, left, bits),
                ragged.pick(table.ragged.data(), s, right, bits));
      const ChoiceDraws draws = ChoiceDraws::of(rng);
      for (const auto kind : {Exploration::Kind::uniform, Exploration::Kind::greedy,
                              Exploration::Kind::epsilon_greedy, Exploration::Kind::softmax,
                              Exploration::Kind::ucb}) {
        Exploration exploration;
        exploration.kind = kind;
        exploration.epsilon = {0.5, 0.5, 0};
        exploration.temperature = {0.7, 0.7, 0};
        exploration.first_tie = draw % 2 == 0;
        const Chosen a = exploration.choose(four, table.four.data(), table.four_visits.data(), s,
                                            left, draws, 0);
        const Chosen b = exploration.choose(ragged, table.ragged.data(), table.ragged_visits.data(),
                                            s, right, draws, 0);
        ASSERT_EQ(a.action, b.action) << static_cast<int>(kind);
        ASSERT_EQ(a.explored, b.explored);
        ASSERT_LT(a.action, four.legal(left));
      }
    }
  }
}

TEST(Rows, BothLayoutsChooseTheSameFromFloats) {
  same_choices<float>();
}
TEST(Rows, BothLayoutsChooseTheSameFromDoubles) {
  same_choices<double>();
}

// {1, 3, 3, padding}: best 3, actions 1 and 2 tie. scale(bits, 2) is the top bit.
TEST(Rows, TheDrawSelectsAmongTheMaximisers) {
  const float q[] = {1, 3, 3, FourRows<float>::padding};
  const FourRows<float> rows;
  const auto view = rows.view(q, 0);
  EXPECT_EQ(view.best, 3.0f);
  EXPECT_EQ(rows.legal(view), 3u);
  EXPECT_EQ(rows.ties(view), 2u);
  EXPECT_EQ(rows.pick(q, 0, view, 0), 1u);
  EXPECT_EQ(rows.pick(q, 0, view, 0x7fffffff), 1u);
  EXPECT_EQ(rows.pick(q, 0, view, 0x80000000), 2u);
  EXPECT_EQ(rows.pick(q, 0, view, 0xffffffff), 2u);
  EXPECT_EQ(rows.first(q, 0, view), 1u);
}

// The coin of the plain loop, which asks nothing else, falls as Exploration's does.
TEST(Rows, TheCoinOfThePlainLoopChoosesTheSame) {
  const BothLayouts<float> table(1);
  const FourRows<float> rows;
  Rng rng = stream(3, "draws");
  Exploration exploration;
  exploration.kind = Exploration::Kind::epsilon_greedy;
  for (const double epsilon : {0.0, 0.3, 1.0}) {
    exploration.epsilon = {epsilon, epsilon, 0};
    const std::uint64_t threshold = exploration.coin_threshold();
    for (State s = 0; s < 500; ++s) {
      const auto row = rows.view(table.four.data(), s);
      const ChoiceDraws draws = ChoiceDraws::of(rng);
      const auto choose = [&](auto&& how) {
        return how.choose(rows, table.four.data(), table.four_visits.data(), s, row, draws, 0)
            .action;
      };
      exploration.first_tie = false;
      ASSERT_EQ(choose(exploration), choose(CoinExploration<false, false>{threshold}));
      if (epsilon == 1.0) {
        ASSERT_EQ(choose(exploration), choose(CoinExploration<false, true>{threshold}));
      }
      exploration.first_tie = true;
      ASSERT_EQ(choose(exploration), choose(CoinExploration<true, false>{threshold}));
    }
  }
}

TEST(Rows, AnEndHasNoActionsAndTheValueZero) {
  const std::uint64_t begin[] = {0, 0};
  const RaggedRows<float> rows{begin};
  const auto view = rows.view(nullptr, 0);
  EXPECT_EQ(view.best, 0.0f);
  EXPECT_EQ(view.legal, 0u);
}

}  // namespace
}  // namespace quoll
