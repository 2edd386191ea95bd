#include "quoll/nn/optimiser.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/nn/targets.hpp"

namespace quoll::nn {
namespace {

using Kind = OptimiserKind;

// One number under an optimiser, in double precision, by the formulas of the papers.
struct Scalar {
  OptimiserSettings how;
  double x, mean = 0.0, square = 0.0, before = 0.0, own_step = 0.0;
  int t = 0;

  void step(double g, double a) {
    if (t++ == 0) own_step = a;
    switch (how.kind) {
      case Kind::sgd:
        x -= a * g;
        break;
      case Kind::rmsprop:
      case Kind::centred_rmsprop: {
        square = how.decay * square + (1 - how.decay) * g * g;
        mean = how.decay * mean + (1 - how.decay) * g;
        const double centre = how.kind == Kind::centred_rmsprop ? mean * mean : 0.0;
        x -= a * g / (std::sqrt(square - centre) + how.epsilon);
        break;
      }
      case Kind::adam:
      case Kind::radam:
        moments(g, a);
        break;
      case Kind::rprop:
        signs(g);
        break;
    }
  }

  void moments(double g, double a) {
    mean = how.beta1 * mean + (1 - how.beta1) * g;
    square = how.beta2 * square + (1 - how.beta2) * g * g;
    const double m = mean / (1 - std::pow(how.beta1, t)), power = std::pow(how.beta2, t);
    if (how.kind == Kind::adam) {
      x -= a * m / (std::sqrt(square / (1 - power)) + how.epsilon);
      return;
    }
    const double longest = 2 / (1 - how.beta2) - 1, length = longest - 2 * t * power / (1 - power);
    if (length <= 5) {
      x -= a * m;
      return;
    }
    const double r =
        std::sqrt((length - 4) * (length - 2) * longest / ((longest - 4) * (longest - 2) * length));
    x -= a * m * r * std::sqrt(1 - power) / (std::sqrt(square) + how.epsilon);
  }

  void signs(double g) {
    if (g * before > 0) own_step = std::min(own_step * 1.2, 50.0);
    if (g * before < 0) own_step = std::max(own_step * 0.5, 1e-6), g = 0;
    before = g;
    x -= g > 0 ? own_step : g < 0 ? -own_step : 0;
  }
};

// 16 numbers under one optimiser.
struct Vector16 {
  Optimiser optimiser;
  std::vector<float> x;

