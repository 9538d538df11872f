// Derivatives against central differences.
//
// The best step of a difference is not known beforehand: truncation falls and rounding grows as it
// shrinks. The check therefore sweeps the step over decades, takes the step whose worst entry is
// best, and names that entry. A wrong derivative is wrong at every step.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "core/random.h"
#include "core/types.h"

namespace drape::test {

/// The worst entry at the best step. Errors are relative to the largest entry of the derivative.
struct DerivativeError {
  double error = std::numeric_limits<double>::infinity();
  double step = 0;
  Eigen::Index row = -1, column = -1;
  double derivative = 0, difference = 0;
};

inline std::ostream& operator<<(std::ostream& out, const DerivativeError& e) {
  return out << "error " << e.error << " at step " << e.step << ", entry (" << e.row << ", "
             << e.column << "): derivative " << e.derivative << ", difference " << e.difference;
}

/// f: VecX -> VecX, J its Jacobian at x. Steps run from 0.1 to 1e-9 times `length`.
template <typename Function>
DerivativeError check_jacobian(const Function& f, const VecX& x, const MatX& J, double length) {
  const double scale = std::max(J.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  DerivativeError best;
  for (double h = 0.1 * length; h > 0.9e-9 * length; h *= std::sqrt(0.1)) {
    DerivativeError worst;
    worst.error = -1;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      VecX forward = x, backward = x;
      forward[j] += h;
      backward[j] -= h;
      const VecX difference = (f(forward) - f(backward)) / (forward[j] - backward[j]);
      for (Eigen::Index i = 0; i < difference.size(); ++i) {
        const double error = std::abs(difference[i] - J(i, j)) / scale;
        if (!(error <= worst.error)) worst = {error, h, i, j, J(i, j), difference[i]};
      }
    }
    if (worst.error < best.error) best = worst;
  }
  return best;
}

/// f: VecX -> double.
template <typename Function>
DerivativeError check_gradient(const Function& f, const VecX& x, const VecX& gradient,
                               double length) {
  return check_jacobian([&](const VecX& y) { return VecX::Constant(1, f(y)); }, x,
                        gradient.transpose(), length);
}

/// f: double -> VecX.
template <typename Function>
DerivativeError check_derivative(const Function& f, double x, const VecX& derivative,
                                 double length) {
  return check_jacobian([&](const VecX& y) -> VecX { return f(y[0]); }, VecX::Constant(1, x),
                        derivative, length);
}

/// Order in h of the remainder f(x + h d) - f(x) - h gradient.d, between h and h/4: 2 for a right
/// gradient of a function with curvature along d, 1 for a wrong one.
template <typename Function>
double taylor_slope(const Function& f, const VecX& x, const VecX& gradient, const VecX& d,
                    double h) {
  const auto remainder = [&](double step) {
    return std::abs(f(x + step * d) - f(x) - step * gradient.dot(d));
  };
  return std::log2(remainder(h) / remainder(h / 4)) / 2;
}

/// A vector of uniform numbers in [-1, 1).
inline VecX random_vector(Eigen::Index size, Random& random) {
  VecX v(size);
  for (Eigen::Index i = 0; i < size; ++i) v[i] = random.uniform(-1, 1);
  return v;
}

/// The full matrix of which a lower triangle is stored.
inline MatX full_matrix(const SparseMatrix& lower) {
  return MatX(lower).selfadjointView<Eigen::Lower>();
}

}  // namespace drape::test
