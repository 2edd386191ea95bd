#include "quoll/solve/rational.hpp"

#ifdef QUOLL_GMP

#include <gmp.h>

namespace quoll {

namespace {

mpq_ptr raw(unsigned char* number) {
  return reinterpret_cast<mpq_ptr>(number);
}
mpq_srcptr raw(const unsigned char* number) {
  return reinterpret_cast<mpq_srcptr>(number);
}
mpz_srcptr raw_integer(const unsigned char* number) {
  return reinterpret_cast<mpz_srcptr>(number);
}

}  // namespace

Rational::Rational(std::int64_t whole) {
  static_assert(sizeof(mpq_t) <= sizeof(number_) && alignof(mpq_t) <= 8);
  mpq_init(raw(number_));
  mpq_set_si(raw(number_), whole, 1);
}

Rational::Rational(const Integer& numerator, const Integer& denominator) {
  mpq_init(raw(number_));
  mpz_set(mpq_numref(raw(number_)), raw_integer(numerator.number_));
  mpz_set(mpq_denref(raw(number_)), raw_integer(denominator.number_));
  mpq_canonicalize(raw(number_));
}

Rational::Rational(const Rational& other) {
  mpq_init(raw(number_));
  mpq_set(raw(number_), raw(other.number_));
}

Rational::Rational(Rational&& other) noexcept {
  mpq_init(raw(number_));
  mpq_swap(raw(number_), raw(other.number_));
}

Rational& Rational::operator=(const Rational& other) {
  mpq_set(raw(number_), raw(other.number_));
  return *this;
}

Rational& Rational::operator=(Rational&& other) noexcept {
  mpq_swap(raw(number_), raw(other.number_));
  return *this;
}

Rational::~Rational() {
  mpq_clear(raw(number_));
}

Rational& Rational::operator+=(const Rational& other) {
  mpq_add(raw(number_), raw(number_), raw(other.number_));
  return *this;
}

Rational& Rational::operator-=(const Rational& other) {
  mpq_sub(raw(number_), raw(number_), raw(other.number_));
  return *this;
}

Rational& Rational::operator*=(const Rational& other) {
  mpq_mul(raw(number_), raw(number_), raw(other.number_));
  return *this;
}

Rational& Rational::operator/=(const Rational& other) {
  mpq_div(raw(number_), raw(number_), raw(other.number_));
  return *this;
}

Rational& Rational::operator*=(const Integer& other) {
  return *this *= Rational(other, Integer(1));
}

Rational& Rational::operator/=(const Integer& other) {
  return *this /= Rational(other, Integer(1));
}

void Rational::negate() {
  mpq_neg(raw(number_), raw(number_));
}

int Rational::sign() const {
  return mpq_sgn(raw(number_));
}

int Rational::compare(const Rational& other) const {
  return mpq_cmp(raw(number_), raw(other.number_));
}

int Rational::compare(double other) const {
  Rational exactly;
  mpq_set_d(raw(exactly.number_), other);
  return compare(exactly);
}

Integer Rational::numerator() const {
  Integer result;
  mpz_set(reinterpret_cast<mpz_ptr>(result.number_), mpq_numref(raw(number_)));
  return result;
}

Integer Rational::denominator() const {
  Integer result;
  mpz_set(reinterpret_cast<mpz_ptr>(result.number_), mpq_denref(raw(number_)));
  return result;
}

double Rational::towards_zero() const {
  return mpq_get_d(raw(number_));
}

}  // namespace quoll

#endif