  Vector16(const OptimiserSettings& how, std::vector<float> begin)
      : optimiser(how, 16), x(std::move(begin)) {}
  void step(std::vector<float> g, double a) {
    g.resize(16);
    optimiser.step(x, g, a);
  }
};

constexpr Kind kinds[] = {Kind::sgd,  Kind::rmsprop, Kind::centred_rmsprop,
                          Kind::adam, Kind::radam,   Kind::rprop};

TEST(Optimiser, FirstStepsByHand) {
  on_every_target([] {
    const std::vector<float> one(16, 1.0f);
    Vector16 sgd({.kind = Kind::sgd}, one);
    sgd.step({2.0f, -4.0f}, 0.25);
    EXPECT_EQ(sgd.x[0], 0.5f);
    EXPECT_EQ(sgd.x[1], 2.0f);
    EXPECT_EQ(sgd.x[2], 1.0f);

    // v = g^2 / 4, so that every first step is 2 a.
    Vector16 rms({.kind = Kind::rmsprop, .decay = 0.75, .epsilon = 0.0}, one);
    rms.step(std::vector(16, -8.0f), 0.125);
    EXPECT_EQ(rms.x[0], 1.25f);

    // v = 1/2 and m^2 = 1/4: g / sqrt(1/4) = 2.
    Vector16 centred({.kind = Kind::centred_rmsprop, .decay = 0.5, .epsilon = 0.0}, one);
    centred.step(std::vector(16, 1.0f), 0.125);
    EXPECT_EQ(centred.x[0], 0.75f);

    // m' = g and v' = g^2 at the first step, whatever the betas.
    Vector16 adam({.kind = Kind::adam, .epsilon = 0.0}, one);
    adam.step(std::vector(16, 5.0f), 0.125);
    EXPECT_NEAR(adam.x[0], 0.875f, 1e-7);

    // No rectification for five steps with beta2 = 0.999: x -= a m', and m' = g while g is the
    // same.
    Vector16 radam({.kind = Kind::radam}, one);
    for (int t = 1; t <= 5; ++t) {
      radam.step(std::vector(16, 4.0f), 0.125);
      EXPECT_NEAR(radam.x[0], 1.0 - 0.5 * t, 1e-6);
    }
    // Length 5.0 is passed at the sixth, with a step of a sqrt of about 1/1000.
    const float before = radam.x[0];
    radam.step(std::vector(16, 4.0f), 0.125);
    EXPECT_LT(before - radam.x[0], 0.005f);
    EXPECT_GT(before - radam.x[0], 0.0f);
    EXPECT_EQ(radam.optimiser.steps(), 6u);
  });
}

TEST(Optimiser, RpropByHand) {
  on_every_target([] {
    Vector16 rprop({.kind = Kind::rprop}, std::vector(16, 0.0f));
    rprop.step({1.0f, -1e-30f, 0.0f}, 0.5);  // the first step is the rate
    EXPECT_EQ(rprop.x[0], -0.5f);
    EXPECT_EQ(rprop.x[1], 0.5f);
    EXPECT_EQ(rprop.x[2], 0.0f);
    rprop.step({1e-30f, -1e-30f, 0.0f}, 99.0);  // same sign: 1.2 times as far
    EXPECT_NEAR(rprop.x[0], -1.1f, 1e-6);
    EXPECT_NEAR(rprop.x[1], 1.1f, 1e-6);
    rprop.step({-1.0f, -1.0f, 0.0f}, 99.0);  // turned: half as far, and stays for once
    EXPECT_NEAR(rprop.x[0], -1.1f, 1e-6);
    rprop.step({-1.0f, -1.0f, 0.0f}, 99.0);  // as if it had no sign before
    EXPECT_NEAR(rprop.x[0], -0.8f, 1e-6);
    for (int t = 0; t < 60; ++t) rprop.step({0.0f, -1.0f}, 99.0);
    const float far = rprop.x[1];
    rprop.step({0.0f, -1.0f}, 99.0);
    EXPECT_NEAR(rprop.x[1] - far, 50.0f, 1e-3) << "the longest step";
  });
}

TEST(Optimiser, HundredStepsAgreeWithDoublePrecision) {
  for (const Kind kind : kinds) {
    SCOPED_TRACE(std::string(optimiser_names[static_cast<std::size_t>(kind)]));
    const OptimiserSettings how{.kind = kind, .epsilon = 1e-5};
    same_bits_where_fused([&] {
      const std::vector<float> begin = random_floats(16, 3);
      Vector16 all(how, begin);
      std::vector<Scalar> scalars;
      for (const float x : begin) scalars.push_back({.how = how, .x = double{x}});
      for (int t = 0; t < 100; ++t) {
        std::vector<float> g = random_floats(16, 100 + static_cast<std::uint64_t>(t));
        for (float& one : g) one += 0.3f;
        const double a = 0.01 / (1 + t / 50);
        for (std::size_t i = 0; i < 16; ++i) scalars[i].step(double{g[i]}, a);
        all.step(g, a);
      }
      for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(all.x[i], scalars[i].x, 1e-5) << i;
      return all.x;
    });
  }
}

TEST(Optimiser, GoesOnBitForBitAfterSaving) {
  for (const Kind kind : kinds) {
    const OptimiserSettings how{.kind = kind};
    Vector16 whole(how, random_floats(16, 1));
    const auto go_on = [&](Vector16& it, std::uint64_t from) {
      for (std::uint64_t t = from; t < from + 10; ++t) it.step(random_floats(16, t), 1e-3);
    };
    go_on(whole, 0);
    Archive saved;
    whole.optimiser.persist(saved);
    Vector16 resumed(how, whole.x);
    Archive loaded(saved.bytes());
    resumed.optimiser.persist(loaded);
    EXPECT_TRUE(loaded.good() && loaded.at_end());
    EXPECT_EQ(resumed.optimiser.steps(), 10u);
    go_on(whole, 10);
    go_on(resumed, 10);
    EXPECT_EQ(resumed.x, whole.x) << optimiser_names[static_cast<std::size_t>(kind)];
  }
}

TEST(Optimiser, RefusesWhatWasSavedForAnotherSize) {
  Optimiser small({}, 16), large({}, 32);
  Archive saved;
  small.persist(saved);
  Archive loaded(saved.bytes());
  large.persist(loaded);
  EXPECT_FALSE(loaded.good());
}

TEST(Optimiser, LeavesPaddingAtZero) {
  for (const Kind kind : kinds) {
    Vector16 it({.kind = kind}, std::vector(16, 0.0f));
    for (int t = 0; t < 20; ++t) it.step({1.0f}, 0.1);
    EXPECT_LT(it.x[0], 0.0f);
    EXPECT_EQ(std::vector(it.x.begin() + 1, it.x.end()), std::vector(15, 0.0f));
  }
}

// Where gradients have stopped, running means reach 0, never the slow numbers beside it.
TEST(Optimiser, MeansEndAtZero) {
  on_every_target([] {
    std::vector<float> x(16), g(16, 0.5F), mean(16), square(16);
    const auto all_well = [&] {
      for (const std::vector<float>* of : {&mean, &square}) {
        for (const float one : *of) {
          if (one != 0.0F && !std::isnormal(one)) return false;
        }
      }
      return true;
    };
    for (const bool rms : {false, true}) {
      bool well = true;
      for (int t = 0; t < 3000; ++t) {
        std::fill(g.begin(), g.end(), t == 0 ? 0.5F : 0.0F);
        if (rms) {
          arithmetic().rmsprop(x.data(), g.data(), mean.data(), square.data(), 16,
                               {0.05F, 1e-3F, 0.01F, true});
        } else {
          arithmetic().adam(x.data(), g.data(), mean.data(), square.data(), 16,
                            {0.1F, 0.1F, 1e-3F, 1.0F, 1e-8F});
        }
        well = well && all_well();
      }
      EXPECT_TRUE(well);
      EXPECT_EQ(mean, std::vector<float>(16));
      EXPECT_EQ(square, std::vector<float>(16));
    }
  });
}

TEST(ClipNorm, ScalesToTheLimitAndTellsTheNormBefore) {
  on_every_target([] {
    std::vector<float> g(16);
    g[3] = 3.0f, g[15] = -4.0f;
    EXPECT_EQ(clip_norm(g, 0.0), 5.0);
    EXPECT_EQ(clip_norm(g, 5.0), 5.0);
    EXPECT_EQ(g[3], 3.0f);
    EXPECT_EQ(clip_norm(g, 2.5), 5.0);
    EXPECT_NEAR(g[3], 1.5, 1e-6);
    EXPECT_NEAR(g[15], -2.0, 1e-6);
    g[0] = std::nanf("");
    EXPECT_TRUE(std::isnan(clip_norm(g, 2.5)));
  });
}

}  // namespace
}  // namespace quoll::nn
