#pragma once
// Curves for TensorBoard: an event file is a TFRecord file (each record: length, data, and a masked
// CRC-32C of both) of tensorflow.Event messages in protocol buffers' encoding. Written byte by
// byte: no library of either is needed.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace quoll {

/// One point of a curve.
struct Scalar {
  std::string_view tag;  ///< "charts/episodic_return"
  std::uint64_t step = 0;
  double wall_time = 0.0;  ///< seconds, of whatever clock
  float value = 0.0F;
};

/// The bytes of an event file. TensorBoard reads files whose name contains "tfevents", each folder
/// as a run of its own.
std::string tensorboard_events(std::span<const Scalar> scalars);

}  // namespace quoll
