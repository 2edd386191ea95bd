#include "quoll/env/environment.hpp"

namespace quoll {
namespace {

Tree nested(const Spaces& spaces, std::span<const float> x, std::size_t level) {
  const bool last = level + 1 >= spaces.shape.size() || spaces.shape[level + 1] == 0;
  const std::size_t count = spaces.shape[level] == 0 ? x.size() : spaces.shape[level];
  Tree::List list;
  for (std::size_t i = 0; i < count; ++i) {
    if (last && spaces.whole) {
      list.emplace_back(static_cast<std::int64_t>(x[i]));
    } else if (last) {
      list.emplace_back(x[i]);
    } else {
      const std::size_t size = x.size() / count;
      list.push_back(nested(spaces, x.subspan(i * size, size), level + 1));
    }
  }
  return Tree(std::move(list));
}

}  // namespace

Tree observation_tree(const Spaces& spaces, std::span<const float> x) {
  return nested(spaces, x, 0);
}

}  // namespace quoll
