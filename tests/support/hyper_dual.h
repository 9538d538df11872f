// Hyper-dual numbers (Fike and Alonso 2011): second derivatives that are exact up to rounding.
//
// a + b e1 + c e2 + d e1 e2 with e1^2 = e2^2 = 0. Evaluating f at x + e1 along i and e2 along j
// gives f, df/dx_i, df/dx_j and d2f/dx_i dx_j at once.
#pragma once

#include <cmath>

#include "core/types.h"

namespace drape::test {

struct HyperDual {
  double a = 0, b = 0, c = 0, d = 0;
  HyperDual() = default;
  explicit HyperDual(double value) : a(value) {}
  HyperDual(double a_, double b_, double c_, double d_) : a(a_), b(b_), c(c_), d(d_) {}

  HyperDual& operator+=(const HyperDual& y) { return *this = {a + y.a, b + y.b, c + y.c, d + y.d}; }
};

inline HyperDual operator+(HyperDual x, const HyperDual& y) { return x += y; }
inline HyperDual operator-(const HyperDual& x) { return {-x.a, -x.b, -x.c, -x.d}; }
inline HyperDual operator-(const HyperDual& x, const HyperDual& y) { return x + -y; }
inline HyperDual operator*(const HyperDual& x, const HyperDual& y) {
  return {x.a * y.a, x.a * y.b + x.b * y.a, x.a * y.c + x.c * y.a,
          x.a * y.d + x.b * y.c + x.c * y.b + x.d * y.a};
}
/// g(x) of which value and first two derivatives at x.a are given.
inline HyperDual chain(const HyperDual& x, double g, double dg, double ddg) {
  return {g, dg * x.b, dg * x.c, dg * x.d + ddg * x.b * x.c};
}
inline HyperDual operator/(const HyperDual& x, const HyperDual& y) {
  const double r = 1 / y.a;
  return x * chain(y, r, -r * r, 2 * r * r * r);
}
inline HyperDual sqrt(const HyperDual& x) {
  const double r = std::sqrt(x.a);
  return chain(x, r, 0.5 / r, -0.25 / (r * x.a));
}
inline HyperDual abs(const HyperDual& x) { return x.a < 0 ? -x : x; }
inline HyperDual atan2(const HyperDual& y, const HyperDual& x) {
  // atan2(y, x) = angle of the values + atan of the rotated, whose angle is 0
  const double length = std::hypot(x.a, y.a), cosine = x.a / length, sine = y.a / length;
  const HyperDual along = HyperDual(cosine) * x + HyperDual(sine) * y;
  const HyperDual across = HyperDual(cosine) * y - HyperDual(sine) * x;
  const HyperDual slope = across / along;
  return HyperDual(std::atan2(y.a, x.a)) + HyperDual(0, slope.b, slope.c, slope.d);
}
inline bool operator<(const HyperDual& x, const HyperDual& y) { return x.a < y.a; }

/// Gradient and Hessian of f, a function of N hyper-dual numbers.
template <int N, typename Function>
void second_derivatives(const Function& f, const Eigen::Matrix<double, N, 1>& x,
                        Eigen::Matrix<double, N, 1>& gradient,
                        Eigen::Matrix<double, N, N>& hessian) {
  Eigen::Matrix<HyperDual, N, 1> dual = x.template cast<HyperDual>();
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) {
      dual[i].b = dual[j].c = 1;
      const HyperDual value = f(dual);
      gradient[i] = value.b;
      hessian(i, j) = value.d;
      dual[i].b = dual[j].c = 0;
    }
}

}  // namespace drape::test

template <>
struct Eigen::NumTraits<drape::test::HyperDual> : Eigen::NumTraits<double> {
  using Real = drape::test::HyperDual;
  using NonInteger = drape::test::HyperDual;
  using Nested = drape::test::HyperDual;
  using Literal = drape::test::HyperDual;
  enum { RequireInitialization = 1, ReadCost = 4, AddCost = 4, MulCost = 9 };
};
