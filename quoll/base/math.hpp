#pragma once
// Elementary functions with the same bits on every machine: only + - * / and sqrt, correctly
// rounded by IEEE 754, and no fused multiply-add (-ffp-contract=off). Errors are measured in
// tests/base/math_test.

#include <cstdint>

namespace quoll::math {

/// e^x, within 1 ulp; 0 below -745.2, infinity above 709.79; nan for nan.
double exp(double x);

/// The natural logarithm, within 1 ulp; -infinity at 0, nan below 0.
double log(double x);

/// x^y for x > 0, relative error below 2 ulp + |y log x| * 2^-52; pow(0, y>0) = 0; pow(x, 0) = 1.
double pow(double x, double y);

/// The sine and cosine of an angle in radians, within 1 ulp for |x| up to 2^20; beyond, x is first
/// taken modulo the double nearest 2 pi; nan for nan and infinities.
double sin(double x);
double cos(double x);

/// The tangent, within 2 ulp for |x| up to 2^20; beyond as sin and cos.
double tan(double x);

/// The angles in [-pi/2, pi/2] with this tangent or sine, within 1 ulp. asin is nan beyond 1.
double atan(double x);
double asin(double x);

/// The angle from the x axis to the point (x, y), in [-pi, pi], within 1 ulp; zeros and infinities
/// as in C.
double atan2(double y, double x);

}  // namespace quoll::math
