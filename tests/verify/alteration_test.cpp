// Random alterations of valid certificates: each is refused with a state named, or what it says is
// true, which exact arithmetic confirms. Probabilities are quarters, rewards whole numbers and
// discounts quarters, so that the values are fractions of small numbers.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "../solve/models.hpp"
#include "fraction.hpp"
#include "quoll/base/random.hpp"
#include "quoll/base/text.hpp"
#include "quoll/model/digest.hpp"
#include "quoll/solve/solver.hpp"
#include "quoll/verify/certificate.hpp"

namespace quoll {
namespace {

using test::Fraction;
using Values = std::vector<Fraction>;
using Lines = std::vector<std::string>;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr State inner = 4;  // states that are not the end
constexpr std::size_t head_lines = 8;

// Every state may quit for good at a price.
Mdp random_model(std::uint64_t seed, double discount) {
  Rng rng = stream(seed, "alterations");
  MdpBuilder b(discount);
  for (State s = 0; s <= inner; ++s) b.state("s" + std::to_string(s));
  for (State s = 0; s < inner; ++s) {
    b.move("s" + std::to_string(s), "quit", "s4", static_cast<double>(rng.below(4)) - 4.0);
    for (int a = 0; a < 2; ++a) {
      const double reward = static_cast<double>(rng.below(7)) - 4.0;
      const std::uint32_t quarters = rng.below(5);
      const State one = rng.below(inner + 1);
      const State other = rng.below(inner + 1);
      const std::uint32_t action = b.action("a" + std::to_string(a));
      if (quarters > 0) b.move(s, action, one, reward, 0.25 * quarters);
      if (quarters < 4) b.move(s, action, other, reward, 1.0 - 0.25 * quarters);
    }
  }
  return test::built(b);
}

// Values of the policy by exact elimination; states where it is `open` count as ends of value
// -10^4 in the sense of the objective: worse than all else. Empty if it does not end.
Values policy_values(const Mdp& mdp, const std::vector<Action>& policy, double discount,
                     const std::vector<bool>& open, bool maximise) {
  const int worst = maximise ? -10'000 : 10'000;
  std::vector<std::vector<Fraction::Integer>> rows(
      mdp.states(), std::vector<Fraction::Integer>(mdp.states() + 1, 0));
  for (State s = 0; s < mdp.states(); ++s) {
    rows[s][s] = 16;
    if (mdp.terminal(s)) continue;
    if (open[s]) {
      rows[s][mdp.states()] = 16 * worst;
      continue;
    }
    const std::uint64_t c = mdp.choice_begin(s) + policy[s];
    rows[s][mdp.states()] = static_cast<int>(16.0 * mdp.reward(c));
    for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
      rows[s][mdp.next(o)] -= static_cast<int>(16.0 * discount * mdp.probability(o));
    }
  }
  return test::solved(std::move(rows));
}

// The best of all policies, at discount 1 of those that end; since every state may quit, one of
// those is best everywhere.
Values best_values(const Mdp& mdp, double discount, bool maximise) {
  std::vector<Action> policy(mdp.states(), 0);
  Values best;
  for (;;) {
    const Values value =
        policy_values(mdp, policy, discount, std::vector<bool>(mdp.states(), false), maximise);
    for (State s = 0; s < value.size(); ++s) {
      if (best.size() <= s)
        best.push_back(value[s]);
      else if (maximise ? best[s] < value[s] : value[s] < best[s])
        best[s] = value[s];
    }
    State s = 0;
    for (; s < inner; ++s) {
      if (++policy[s] < mdp.actions(s)) break;
      policy[s] = 0;
    }
    if (s == inner) return best;
  }
}

// Without discounting circles may gain without end; then a certificate may bound nothing.
bool may_bound(const Mdp& mdp, const Certificate& said) {
  SolveSettings settings;
  settings.discount = said.discount;
  settings.maximise = said.maximise;
  if (solve(mdp, settings)) return true;
  for (State s = 0; s < inner; ++s) {
    if (!std::isinf(said.maximise ? said.upper[s] : said.lower[s])) return false;
  }
  return true;
}

// Whether what a certificate says of this model is true.
bool is_true(const Mdp& mdp, const Certificate& said) {
  const Values best = best_values(mdp, said.discount, said.maximise);
  std::vector<bool> open(mdp.states());
  for (State s = 0; s < mdp.states(); ++s) {
    const double sure = said.maximise ? said.lower[s] : -said.upper[s];
    open[s] = sure == -inf && !mdp.terminal(s);
    if (!open[s] && !mdp.terminal(s) && said.policy[s] == no_action) return false;
  }
  const Values own = policy_values(mdp, said.policy, said.discount, open, said.maximise);
  if (own.empty()) return false;
  for (State s = 0; s < mdp.states(); ++s) {
    if (open[s]) {
      if (!(said.maximise ? best[s].at_most(said.upper[s]) : best[s].at_least(said.lower[s]))) {
        return false;
      }
    } else if (said.maximise) {
      if (!own[s].at_least(said.lower[s]) || !best[s].at_most(said.upper[s])) return false;
    } else {
      if (!own[s].at_most(said.upper[s]) || !best[s].at_least(said.lower[s])) return false;
    }
  }
  return true;
}

Lines split_lines(const std::string& text) {
  std::istringstream stream_of(text);
  Lines lines;
  for (std::string line; std::getline(stream_of, line);) lines.push_back(line);
  return lines;
}

// The lines of a certificate that solve would write; empty where there is no answer.
Lines certificate_of(const Mdp& mdp, double discount, bool maximise) {
  SolveSettings settings;
  settings.discount = discount;
  settings.maximise = maximise;
  const auto found = solve(mdp, settings);
  if (!found) return {};
  const Certificate certificate{"model",       {},           digest(mdp),  discount,     maximise,
                                found->method, found->lower, found->upper, found->policy};
  const auto text = certificate_text(certificate, mdp);
  EXPECT_TRUE(text);
  return split_lines(*text);
}

double altered(double x, Rng& rng) {
  const double sign = rng.below(2) == 0 ? 1.0 : -1.0;
  switch (rng.below(7)) {
    case 0:
      return std::nextafter(x, sign * inf);
    case 1:
      return x + sign * 1e-9;
    case 2:
      return x + sign;
    case 3:
      return x + sign * 0.125;
    case 4:
      return sign * inf;
    case 5:
      return -x;
    default:
      return x * (1.0 + sign * 1e-3);
  }
}

void alter_row(std::string& row, Rng& rng) {
  const auto fields = split(row, ',');
  std::string action(fields[1]);
  double lower = *parse_number(fields[2]);
  double upper = *parse_number(fields[3]);
  switch (rng.below(5)) {
    case 0:
      lower = altered(lower, rng);
      break;
    case 1:
      upper = altered(upper, rng);
      break;
    case 2:
      lower = upper = altered(upper, rng);
      break;
    case 3:
      std::swap(lower, upper);
      break;
    default:
      action = std::vector<std::string>{"quit", "a0", "a1", ""}[rng.below(4)];
      break;
  }
  row = std::string(fields[0]) + "," + action + "," + shortest(lower) + "," + shortest(upper);
}

// One random change: a row, the discount, the objective, or the lines of another model.
void alter(Lines& lines, Rng& rng, const Lines& others) {
  const std::uint32_t kind = rng.below(8);
  if (kind == 0)
    lines[3] = "discount = " + std::vector<std::string>{"0.25", "0.5", "0.75", "1"}[rng.below(4)];
  if (kind == 1)
    lines[4] = lines[4].ends_with("maximise") ? "objective = minimise" : "objective = maximise";
  if (kind == 2 && !others.empty()) lines = others;
  if (kind > 2) alter_row(lines[head_lines + rng.below(inner + 1)], rng);
}

struct Count {
  int refused = 0, confirmed = 0;
};

void expect_refused_or_true(const Mdp& mdp, const Lines& lines, Count& count) {
  const std::string path = testing::TempDir() + "quoll_alteration.cert";
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  std::ofstream(path) << text;
  auto open = open_certificate(path);
  ASSERT_TRUE(open) << message(open.error());
  const auto fits = read_claims(*open, mdp);
  ASSERT_TRUE(fits) << message(fits.error()) << text;
  if (!fits->accepted) {
    ++count.refused;
    EXPECT_EQ(fits->state, std::optional<State>(inner)) << fits->reason;  // the end has no action
    return;
  }
  const Certificate& said = open->content;
  const auto verdict =
      verify(mdp, said.lower, said.upper, said.policy, said.discount, said.maximise);
  ASSERT_TRUE(verdict) << message(verdict.error());
  if (verdict->accepted) {
    ++count.confirmed;
    EXPECT_TRUE(is_true(mdp, said)) << text;
    EXPECT_TRUE(may_bound(mdp, said)) << text;
  } else {
    ++count.refused;
    ASSERT_TRUE(verdict->state) << verdict->reason;
    EXPECT_TRUE(verdict->reason.starts_with("state " + mdp.state_name(*verdict->state) + ": "));
  }
}

TEST(Alteration, IsRefusedOrStillTrue) {
  Rng rng = stream(7, "alterations");
  Count count;
  int models = 0;
  for (std::uint64_t seed = 1; count.refused + count.confirmed < 1500; ++seed) {
    const double discount = 0.25 * (1 + seed % 4);
    const bool maximise = seed % 3 != 0;
    const Mdp mdp = random_model(seed, discount);
    const Lines lines = certificate_of(mdp, discount, maximise);
    if (lines.empty()) continue;
    ++models;
    Count valid;
    expect_refused_or_true(mdp, lines, valid);
    EXPECT_EQ(valid.confirmed, 1);
    const Lines others = certificate_of(random_model(seed + 1000, discount), discount, maximise);
    for (int i = 0; i < 20; ++i) {
      Lines changed = lines;
      alter(changed, rng, others);
      if (changed == lines) continue;
      expect_refused_or_true(mdp, changed, count);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GE(count.refused, 700);
  EXPECT_GE(count.confirmed, 100);
  EXPECT_GE(models, 50);
  RecordProperty("refused", count.refused);
  RecordProperty("confirmed", count.confirmed);
}

}  // namespace
}  // namespace quoll
