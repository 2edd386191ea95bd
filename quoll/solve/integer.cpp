#include "quoll/solve/integer.hpp"

#ifdef QUOLL_GMP

#include <gmp.h>

#include <cstring>

namespace quoll {

namespace {

mpz_ptr raw(unsigned char* number) {
  return reinterpret_cast<mpz_ptr>(number);
}
mpz_srcptr raw(const unsigned char* number) {
  return reinterpret_cast<mpz_srcptr>(number);
}

}  // namespace

Integer::Integer(std::int64_t value) {
  static_assert(sizeof(mpz_t) <= sizeof(number_) && alignof(mpz_t) <= 8);
  static_assert(sizeof(long) == sizeof(std::int64_t));
  mpz_init_set_si(raw(number_), value);
}

Integer::Integer(const std::string& digits) {
  mpz_init_set_str(raw(number_), digits.c_str(), 10);
}

Integer::Integer(const Integer& other) {
  mpz_init_set(raw(number_), raw(other.number_));
}

Integer::Integer(Integer&& other) noexcept {
  mpz_init(raw(number_));
  mpz_swap(raw(number_), raw(other.number_));
}

Integer& Integer::operator=(const Integer& other) {
  mpz_set(raw(number_), raw(other.number_));
  return *this;
}

Integer& Integer::operator=(Integer&& other) noexcept {
  mpz_swap(raw(number_), raw(other.number_));
  return *this;
}

Integer::~Integer() {
  mpz_clear(raw(number_));
}

Integer& Integer::operator*=(const Integer& other) {
  mpz_mul(raw(number_), raw(number_), raw(other.number_));
  return *this;
}

void Integer::subtract_product(const Integer& a, const Integer& b) {
  mpz_submul(raw(number_), raw(a.number_), raw(b.number_));
}

void Integer::divide_exactly(const Integer& divisor) {
  mpz_divexact(raw(number_), raw(number_), raw(divisor.number_));
}

int Integer::sign() const {
  return mpz_sgn(raw(number_));
}

bool Integer::is_one() const {
  return mpz_cmp_ui(raw(number_), 1) == 0;
}

std::uint64_t Integer::bits() const {
  return mpz_sizeinbase(raw(number_), 2);
}

std::string Integer::text() const {
  std::string digits(mpz_sizeinbase(raw(number_), 10) + 2, '\0');
  mpz_get_str(digits.data(), 10, raw(number_));
  digits.resize(std::strlen(digits.c_str()));
  return digits;
}

Integer gcd(const Integer& a, const Integer& b) {
  Integer result;
  mpz_gcd(raw(result.number_), raw(a.number_), raw(b.number_));
  return result;
}

Integer lcm(const Integer& a, const Integer& b) {
  Integer result;
  mpz_lcm(raw(result.number_), raw(a.number_), raw(b.number_));
  return result;
}

Integer ten_to(std::uint32_t exponent) {
  Integer result;
  mpz_ui_pow_ui(raw(result.number_), 10, exponent);
  return result;
}

}  // namespace quoll

#endif
