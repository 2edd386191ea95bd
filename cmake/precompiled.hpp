// What nearly every source includes, read once per tree (quoll_precompile in
// cmake/QuollFloors.cmake). Nothing may lean on it: the library is also compiled without (./dev
// check).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
