#pragma once
// What a run says while it goes on: one number at a time, to whoever listens.

#include <cstdint>
#include <functional>
#include <string_view>

namespace quoll {

struct Record {
  std::uint64_t step = 0;
  std::uint32_t lane = 0;  ///< index of the seed
  /// "episodic_return", "episodes"; of learners that know no table also "processor_seconds" so far,
  /// and what they measure, "td_loss", "q_values", as means since the last record.
  std::string_view name;
  double value = 0.0;
};

/// Terminal, CSV, TensorBoard, Python and the web page are sinks. Called from one thread at a time.
using Sink = std::function<void(const Record&)>;

}  // namespace quoll
