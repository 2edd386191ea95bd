#pragma once
// The only place that starts threads. The work is cut into parts by number, never by time, so
// results do not depend on how many threads there are.

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

namespace quoll {

/// Number of threads a run uses when none is asked for: the processors this process may run on.
unsigned processors();

/// Calls work(part) once for each part in [0, parts), on at most `threads` threads (0 =
/// processors()). Returns when all are done. The threads stay for the next call, which therefore
/// costs about half a microsecond when it follows soon; the first parts tend to be done by the same
/// thread each time. A call from within `work`, or while another thread's call is under way, does
/// all parts on the thread it comes from, as without thread support (WebAssembly).
void parallel_for(std::size_t parts, unsigned threads,
                  const std::function<void(std::size_t)>& work);

/// Threads that do one work together, step by step: for steps of a few microseconds.
class Team {
 public:
  /// Calls work(team, member) for each member in [0, team.size()) at the same time, each on a
  /// thread of its own, and returns when all are done. At most `threads` of them (0 =
  /// processors()), never more than processors(), for they wait for each other at every step, and
  /// as many as come within a millisecond: maybe the caller alone.
  static void gather(unsigned threads, const std::function<void(Team&, unsigned)>& work);

  explicit Team(unsigned size) : rounds_(size) {}
  unsigned size() const { return static_cast<unsigned>(rounds_.size()); }

  /// Waits until all members have come here: about 0.1 microseconds for two. What each did before
  /// is seen by all after.
  void meet(unsigned member);

 private:
  struct alignas(64) Round {
    std::atomic<unsigned> number{0};
  };
  std::vector<Round> rounds_;  // per member: the meetings it has come to
};

}  // namespace quoll
