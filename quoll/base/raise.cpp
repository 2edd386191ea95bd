#include "quoll/base/raise.hpp"

#include <cstdio>
#include <cstdlib>

namespace quoll {

void raise(const Error& error) {
#if defined(__cpp_exceptions)
  throw Exception(error);
#else
  std::fputs((message(error) + "\n").c_str(), stderr);
  std::abort();
#endif
}

}  // namespace quoll
