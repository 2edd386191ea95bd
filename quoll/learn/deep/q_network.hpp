#pragma once
// Q by a network of ours, in each of the lecture's layouts.

#include <memory>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/learn/deep/deep_setup.hpp"
#include "quoll/learn/deep/q_function.hpp"

namespace quoll {

/// The network that the setup describes. `rows` = most rows of a batch; `target` = whether target
/// weights are kept. Error: it cannot be built.
Result<std::unique_ptr<QFunction>> make_q_network(const DeepSetup& deep, std::uint64_t seed,
                                                  std::size_t rows, bool target);

/// What make_q_network would build. Duelling splits the last hidden layer and the outputs into a
/// value and advantages (Wang et al. 2016, equation 9).
nn::NetworkSpec network_spec(const DeepSetup& deep);

}  // namespace quoll
