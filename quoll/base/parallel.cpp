#include "quoll/base/parallel.hpp"

#if !defined(__wasi__)
#include <pthread.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <vector>
#endif

namespace quoll {

#if defined(__wasi__)

unsigned processors() {
  return 1;
}

void parallel_for(std::size_t parts, unsigned, const std::function<void(std::size_t)>& work) {
  for (std::size_t part = 0; part < parts; ++part) work(part);
}

#else

namespace {

/// What the threads of one call share. Who takes which part is a matter of time, and therefore must
/// not matter to `work`.
struct Shared {
  const std::function<void(std::size_t)>& work;
  std::size_t parts;
  std::atomic<std::size_t> next{0};

  void run() {
    for (std::size_t part = next++; part < parts; part = next++) work(part);
  }
};

void* run_shared(void* shared) {
  static_cast<Shared*>(shared)->run();
  return nullptr;
}

}  // namespace

unsigned processors() {
#if defined(__linux__)
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) == 0) {
    return static_cast<unsigned>(std::max(CPU_COUNT(&allowed), 1));
  }
#endif
  return static_cast<unsigned>(std::max(::sysconf(_SC_NPROCESSORS_ONLN), 1L));
}

void parallel_for(std::size_t parts, unsigned threads,
                  const std::function<void(std::size_t)>& work) {
  if (threads == 0) threads = processors();
  const std::size_t crew = std::min<std::size_t>(threads, parts);
  Shared shared{work, parts};
  // std::thread ends the program when the system has no thread left; here the others take the
  // parts.
  std::vector<pthread_t> others;
  if (crew > 1) others.reserve(crew - 1);
  while (others.size() + 1 < crew) {
    pthread_t other;
    if (::pthread_create(&other, nullptr, run_shared, &shared) != 0) break;
    others.push_back(other);
  }
  shared.run();
  for (const pthread_t other : others) ::pthread_join(other, nullptr);
}

#endif

}  // namespace quoll
