#pragma once
// A long list of numbers of which few differ, as probabilities of grids and games: one byte each
// while there are at most 256 different ones, eight bytes after that.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <vector>

namespace quoll {

class Column {
 public:
  Column() = default;
  Column(std::initializer_list<double> values) : Column(std::vector<double>(values)) {}
  // NOLINTNEXTLINE(google-explicit-constructor): a list of numbers is a column
  Column(const std::vector<double>& values) {
    for (const double value : values) push_back(value);
  }

  std::size_t size() const { return coded() ? code_.size() : plain_.size(); }
  bool empty() const { return size() == 0; }
  double operator[](std::size_t i) const { return coded() ? table_[code_[i]] : plain_[i]; }
  double back() const { return (*this)[size() - 1]; }

  /// Room for as many numbers, if they need a byte each.
  void reserve(std::size_t size) {
    if (coded()) code_.reserve(size);
    if (!coded()) plain_.reserve(size);
  }
  void push_back(double value) {
    if (coded()) {
      const int code = code_of(value);
      if (code >= 0) return code_.push_back(static_cast<std::uint8_t>(code));
      expand();
    }
    plain_.push_back(value);
  }
  void set(std::size_t i, double value) {
    if (coded()) {
      const int code = code_of(value);
      if (code >= 0) {
        code_[i] = static_cast<std::uint8_t>(code);
        return;
      }
      expand();
    }
    plain_[i] = value;
  }
  void assign(std::size_t size, double value) {
    *this = {};
    code_.assign(size, static_cast<std::uint8_t>(code_of(value)));
  }
  /// Keeps the first `size` numbers; size is at most what it was.
  void truncate(std::size_t size) {
    if (coded()) code_.resize(size);
    if (!coded()) plain_.resize(size);
  }
  /// Gives back what was reserved for nothing, if it is much.
  void trim() {
    const auto cut = [](auto& list) {
      if (list.capacity() <= list.size() + list.size() / 64 + 64) return;
      std::remove_reference_t<decltype(list)> exact(list.begin(), list.end());
      list.swap(exact);
    };
    cut(code_);
    cut(plain_);
    release(place_);
  }

  /// For loops that must be fast: one byte each into a table, or doubles.
  bool coded() const { return plain_.empty(); }
  const std::uint8_t* codes() const { return code_.data(); }
  const double* table() const { return table_.data(); }
  const double* plain() const { return plain_.data(); }
  /// How many numbers are in the table, some of which may stand nowhere; 0 if not coded.
  std::size_t different() const { return table_.size(); }

  /// Bytes of memory held.
  std::uint64_t bytes() const {
    return code_.capacity() + plain_.capacity() * sizeof(double) +
           table_.capacity() * sizeof(double) + place_.capacity() * sizeof(std::uint16_t);
  }

  friend bool operator==(const Column& a, const Column& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i] != b[i]) return false;
    }
    return true;
  }

 private:
  static constexpr std::size_t places = 1024;  // of the hash table, at most a quarter full
  static constexpr std::uint16_t free_place = 0xffff;

  // The code of a number, a new one if need be; -1 if there are no more.
  int code_of(double value) {
    if (place_.empty()) {
      place_.assign(places, free_place);
      for (std::size_t i = 0; i < table_.size(); ++i) {
        place_[place_of(table_[i])] = static_cast<std::uint16_t>(i);
      }
    }
    const std::size_t place = place_of(value);
    if (place_[place] != free_place) return place_[place];
    if (table_.size() == 256) return -1;
    place_[place] = static_cast<std::uint16_t>(table_.size());
    table_.push_back(value);
    return place_[place];
  }

  // Where the code of a number stands, or would stand.
  std::size_t place_of(double value) const {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    std::size_t place = (bits * 0x9e3779b97f4a7c15ULL) >> 54;
    while (place_[place] != free_place &&
           std::bit_cast<std::uint64_t>(table_[place_[place]]) != bits) {
      place = (place + 1) % places;
    }
    return place;
  }

  template <class T>
  static void release(std::vector<T>& list) {
    std::vector<T>().swap(list);
  }

  void expand() {
    plain_.reserve(code_.capacity());
    for (const std::uint8_t code : code_) plain_.push_back(table_[code]);
    release(code_);
    release(table_);
    release(place_);
  }

  std::vector<std::uint8_t> code_;
  std::vector<double> table_;         // the number of each code
  std::vector<std::uint16_t> place_;  // hash table of codes; empty while nothing is added
  std::vector<double> plain_;
};

}  // namespace quoll
