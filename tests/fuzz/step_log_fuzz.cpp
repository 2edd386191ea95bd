#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "quoll/model/formats/step_log.hpp"

// Any bytes give rows, and one Error with a sentence at the first that is none.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  quoll::Lines lines(std::string_view(reinterpret_cast<const char*>(data), size));
  quoll::StepLog log(lines, "fuzz.csv");
  quoll::LoggedStep step;
  std::size_t rows = 0;
  while (log.next(step)) {
    if (step.state.empty() || step.action.empty() || ++rows > size) std::abort();
    if (step.next_state.empty() && !step.terminated) std::abort();
  }
  if (log.error() && log.error()->expected.empty()) std::abort();
  return log.next(step) ? std::abort(), 0 : 0;
}
