#pragma once
// What a run says while it goes on: one number at a time, to whoever listens.

#include <cstdint>
#include <functional>
#include <string_view>

namespace quoll {

struct Record {
  std::uint64_t step = 0;
  std::uint32_t lane = 0;  ///< index of the seed
  std::string_view name;   ///< "episodic_return", "episodes"
  double value = 0.0;
};

/// Terminal, CSV, TensorBoard, Python and the web page are sinks. Called from one thread at a time.
using Sink = std::function<void(const Record&)>;

}  // namespace quoll
