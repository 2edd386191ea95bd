#pragma once
// What is to be backed up, the most urgent first. An entry that was overtaken is skipped when its
// turn comes.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "quoll/base/archive.hpp"

namespace quoll {

class BackupQueue {
 public:
  explicit BackupQueue(std::uint64_t items = 0) : priority_(items, 0.0) {}

  /// Raises the priority of an item; a lower one than it has changes nothing.
  void push(std::uint32_t item, double priority) {
    if (!(priority > priority_[item])) return;
    priority_[item] = priority;
    heap_.push_back({priority, item});
    std::push_heap(heap_.begin(), heap_.end(), later);
  }
  /// False when nothing is left.
  bool pop(std::uint32_t& item) {
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), later);
      const Entry top = heap_.back();
      heap_.pop_back();
      if (priority_[top.item] != top.priority) continue;
      priority_[top.item] = 0.0;
      item = top.item;
      return true;
    }
    return false;
  }
  void clear() {
    for (const Entry& entry : heap_) priority_[entry.item] = 0.0;
    heap_.clear();
  }
  void persist(Archive& archive) {
    const std::size_t items = priority_.size();
    archive("priority", priority_);
    archive("heap", heap_);
    bool fits = priority_.size() == items;
    for (const Entry& entry : heap_) fits = fits && entry.item < items;
    if (fits) return;
    archive.fail("a queue of another world");
    *this = BackupQueue(items);
  }

 private:
  struct Entry {
    double priority = 0.0;
    std::uint32_t item = 0;
    void persist(Archive& archive) {
      archive("priority", priority);
      archive("item", item);
    }
  };
  static bool later(const Entry& left, const Entry& right) {
    return left.priority != right.priority ? left.priority < right.priority
                                           : left.item > right.item;
  }

  std::vector<double> priority_;  // 0 = not in the queue
  std::vector<Entry> heap_;
};

}  // namespace quoll
