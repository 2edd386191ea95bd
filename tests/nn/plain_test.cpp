#include "quoll/nn/plain.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace quoll::nn {
namespace {

// 2 x 1 places of 2 numbers, 3 filters of one place, then a dense layer of 2 outputs: of the 16
// columns of each row 3 and 2 are real, and of the 32 rows that the dense layer reads 6.
TEST(Plain, LeavesThePaddingOut) {
  NetworkSpec spec;
  spec.input = {2, 1, 2};
  spec.body = {{.units = 3, .kernel = 1, .normalisation = Normalisation::channels}};
  spec.heads = {{{.units = 2, .activation = Activation::none}}};
  const Network network = *Network::make(spec);
  std::vector<float> parameters(network.parameters());
  for (std::size_t i = 0; i < parameters.size(); ++i) parameters[i] = static_cast<float>(i);
  const PlainNetwork out = plain(network, parameters);
  const PlainLayer& filters = out.body.at(0);
  EXPECT_EQ(filters.weights, (std::vector<float>{0, 1, 2, 16, 17, 18}));
  EXPECT_EQ(filters.bias, (std::vector<float>{32, 33, 34}));
  EXPECT_EQ(filters.gain, (std::vector<float>{48, 49, 50}));
  EXPECT_EQ(filters.shift, (std::vector<float>{64, 65, 66}));
  EXPECT_EQ(filters.in.size(), 4u);
  EXPECT_EQ(filters.out.size(), 6u);
  const PlainLayer& dense = out.heads.at(0).at(0);
  EXPECT_EQ(dense.in.size(), 6u);
  EXPECT_EQ(dense.out.size(), 2u);
  // Rows 0, 1, 2 of the first place and 16, 17, 18 of the second one, from 80 on.
  EXPECT_EQ(dense.weights,
            (std::vector<float>{80, 81, 96, 97, 112, 113, 336, 337, 352, 353, 368, 369}));
  EXPECT_EQ(dense.bias, (std::vector<float>{592, 593}));
  EXPECT_TRUE(dense.gain.empty());
}

}  // namespace
}  // namespace quoll::nn
