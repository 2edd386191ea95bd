#include "quoll/cli/learn_explain.hpp"

namespace quoll::cli {

Exit learn_explained(Run&, const RunSettings&, const OutputOption&) {
  return fail({"--explain", 0, 0, "is being built", ""});
}

}  // namespace quoll::cli
