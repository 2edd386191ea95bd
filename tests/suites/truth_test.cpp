// Ten thousand random models whose answers are known as fractions: no solver of the registry gives
// bounds that miss the optimum, and every policy earns at least what was promised. The optimum
// comes from policy iteration in 128-bit fractions, written here and for this alone.
// QUOLL_TRUTH=100000 in the environment tries as many.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../solve/models.hpp"
#include "fraction.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/rounding.hpp"
#include "quoll/solve/solver.hpp"
#include "quoll/verify/verify.hpp"

namespace quoll {
namespace {

using test::Fraction;

#if defined(QUOLL_SANITIZED)
constexpr std::uint64_t models = 500;
#else
constexpr std::uint64_t models = 10'000;
#endif

struct Move {
  Fraction reward;  // expected
  std::vector<std::pair<std::size_t, Fraction>> to;
};

// The last state is the end.
struct Model {
  std::vector<std::vector<Move>> moves;
  Fraction discount;
  bool minimise = false;

  std::size_t states() const { return moves.size(); }
};

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : x_(seed * 2862933555777941757u + 3037000493u) {}
  unsigned operator()(unsigned below) {
    x_ = x_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<unsigned>((x_ >> 33) % below);
  }

 private:
  std::uint64_t x_;
};

// What a model looks like, by its seed.
struct Shape {
  unsigned states;  // without the end
  bool deterministic, forward, alternating, by_outcome, one_start;
  unsigned discount;  // which one
};

constexpr std::array<std::pair<int, int>, 8> discounts = {
    {{1, 1}, {1, 1}, {1, 1}, {1, 2}, {4, 5}, {9, 10}, {19, 20}, {99, 100}}};

// Writes the same model twice: as fractions, and as the doubles nearest to them.
class Writer {
 public:
  Writer(Dice& dice, const Shape& shape, Model& model)
      : dice_(dice), shape_(shape), model_(model), builder_(discount()) {
    model_.discount = {discounts[shape.discount].first, discounts[shape.discount].second};
    model_.moves.resize(shape.states + 1);
    for (unsigned s = 0; s <= shape.states; ++s) builder_.state(std::to_string(s));
  }

  Mdp write() {
    for (unsigned s = 0; s < shape_.states; ++s) {
      const unsigned actions = 1 + dice_(3);
      for (unsigned a = 0; a < actions; ++a) write_move(s, "a" + std::to_string(a));
    }
    if (shape_.one_start) builder_.start("0");
    if (!shape_.alternating) return test::built(builder_);
    MdpArrays arrays = test::built(builder_).arrays();
    arrays.alternating = true;
    return std::move(*Mdp::make(std::move(arrays)));
  }

 private:
  double discount() const {
    return static_cast<double>(discounts[shape_.discount].first) /
           discounts[shape_.discount].second;
  }

  unsigned successor(unsigned s) {
    if (shape_.forward) return s + 1 + dice_(shape_.states - s);
    return dice_(4) == 0 ? shape_.states : dice_(shape_.states + 1);
  }

  void write_move(unsigned s, const std::string& name) {
    const std::uint32_t action = builder_.action(name);
    const unsigned denominator = shape_.deterministic ? 1 : 2 + dice_(9);
    const int parts = dice_(2) == 0 ? 10 : 3;  // of rewards: decimals, or thirds
    Move move;
    int reward = reward_part();
    for (unsigned left = denominator; left > 0;) {
      unsigned next = successor(s);
      unsigned share = move.to.size() == 2 ? left : 1 + dice_(left);
      bool again = false;
      for (const auto& [known, p] : move.to) again = again || known == next;
      if (again) {  // a successor stands once: the sum of two doubles is not the nearest
        next = shape_.states;
        for (const auto& [known, p] : move.to) {
          if (known == next) return write_certain(s, action, reward, parts);
        }
        share = left;
      }
      if (shape_.by_outcome) reward = reward_part();
      const Fraction p(share, denominator);
      move.to.emplace_back(next, p);
      move.reward = move.reward + p * Fraction(reward, parts);
      pending_.push_back(
          {next, static_cast<double>(reward) / parts, static_cast<double>(share) / denominator});
      left -= share;
    }
    for (const Outcome& o : pending_) builder_.move(s, action, o.next, o.reward, o.p);
    pending_.clear();
    model_.moves[s].push_back(std::move(move));
  }

