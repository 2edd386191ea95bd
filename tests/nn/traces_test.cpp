#include "quoll/nn/traces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/nn/targets.hpp"

namespace quoll::nn {
namespace {

// Two steps by hand: z = (1, -2, 0, ...), then 0.5 z + (1, 1, 0, ...) = (1.5, 0, 0, ...).
TEST(Traces, DecayTakeUpTheGradientAndAreFollowed) {
  on_every_target([] {
    std::vector<float> x(16), g(16);
    Traces traces(16);
    g[0] = 1.0F;
    g[1] = -2.0F;
    // M = 1 * 2 * max(0.5, 1) * 3 = 6: a sixth of the step.
    EXPECT_DOUBLE_EQ(traces.step(x, g, {.decay = 0.9, .delta = 0.5}), 1.0 / 6);
    EXPECT_FLOAT_EQ(x[0], 0.5F / 6);
    EXPECT_FLOAT_EQ(x[1], -1.0F / 6);
    EXPECT_EQ(x[2], 0.0F);
    g[1] = 1.0F;
    x = std::vector<float>(16);
    // M = 0.01 * 2 * 4 * 1.5 = 0.12: the step as it is.
    EXPECT_DOUBLE_EQ(traces.step(x, g, {.decay = 0.5, .delta = -4.0, .step_size = 0.01}), 0.01);
    EXPECT_FLOAT_EQ(x[0], -0.06F);
    EXPECT_EQ(x[1], 0.0F);
    traces.clear();
    x = std::vector<float>(16);
    g[0] = 0.0F;
    traces.step(x, g, {.decay = 1.0, .delta = 1.0, .step_size = 0.1});
    EXPECT_EQ(x[0], 0.0F);
    EXPECT_FLOAT_EQ(x[1], 0.1F);
  });
}

// Whatever the error, a step of a linear value corrects at most 1 / kappa of it.
TEST(Traces, NeverCorrectMoreThanTheBoundAllows) {
  for (const double delta : {1e-3, 0.7, 30.0, -1e6}) {
    std::vector<float> x(5008);
    const std::vector<float> g = random_floats(5008, 3);
    Traces traces(5008);
    traces.step(x, g, {.decay = 0.0, .delta = delta});
    double moved = 0.0;
    for (std::size_t i = 0; i < g.size(); ++i) moved += double{g[i]} * double{x[i]};
    EXPECT_GT(moved / delta, 0.0);
    EXPECT_LE(moved / delta, 0.5);
  }
}

TEST(Traces, AddUpInAnOrderThatNoVectorWidthChanges) {
  same_bits_where_fused([] {
    std::vector<float> z = random_floats(10'000, 1);
    const std::vector<float> g = random_floats(10'000, 2);
    double exact = 0.0;
    const double sum = arithmetic().trace(z.data(), g.data(), z.size(), 0.72F);
    for (const float one : z) exact += std::fabs(double{one});
    EXPECT_NEAR(sum, exact, 1e-6 * exact);
    z[0] = static_cast<float>(sum);
    return z;
  });
}

}  // namespace
}  // namespace quoll::nn
