#include "quoll/learn/tabular/way_to_unknown.hpp"

#include <algorithm>

namespace quoll {

// The heap's order: larger excess, then longer ways, then those found later come later.
bool WayToUnknown::later(std::uint32_t a, std::uint32_t b) const {
  const Label &left = labels_[a], &right = labels_[b];
  if (left.excess != right.excess) return left.excess > right.excess;
  return left.steps != right.steps ? left.steps > right.steps : a > b;
}

void WayToUnknown::push(const Label& label) {
  labels_.push_back(label);
  heap_.push_back(static_cast<std::uint32_t>(labels_.size() - 1));
  std::push_heap(heap_.begin(), heap_.end(),
                 [this](std::uint32_t a, std::uint32_t b) { return later(a, b); });
}

std::uint32_t WayToUnknown::pop() {
  std::pop_heap(heap_.begin(), heap_.end(),
                [this](std::uint32_t a, std::uint32_t b) { return later(a, b); });
  const std::uint32_t top = heap_.back();
  heap_.pop_back();
  return top;
}

void WayToUnknown::trace(std::uint32_t label) {
  for (; labels_[label].steps > 0; label = labels_[label].parent) {
    way_.push_back(labels_[label].pair);
  }
  std::reverse(way_.begin(), way_.end());
}

const std::vector<std::uint64_t>& WayToUnknown::find(const CountedModel& model,
                                                     const std::vector<std::uint64_t>& begin,
                                                     State from, double best, double discount) {
  way_.clear();
  labels_.clear();
  heap_.clear();
  if (++search_ == 0) {
    std::fill(met_.begin(), met_.end(), 0u);
    search_ = 1;
  }
  Label first;
  first.state = from;
  push(first);
  while (!heap_.empty()) {
    const std::uint32_t top = pop();
    const Label here = labels_[top];
    if (here.state == the_end) {
      trace(top);
      return way_;
    }
    if (met_[here.state] == search_) continue;
    met_[here.state] = search_;
    for (std::uint64_t pair = begin[here.state]; pair < begin[here.state + 1]; ++pair) {
      if (model.tried(pair) == 0) {
        trace(top);
        way_.push_back(pair);
        return way_;
      }
      model.each(pair, [&](const CountedModel::Outcome& seen) {
        const bool end = seen.next == the_end;
        if (!end && met_[seen.next] == search_) return;
        const double step = best - seen.mean_reward() - (end ? 0.0 : discount * best);
        push({here.excess + here.factor * step, here.factor * discount, here.steps + 1, top,
              seen.next, pair});
      });
    }
  }
  return way_;
}

}  // namespace quoll