  void write_certain(unsigned s, std::uint32_t action, int reward, int parts) {
    pending_.clear();
    const unsigned next = successor(s);
    builder_.move(s, action, next, static_cast<double>(reward) / parts, 1.0);
    model_.moves[s].push_back({Fraction(reward, parts), {{next, Fraction(1)}}});
  }

  // At discount 1 mostly costs, or nearly every model would gain for ever.
  int reward_part() {
    if (shape_.discount < 3 && !shape_.forward) {
      return dice_(5) == 0 ? static_cast<int>(dice_(12)) : -static_cast<int>(dice_(40));
    }
    return static_cast<int>(dice_(81)) - 40;
  }

  struct Outcome {
    unsigned next;
    double reward, p;
  };
  Dice& dice_;
  const Shape& shape_;
  Model& model_;
  MdpBuilder builder_;
  std::vector<Outcome> pending_;
};

// V*, V of a policy, and which states can end, by fractions.
class Truth {
 public:
  explicit Truth(const Model& model) : model_(model), live_(model.states(), true) {
    if (model.discount == Fraction(1)) find_live();
    for (std::size_t s = 0; s + 1 < live_.size(); ++s) endless_ = endless_ || !live_[s];
    solve();
  }

  bool live(std::size_t s) const { return live_[s]; }
  bool endless() const { return endless_; }  // some state cannot end with probability 1
  bool gains() const { return gains_; }      // for ever: nothing is defined
  const Fraction& value(std::size_t s) const { return value_[s]; }

