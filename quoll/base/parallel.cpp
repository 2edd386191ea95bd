#include "quoll/base/parallel.hpp"

#if !defined(__wasi__)
#include <pthread.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>
#endif

namespace quoll {

#if defined(__wasi__)

unsigned processors() {
  return 1;
}

void parallel_for(std::size_t parts, unsigned, const std::function<void(std::size_t)>& work) {
  for (std::size_t part = 0; part < parts; ++part) work(part);
}

void Team::gather(unsigned, const std::function<void(Team&, unsigned)>& work) {
  Team team(1);
  work(team, 0);
}

void Team::meet(unsigned) {}

#else

namespace {

/// What threads come to do: each sits on a seat of its own, the caller on seat 0.
class Table {
 public:
  virtual ~Table() = default;
  virtual void sit(unsigned seat) = 0;
};

void pause_briefly() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

/// Threads that stay, and wait for a table with free seats.
class Crew {
 public:
  /// Offers seats 1, 2, .., taken in that order, to as many threads as there are for them, and
  /// returns how many are offered; 0 = none, as where another table is open.
  unsigned open(Table& table, unsigned seats) {
    if (seats == 0 || busy_.exchange(true, std::memory_order_acquire)) return 0;
    seats = std::min(seats, hire(seats));
    if (seats == 0) {
      busy_.store(false, std::memory_order_release);
      return 0;
    }
    table_ = &table;
    seats_ = seats;
    spins_ = seats < processors() ? most_spins : 0;
    state_.store(seats * seat, std::memory_order_release);
    state_.notify_all();
    return seats;
  }
  /// Waits a millisecond at most for all seats to be taken and closes; returns how many were.
  unsigned late_ones_out() {
    for (unsigned i = 0; i < 20 * most_spins && state_.load(std::memory_order_acquire) >= seat;
         ++i) {
      pause_briefly();
    }
    return close();
  }
  /// From now on nobody can sit down; returns how many seats were taken.
  unsigned close() { return seats_ - state_.fetch_and(seat - 1, std::memory_order_acq_rel) / seat; }
  /// Waits until all have left a closed table.
  void clear() {
    for (std::uint32_t now = state_.load(std::memory_order_acquire); now != 0;) now = changed(now);
    busy_.store(false, std::memory_order_release);
  }

 private:
  // state_: the threads that sit, and the seats still free in units of `seat`.
  static constexpr std::uint32_t seat = 1 << 16;
  static constexpr unsigned most_spins = 2000;  // some 50 us: a sweep follows a sweep

  // The state once it is no longer `seen`.
  std::uint32_t changed(std::uint32_t seen) const {
    for (unsigned i = spins_.load(std::memory_order_relaxed); i > 0; --i) {
      const std::uint32_t now = state_.load(std::memory_order_acquire);
      if (now != seen) return now;
      pause_briefly();
    }
    state_.wait(seen, std::memory_order_acquire);
    return state_.load(std::memory_order_acquire);
  }

  // Sees to it that there are so many threads, and returns how many there are: std::thread would
  // end the program when the system has none left.
  unsigned hire(unsigned wanted) {
    for (pthread_t thread; hired_ < wanted; ++hired_) {
      if (::pthread_create(&thread, nullptr, serve, this) != 0) break;
      ::pthread_detach(thread);
    }
    return hired_;
  }

  static void* serve(void* crew) {
    static_cast<Crew*>(crew)->serve();
    return nullptr;
  }
  [[noreturn]] void serve() {
    std::uint32_t now = state_.load(std::memory_order_acquire);
    while (true) {
      if (now < seat) {
        now = changed(now);
      } else if (state_.compare_exchange_weak(now, now - seat + 1, std::memory_order_acq_rel)) {
        table_->sit(seats_ + 1 - now / seat);
        now = state_.fetch_sub(1, std::memory_order_acq_rel) - 1;
        if (now == 0) state_.notify_all();
      }
    }
  }

