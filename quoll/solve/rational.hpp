#pragma once
// Fractions without rounding, always in lowest terms with a denominator above 0. A thin cover over
// GMP's mpq (GNU MP manual 6.2, chapter 6); only builds that found GMP define these functions.

#include <cstdint>
#include <string>

#include "quoll/solve/integer.hpp"

namespace quoll {

class Rational {
 public:
  Rational() : Rational(0) {}
  explicit Rational(std::int64_t whole);
  /// numerator / denominator; the denominator is not 0.
  Rational(const Integer& numerator, const Integer& denominator);
  Rational(const Rational& other);
  Rational(Rational&& other) noexcept;
  Rational& operator=(const Rational& other);
  Rational& operator=(Rational&& other) noexcept;
  ~Rational();

  Rational& operator+=(const Rational& other);
  Rational& operator-=(const Rational& other);
  Rational& operator*=(const Rational& other);
  /// The divisor is not 0.
  Rational& operator/=(const Rational& other);
  Rational& operator*=(const Integer& other);
  Rational& operator/=(const Integer& other);
  void negate();

  int sign() const;
  /// Below 0, 0 or above 0 as *this is less than, equal to or greater than `other`.
  int compare(const Rational& other) const;
  int compare(double other) const;  ///< `other` is finite
  Integer numerator() const;
  Integer denominator() const;
  /// The double next to 0 from here: the number rounded towards 0.
  double towards_zero() const;

 private:
  alignas(8) unsigned char number_[32];  // an mpq_t
};

}  // namespace quoll