  // Of the states that are `asked` for. Empty = the policy does not end, or leads to others.
  std::optional<std::vector<Fraction>> value_of(const std::vector<std::size_t>& policy,
                                                const std::vector<bool>& asked) const {
    const std::size_t n = model_.states();
    std::vector<std::vector<Fraction>> a(n, std::vector<Fraction>(n + 1));
    for (std::size_t s = 0; s < n; ++s) {
      a[s][s] = 1;
      if (s + 1 == n || !asked[s]) continue;
      const Move& move = model_.moves[s][policy[s]];
      a[s][n] = move.reward;
      for (const auto& [next, p] : move.to) {
        if (!asked[next]) return std::nullopt;
        a[s][next] = a[s][next] - model_.discount * p;
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t pivot = k;
      while (pivot < n && a[pivot][k].sign() == 0) ++pivot;
      if (pivot == n) return std::nullopt;
      std::swap(a[k], a[pivot]);
      for (std::size_t i = 0; i < n; ++i) {
        if (i == k || a[i][k].sign() == 0) continue;
        const Fraction factor = a[i][k] / a[k][k];
        for (std::size_t j = k; j <= n; ++j) {
          if (a[k][j].sign() != 0) a[i][j] = a[i][j] - factor * a[k][j];
        }
      }
    }
    std::vector<Fraction> value(n);
    for (std::size_t k = 0; k < n; ++k) value[k] = a[k][n] / a[k][k];
    return value;
  }

 private:
  bool safe(const Move& move) const {
    for (const auto& [next, p] : move.to) {
      if (!live_[next]) return false;
    }
    return true;
  }

  // Drops states that cannot reach the end by moves that stay among the live ones, until none is
  // left to drop; policy_ then takes such a move that comes nearer.
  void find_live() {
    const std::size_t end = model_.states() - 1;
    for (bool dropped = true; dropped;) {
      dropped = false;
      std::vector<bool> near(model_.states(), false);
      near[end] = true;
      policy_.assign(model_.states(), 0);
      for (bool grown = true; grown;) {
        grown = false;
        for (std::size_t s = 0; s < end; ++s) {
          for (std::size_t m = 0; m < model_.moves[s].size() && live_[s] && !near[s]; ++m) {
            const Move& move = model_.moves[s][m];
            if (!safe(move)) continue;
            for (const auto& [next, p] : move.to) near[s] = near[s] || near[next];
            if (near[s]) policy_[s] = m;
            grown = grown || near[s];
          }
        }
      }
      for (std::size_t s = 0; s < end; ++s) {
        if (!live_[s] || near[s]) continue;
        live_[s] = false;
        dropped = true;
      }
    }
  }

  void solve() {
    if (policy_.empty()) policy_.assign(model_.states(), 0);
    for (bool switched = true; switched && !Fraction::overflown;) {
      switched = false;
      const auto value = value_of(policy_, live_);
      if (!value) {
        gains_ = true;
        return;
      }
      value_ = *value;
      for (std::size_t s = 0; s + 1 < model_.states(); ++s) {
        if (!live_[s]) continue;
        Fraction best = value_[s];
        for (std::size_t m = 0; m < model_.moves[s].size(); ++m) {
          const Move& move = model_.moves[s][m];
          if (!safe(move)) continue;
          Fraction q = move.reward;
          for (const auto& [next, p] : move.to) q = q + model_.discount * p * value_[next];
          if (!(best < q)) continue;
          best = q;
          policy_[s] = m;
          switched = true;
        }
      }
    }
  }

  const Model& model_;
  std::vector<bool> live_;
  std::vector<std::size_t> policy_;
  std::vector<Fraction> value_;
  bool endless_ = false, gains_ = false;
};

// What the player to move can be sure of, in a model without cycles whose turns pass.
std::vector<Fraction> sure_values(const Model& model) {
  std::vector<Fraction> value(model.states());
  for (std::size_t s = model.states() - 1; s-- > 0;) {
    bool first = true;
    for (const Move& move : model.moves[s]) {
      Fraction q = move.reward;
      for (const auto& [next, p] : move.to) q = q - model.discount * p * value[next];
      if (first || value[s] < q) value[s] = q;
      first = false;
    }
  }
  return value;
}

struct Tally {
  std::uint64_t solved = 0, refused = 0, open = 0, skipped = 0;
};

// One solver's answer held against the truth. `sign`: -1 where costs are asked for.
void expect_truth(const Mdp& mdp, const Truth& truth, const Solution& found, bool minimise,
                  Tally& tally) {
  std::vector<std::size_t> policy(mdp.states(), 0);
  std::vector<bool> asked(mdp.states(), true);  // where something is said of the policy
  for (State s = 0; s < mdp.states(); ++s) {
    if (found.policy[s] != no_action) policy[s] = found.policy[s];
    asked[s] = (minimise ? -found.upper[s] : found.lower[s]) > -infinity;
  }
  const auto earned = truth.value_of(policy, asked);
  for (State s = 0; s + 1 < mdp.states(); ++s) {
    const double lower = minimise ? -found.upper[s] : found.lower[s];
    const double upper = minimise ? -found.lower[s] : found.upper[s];
    if (lower == -infinity && upper == infinity) continue;  // nothing is said
    if (!truth.live(s)) {
      ASSERT_EQ(lower, -infinity) << s;
      continue;
    }
    ASSERT_LE(lower, truth.value(s).below()) << s;
    ASSERT_GE(upper, truth.value(s).above()) << s;
    if (lower == -infinity) continue;
    ASSERT_TRUE(earned) << "a policy that does not end";
    ASSERT_LE(lower, (*earned)[s].below()) << s;
  }
  if (!found.converged) ++tally.open;
  ++tally.solved;
}

void expect_truth_of_all(std::uint64_t seed, const Mdp& mdp, const Model& model, Tally& tally) {
  Fraction::overflown = false;
  const Truth truth(model);
  if (Fraction::overflown) {
    ++tally.skipped;
    return;
  }
  for (const SolverEntry& entry : solvers()) {
    if (!test::can_do(entry, mdp)) continue;
    SCOPED_TRACE(std::string(entry.name) + " seed " + std::to_string(seed));
    SolveSettings settings;
    settings.maximise = !model.minimise;
    const auto found = solve(mdp, settings, entry.name);
    if (!found) {
      ++tally.refused;
      ASSERT_TRUE(truth.gains() || truth.endless()) << message(found.error());
      continue;
    }
    if (truth.gains()) continue;  // no start comes there, or the gain is too small to be certain
    ASSERT_NO_FATAL_FAILURE(expect_truth(mdp, truth, *found, model.minimise, tally));
    if (!found->converged || Fraction::overflown) continue;
    EXPECT_LE(largest_gap(mdp, *found), settings.width);
    if (model.minimise) continue;
    const auto verdict = verify(mdp, found->lower, found->upper, found->policy, found->discount);
    ASSERT_TRUE(verdict && verdict->accepted) << (verdict ? verdict->reason : "");
  }
}

Shape shape_of(Dice& dice) {
  Shape shape{};
  shape.states = 1 + dice(5);
  shape.deterministic = dice(4) == 0;
  shape.forward = dice(6) == 0;
  shape.alternating = shape.forward && dice(3) == 0;
  shape.by_outcome = dice(3) == 0;
  shape.one_start = dice(4) == 0;
  shape.discount = dice(8);
  return shape;
}

TEST(Truth, NoAnswerOfAnySolverMissesTheFraction) {
  const char* asked = std::getenv("QUOLL_TRUTH");
  const std::uint64_t count = asked != nullptr ? std::strtoull(asked, nullptr, 10) : models;
  Tally tally;
  for (std::uint64_t seed = 1; seed <= count && !HasFatalFailure(); ++seed) {
    Dice dice(seed);
    const Shape shape = shape_of(dice);
    Model model;
    const Mdp mdp = Writer(dice, shape, model).write();
    model.minimise = !shape.alternating && dice(4) == 0;
    if (model.minimise) {
      for (auto& moves : model.moves) {
        for (Move& move : moves) move.reward = -move.reward;
      }
    }
    if (!shape.alternating) {
      expect_truth_of_all(seed, mdp, model, tally);
      continue;
    }
    const std::vector<Fraction> sure = sure_values(model);
    const auto found = solve(mdp);
    ASSERT_TRUE(found) << seed;
    for (State s = 0; s < mdp.states(); ++s) {
      ASSERT_LE(found->lower[s], sure[s].below()) << "seed " << seed << " state " << s;
      ASSERT_GE(found->upper[s], sure[s].above()) << "seed " << seed << " state " << s;
    }
    ++tally.solved;
  }
  RecordProperty("answers", std::to_string(tally.solved));
  if (asked != nullptr) {
    std::printf(
        "%llu models: %llu answers, %llu refused, %llu not narrow, %llu too large\n",
        static_cast<unsigned long long>(count), static_cast<unsigned long long>(tally.solved),
        static_cast<unsigned long long>(tally.refused), static_cast<unsigned long long>(tally.open),
        static_cast<unsigned long long>(tally.skipped));
  }
  EXPECT_GT(tally.solved, 3 * count);
  EXPECT_LT(tally.skipped, count / 100);
}

TEST(Truth, FractionsRoundBothWays) {
  EXPECT_EQ(Fraction(1, 2).below(), 0.5);
  EXPECT_EQ(Fraction(1, 2).above(), 0.5);
  EXPECT_EQ(Fraction(1, 3).below(), 1.0 / 3.0);  // the nearest double to 1/3 is the one below
  EXPECT_EQ(Fraction(1, 3).above(), next_up(1.0 / 3.0));
  EXPECT_EQ(Fraction(-1, 3).below(), -next_up(1.0 / 3.0));
  EXPECT_EQ(Fraction(1, 10).above(), 0.1);  // 0.1 lies above a tenth
  EXPECT_EQ((Fraction(1, 6) + Fraction(1, 3)).above(), 0.5);
  EXPECT_EQ((Fraction(-2, 3) / Fraction(4, 9)).below(), -1.5);
}

}  // namespace
}  // namespace quoll
