// What one call of a policy costs: it is noexcept, allocates nothing, and takes about as long as
// the load it is.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <quoll/quoll.hpp>

static long allocations = 0;

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

int main() {
  const quoll::Learned learned = quoll::learn(quoll::world("adventure"));
  const quoll::TablePolicy& policy = learned.policy();
  static_assert(noexcept(policy(0)));

  constexpr int calls = 10'000'000;
  const auto states = static_cast<quoll::State>(learned.world().traits.states);
  const long before = allocations;
  const auto begun = std::chrono::steady_clock::now();
  quoll::State state = 0;
  unsigned sum = 0;
  for (int i = 0; i < calls; ++i) {
    const quoll::Action action = policy(state);
    sum += action == quoll::no_action ? 0 : action + 1;
    state = state + 1 == states ? 0 : state + 1;
  }
  const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begun;
  std::printf("%d calls, %ld allocations, %.2f ns per call (sum of actions %u)\n", calls,
              allocations - before, time.count() / calls, sum);
  return allocations == before ? 0 : 1;
}
