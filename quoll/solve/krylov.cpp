#include "quoll/solve/krylov.hpp"

#include <cmath>

// BiCGSTAB, van der Vorst 1992, the algorithm's letters: A x = b with A = I - g P, here for the
// correction x of the value, so that x = 0 at first and b is the residual.
//
//   1  r <- b; r' <- r; rho, alpha, omega <- 1; v, p <- 0
//   2  rho_1 <- (r', r); beta <- (rho_1 / rho) (alpha / omega); p <- r + beta (p - omega v)
//   3  v <- A p; alpha <- rho_1 / (r', v); s <- r - alpha v; t <- A s
//   4  omega <- (t, s) / (t, t); x <- x + alpha p + omega s; r <- s - omega t
//   5  stop when |r| is small enough; 2
//
// r': shadow, s is kept in r.

namespace quoll {

namespace {

using Vector = std::vector<double>;

double dot(const Vector& a, const Vector& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

Krylov improve_by_krylov(const PolicyRows& rows, double discount, double share, unsigned threads,
                         std::vector<double>& value) {
  constexpr std::uint64_t most_products = 500;
  const std::size_t n = value.size();
  Krylov done;
  Vector r(n), x(n, 0.0), v(n, 0.0), p(n, 0.0), t(n);
  rows.sweep(discount, value, r, threads);
  for (std::size_t i = 0; i < n; ++i) r[i] -= value[i];
  const Vector shadow = r;
  const double goal = share * std::sqrt(dot(r, r));
  double rho = 1.0, alpha = 1.0, omega = 1.0;
  for (done.products = 1; done.products < most_products; done.products += 2) {
    const double rho_1 = dot(shadow, r);
    const double beta = (rho_1 / rho) * (alpha / omega);
    if (!std::isfinite(beta) || rho_1 == 0.0) return done;
    rho = rho_1;
    for (std::size_t i = 0; i < n; ++i) p[i] = r[i] + beta * (p[i] - omega * v[i]);
    rows.leave_out(discount, p, v, threads);
    alpha = rho / dot(shadow, v);
    if (!std::isfinite(alpha)) return done;
    for (std::size_t i = 0; i < n; ++i) r[i] -= alpha * v[i];
    rows.leave_out(discount, r, t, threads);
    const double size = dot(t, t);
    omega = size > 0.0 ? dot(t, r) / size : 0.0;
    for (std::size_t i = 0; i < n; ++i) x[i] += alpha * p[i] + omega * r[i];
    for (std::size_t i = 0; i < n; ++i) r[i] -= omega * t[i];
    const double rest = std::sqrt(dot(r, r));
    if (!std::isfinite(rest)) return done;
    if (rest <= goal) {
      done.reached = true;
      for (std::size_t i = 0; i < n; ++i) value[i] += x[i];
      return done;
    }
    if (omega == 0.0) return done;
  }
  return done;
}

}  // namespace quoll
