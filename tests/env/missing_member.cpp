// Not part of the tests' program: compiled by missing_member.sh with one member taken away each
// time.
#include "quoll/env/dynamics.hpp"

struct Corridor {
#if MISSING != 1
  using Position = int;
#endif
#if MISSING != 2
  quoll::Spaces spaces() const { return {.actions = 2, .states = 10}; }
#endif
#if MISSING != 3
  int start(auto&) const { return 0; }
#endif
#if MISSING != 4
  quoll::Feedback step(int&, quoll::Action, auto&) const { return {}; }
#endif
#if MISSING != 5
  quoll::State number(const int&) const { return 0; }
#endif
};

int main() {
  return quoll::to_world("corridor", Corridor{}, 0.9).discount < 1.0 ? 0 : 1;
}
