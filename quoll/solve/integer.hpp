#pragma once
// Whole numbers of any size. A thin cover over GMP's mpz (GNU MP manual 6.2, chapter 5), whose
// header stays out of this one; only builds that found GMP define these functions.

#include <cstdint>
#include <string>
#include <string_view>

namespace quoll {

class Integer {
 public:
  Integer() : Integer(0) {}
  explicit Integer(std::int64_t value);
  /// Decimal digits with an optional '-' in front, and nothing else.
  explicit Integer(const std::string& digits);
  Integer(const Integer& other);
  Integer(Integer&& other) noexcept;
  Integer& operator=(const Integer& other);
  Integer& operator=(Integer&& other) noexcept;
  ~Integer();

  Integer& operator*=(const Integer& other);
  /// *this -= a * b.
  void subtract_product(const Integer& a, const Integer& b);
  /// Divides by a divisor that leaves no remainder.
  void divide_exactly(const Integer& divisor);
  /// -1, 0 or 1.
  int sign() const;
  bool is_one() const;
  /// Number of binary digits of the size.
  std::uint64_t bits() const;
  std::string text() const;

  friend Integer gcd(const Integer& a, const Integer& b);
  friend Integer lcm(const Integer& a, const Integer& b);
  friend Integer ten_to(std::uint32_t exponent);
  friend class Rational;

 private:
  alignas(8) unsigned char number_[16];  // an mpz_t
};

/// Greatest common divisor, not negative; gcd(0, b) = |b|.
Integer gcd(const Integer& a, const Integer& b);
/// Least common multiple, not negative.
Integer lcm(const Integer& a, const Integer& b);
/// 10 to the power of `exponent`.
Integer ten_to(std::uint32_t exponent);

}  // namespace quoll
