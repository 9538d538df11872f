#include "experiments/references.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace drape::reference {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Energy per area over B/2 kappa^2 of a strip bent to kappa: 1 + nu (dw/dy at the side) / (kappa
/// W/2), where w'''' + (E kappa^2 / B) w = 0 across, w'' = -nu kappa and w''' = 0 at the sides.
double relative_energy(const StripSection& section, double kappa) {
  if (section.width == 0 || kappa == 0) return section.width == 0 ? 1 : 1 - std::pow(section.nu, 2);
  const double beta = std::pow(section.modulus * kappa * kappa / (4 * section.B), 0.25);
  const double a = beta * section.width / 2;         // w = p cosh cos + r sinh sin, even
  if (a < 0.02) return 1 - std::pow(section.nu, 2);  // the next term is of order a^4 = 1e-7
  // divided by cosh a: the functions and their derivatives by beta y
  const double t = std::tanh(a), c = std::cos(a), s = std::sin(a);
  Eigen::Matrix2d A;  // rows: w'' and w''' of the two functions
  A << -2 * t * s, 2 * c, -2 * (s + t * c), 2 * (t * c - s);
  const Vec2 rhs(-section.nu * kappa / (beta * beta), 0);
  const Vec2 p = A.inverse() * rhs;
  const double slope = beta * (p[0] * (t * c - s) + p[1] * (c * t + s));
  return 1 + section.nu * slope / (kappa * section.width / 2);
}

/// Gradient and Hessian of the model's energy per rest area in (lambda, a, b): the strip's
/// direction e becomes lambda e', the direction across a e' + b n'.
void stretch_derivatives(const Stretch& k, double angle, const Vec3& y, Vec3& gradient,
                         Mat3& hessian) {
  const std::array<double, 4> stiffness{k.k_u, k.k_v, k.k_h, k.k_h};
  const std::array<double, 4> direction{0, kPi / 2, kPi / 4, -kPi / 4};
  gradient.setZero();
  hessian.setZero();
  for (size_t i = 0; i < 4; ++i) {
    const double along = std::cos(direction[i] - angle), across = std::sin(direction[i] - angle);
    Eigen::Matrix<double, 2, 3> J;
    J << along, across, 0, 0, 0, across;
    const Vec2 w = J * y;
    const double l = w.norm();
    gradient += stiffness[i] * (1 - 1 / l) * J.transpose() * w;
    hessian += stiffness[i] * J.transpose() *
               ((1 - 1 / l) * Eigen::Matrix2d::Identity() + w * w.transpose() / (l * l * l)) * J;
  }
}

}  // namespace

double moment(const StripSection& section, double kappa) {
  if (section.width == 0) return section.B * kappa;
  const auto energy = [&](double at) {
    return section.B / 2 * at * at * relative_energy(section, at);
  };
  const double step = 1e-3 * kappa;
  return kappa == 0 ? 0 : (energy(kappa + step) - energy(kappa - step)) / (2 * step);
}

Tip heavy_elastica(const StripSection& section, double q, double length) {
  const int steps = 200;
  const double h = length / steps;
  const auto curvature = [&](double M) {  // moment / kappa varies by nu^2 at most: a fixed point
    double kappa = M / section.B;
    if (section.width == 0 || M <= 0) return kappa;
    for (int i = 0; i < 12; ++i) kappa *= M / moment(section, kappa);
    return kappa;
  };
  // From the tip, t = L - s, in u = pi/2 - theta: du/dt = kappa(M), dM/dt = q t sin u, M(0) = 0.
  // u at the clamp, to be pi/2, grows with u at the tip, which is tiny for long strips.
  Eigen::Vector4d y;
  const auto shoot = [&](double tip) {
    y << tip, 0, 0, 0;  // u, M, drop, reach
    const auto rate = [&](double t, const Eigen::Vector4d& at) -> Eigen::Vector4d {
      return {curvature(at[1]), q * t * std::sin(at[0]), std::cos(at[0]), std::sin(at[0])};
    };
    for (int i = 0; i < steps && y[0] <= kPi / 2; ++i) {  // beyond, it may turn back
      const double t = i * h;
      const Eigen::Vector4d k1 = rate(t, y), k2 = rate(t + h / 2, y + h / 2 * k1);
      const Eigen::Vector4d k3 = rate(t + h / 2, y + h / 2 * k2), k4 = rate(t + h, y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return y[0];
  };
  double low = std::log(1e-40), high = std::log(kPi / 2);
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (shoot(std::exp(middle)) > kPi / 2 ? high : low) = middle;
  }
  shoot(std::exp(low));
  return {y[2], y[3]};
}

double uniaxial_modulus(const Stretch& k, double angle) {
  const double C11 = k.k_u + k.k_h / 2, C22 = k.k_v + k.k_h / 2, C12 = k.k_h / 2, G = k.k_h / 2;
  const double determinant = C11 * C22 - C12 * C12;
  const double c2 = std::pow(std::cos(angle), 2), s2 = std::pow(std::sin(angle), 2);
  return 1 / (C22 / determinant * c2 * c2 + C11 / determinant * s2 * s2 +
              (-2 * C12 / determinant + 1 / G) * c2 * s2);
}

double uniaxial_stretch(const Stretch& k, double angle, double N) {
  constexpr int kLoadSteps = 4, kIterations = 20;
  Vec3 y(1, 0, 1), gradient;
  Mat3 hessian;
  for (int step = 1; step <= kLoadSteps; ++step)
    for (int i = 0; i < kIterations; ++i) {
      stretch_derivatives(k, angle, y, gradient, hessian);
      const Vec3 change = hessian.ldlt().solve(gradient - Vec3(N * step / kLoadSteps, 0, 0));
      y -= change;
      if (change.norm() < 1e-14) break;
    }
  return y[0];
}

double hanging_displacement(const Stretch& k, double angle, double q, double length, double s) {
  constexpr int kIntervals = 8;  // Simpson's rule
  double sum = 0;
  for (int i = 0; i <= 2 * kIntervals; ++i) {
    const double at = s * i / (2 * kIntervals);
    const double weight = i == 0 || i == 2 * kIntervals ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * (uniaxial_stretch(k, angle, q * (length - at)) - 1);
  }
  return sum * s / (6 * kIntervals);
}

double annulus_sag(double B, double q, double a, double b, double nu) {
  const auto row = [](double r, int derivative) -> Eigen::RowVector4d {
    const double l = std::log(r);
    if (derivative == 0) return {1, l, r * r, r * r * l};
    if (derivative == 1) return {0, 1 / r, 2 * r, 2 * r * l + r};
    return {0, -1 / (r * r), 2, 2 * l + 3};
  };
  Eigen::Matrix4d A;
  A.row(0) = row(a, 0);
  A.row(1) = row(a, 1);
  A.row(2) = row(b, 2) + nu / b * row(b, 1);  // no moment at the rim
  A.row(3) << 0, 0, 0, 4 / b;                 // no shear: d/dr of 4 (c2 + c3 (ln r + 1)) + load
  const double p = q / (64 * B);
  const Eigen::Vector4d load(-p * std::pow(a, 4), -4 * p * std::pow(a, 3),
                             -p * (12 + 4 * nu) * b * b, -32 * p * b);
  const Eigen::Vector4d c = A.partialPivLu().solve(load);
  return p * std::pow(b, 4) + row(b, 0) * c;
}

}  // namespace drape::reference
