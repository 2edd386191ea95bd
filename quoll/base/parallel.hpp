#pragma once
// The only place that starts threads. The work is cut into parts by number, never by time, so
// results do not depend on how many threads there are.

#include <cstddef>
#include <functional>

namespace quoll {

/// Number of threads a run uses when none is asked for: the processors this process may run on.
unsigned processors();

/// Calls work(part) once for each part in [0, parts), on at most `threads` threads (0 =
/// processors()). Returns when all are done. Serial without thread support (WebAssembly).
void parallel_for(std::size_t parts, unsigned threads,
                  const std::function<void(std::size_t)>& work);

}  // namespace quoll
