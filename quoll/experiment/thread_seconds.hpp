#pragma once

namespace quoll {

/// Processor seconds of this thread: other threads and programs do not count. Where the system does
/// not tell them, seconds on the clock.
double thread_seconds();

}  // namespace quoll