  std::atomic<bool> busy_{false};
  std::atomic<std::uint32_t> state_{0};
  std::atomic<unsigned> spins_{0};
  Table* table_ = nullptr;
  unsigned seats_ = 0, hired_ = 0;
};

Crew& crew() {
  static Crew& one = *new Crew;  // its threads outlive every destructor
  return one;
}

constexpr std::size_t most_threads = 1000;

// Seats for others beside the caller's.
unsigned seats_for(unsigned threads, std::size_t parts) {
  if (parts == 0) return 0;
  const std::size_t wanted = threads == 0 ? processors() : threads;
  return static_cast<unsigned>(std::min({wanted, parts, most_threads}) - 1);
}

/// The parts of one call of parallel_for. Each thread begins with the part of its seat; who takes
/// which of the others is a matter of time, and therefore must not matter to `work`.
class Parts : public Table {
 public:
  Parts(std::size_t count, const std::function<void(std::size_t)>& work)
      : work_(work), count_(count) {}

  void run(unsigned threads) {
    const unsigned seats = seats_for(threads, count_);
    next_ = 1 + seats;
    const unsigned offered = crew().open(*this, seats);
    sit(0);
    const unsigned taken = offered > 0 ? crew().close() : 0;
    for (unsigned seat = taken + 1; seat <= seats; ++seat) sit(seat);  // nobody came for those
    if (offered > 0) crew().clear();
  }
  void sit(unsigned seat) override {
    for (std::size_t part = seat; part < count_; part = next_++) work_(part);
  }

 private:
  const std::function<void(std::size_t)>& work_;
  std::size_t count_;
  std::atomic<std::size_t> next_{0};
};

}  // namespace

unsigned processors() {
  static const unsigned number = [] {
#if defined(__linux__)
    cpu_set_t allowed;
    if (::sched_getaffinity(0, sizeof allowed, &allowed) == 0) {
      return static_cast<unsigned>(std::max(CPU_COUNT(&allowed), 1));
    }
#endif
    return static_cast<unsigned>(std::max(::sysconf(_SC_NPROCESSORS_ONLN), 1L));
  }();
  return number;
}

void parallel_for(std::size_t parts, unsigned threads,
                  const std::function<void(std::size_t)>& work) {
  Parts(parts, work).run(threads);
}

namespace {

/// Members sit down, hear how many they are, and work.
class Gathering : public Table {
 public:
  explicit Gathering(const std::function<void(Team&, unsigned)>& work) : work_(work) {}

  void run(unsigned threads) {
    const unsigned offered = crew().open(*this, seats_for(threads, processors()));
    team_.emplace(1 + (offered > 0 ? crew().late_ones_out() : 0));
    ready_.store(true, std::memory_order_release);
    sit(0);
    if (offered > 0) crew().clear();
  }
  void sit(unsigned seat) override {
    while (!ready_.load(std::memory_order_acquire)) pause_briefly();
    work_(*team_, seat);
  }

 private:
  const std::function<void(Team&, unsigned)>& work_;
  std::optional<Team> team_;
  std::atomic<bool> ready_{false};
};

}  // namespace

void Team::gather(unsigned threads, const std::function<void(Team&, unsigned)>& work) {
  Gathering(work).run(threads);
}

void Team::meet(unsigned member) {
  constexpr unsigned patience = 20'000;
  const unsigned now = rounds_[member].number.load(std::memory_order_relaxed) + 1;
  rounds_[member].number.store(now, std::memory_order_release);
  for (const Round& other : rounds_) {
    unsigned spins = 0;
    // The other may be a meeting ahead already.
    while (static_cast<int>(other.number.load(std::memory_order_acquire) - now) < 0) {
      if (++spins < patience) {
        pause_briefly();
      } else {
        ::sched_yield();  // it has no processor
      }
    }
  }
}

#endif

}  // namespace quoll
