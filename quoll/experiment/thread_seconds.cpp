#include "quoll/experiment/thread_seconds.hpp"

#include <ctime>

namespace quoll {

double thread_seconds() {
  timespec now{};
#if defined(CLOCK_THREAD_CPUTIME_ID) && !defined(__wasi__)
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
#else
  clock_gettime(CLOCK_MONOTONIC, &now);
#endif
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

}  // namespace quoll
