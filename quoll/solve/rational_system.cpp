#include "quoll/solve/rational_system.hpp"

#ifdef QUOLL_GMP

#include <algorithm>
#include <cstdint>
#include <utility>

// Elimination without fractions: rows of I - P hold whole numbers, and a common divisor leaves its
// row at once (Bareiss 1968 on why they stay small: they divide minors of the matrix). The right
// side keeps fractions, of which there is one per row. I - P is an M-matrix, so that every diagonal
// element serves as pivot, and the cheapest can go first (Markowitz 1957); a diagonal that becomes
// 0 means a set of states that is never left.
//
//   1  row i of I - P times the common denominator of its elements
//   2  take the open k whose row and column hold least
//      for each open i with a(i,k) != 0:  row i <- a(k,k)/d row i - a(i,k)/d row k,
//      d = gcd(a(k,k), a(i,k)); divide row i by its content
//   3  from the last k to the first: x_k <- (b(k) - sum_j a(k,j) x_j) / a(k,k)

namespace quoll {

namespace {

// Divides a row by the greatest divisor of its elements.
void divide_by_content(std::map<std::size_t, Integer>& row, Rational& right) {
  Integer content;
  for (const auto& [j, a] : row) {
    content = gcd(content, a);
    if (content.is_one()) return;
  }
  if (content.sign() == 0) return;
  for (auto& [j, a] : row) a.divide_exactly(content);
  right /= content;
}

}  // namespace

void RationalSystem::set_row(std::size_t i, const std::map<std::size_t, Rational>& p, Rational b) {
  Integer common(1);
  for (const auto& [j, share] : p) common = lcm(common, share.denominator());
  row_[i].emplace(i, common);
  for (const auto& [j, share] : p) {
    Integer scaled = share.numerator();
    Integer factor = common;
    factor.divide_exactly(share.denominator());
    const auto place = row_[i].try_emplace(j, 0).first;
    place->second.subtract_product(scaled, factor);
    if (j != i) column_[j].insert(i);
  }
  right_[i] = std::move(b);
  right_[i] *= common;
  divide_by_content(row_[i], right_[i]);
}

std::size_t RationalSystem::cheapest(const std::set<std::size_t>& open) const {
  std::size_t best = *open.begin();
  std::uint64_t least = ~std::uint64_t{0};
  for (const std::size_t k : open) {
    const std::uint64_t cost = std::uint64_t{row_[k].size() - 1} * column_[k].size();
    if (cost < least) {
      least = cost;
      best = k;
    }
    if (cost == 0) break;
  }
  return best;
}

bool RationalSystem::eliminate(std::size_t k) {
  const auto& pivot_row = row_[k];
  const Integer& pivot = pivot_row.at(k);
  if (pivot.sign() == 0) return false;
  for (const auto& [j, a] : pivot_row) {
    if (j != k) column_[j].erase(k);
  }
  for (const std::size_t i : column_[k]) {
    auto& row = row_[i];
    Integer by_pivot = std::move(row.at(k));
    row.erase(k);
    const Integer common = gcd(pivot, by_pivot);
    Integer by_row = pivot;
    by_row.divide_exactly(common);
    by_pivot.divide_exactly(common);
    for (auto& [j, a] : row) a *= by_row;
    for (const auto& [j, a] : pivot_row) {
      if (j == k) continue;
      row.try_emplace(j, 0).first->second.subtract_product(by_pivot, a);
      if (j != i) column_[j].insert(i);
    }
    right_[i] *= by_row;
    Rational part = right_[k];
    part *= by_pivot;
    right_[i] -= part;
    divide_by_content(row, right_[i]);
  }
  column_[k].clear();
  return true;
}

RationalSystem::Outcome RationalSystem::solve(std::vector<Rational>& x,
                                              const std::function<bool(std::size_t)>& keep_going) {
  std::set<std::size_t> open;
  for (std::size_t k = 0; k < row_.size(); ++k) open.insert(open.end(), k);
  std::vector<std::size_t> order;
  while (!open.empty()) {  // step 2
    const std::size_t k = cheapest(open);
    if (!eliminate(k)) return Outcome::endless;
    open.erase(k);
    order.push_back(k);
    if (!keep_going(order.size())) return Outcome::stopped;
  }
  x.assign(row_.size(), Rational());
  for (auto place = order.rbegin(); place != order.rend(); ++place) {  // step 3
    const std::size_t k = *place;
    Rational sum = std::move(right_[k]);
    for (const auto& [j, a] : row_[k]) {
      if (j == k) continue;
      Rational part = x[j];
      part *= a;
      sum -= part;
    }
    sum /= row_[k].at(k);
    x[k] = std::move(sum);
  }
  return Outcome::solved;
}

}  // namespace quoll

#endif
