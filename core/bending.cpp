#include "core/bending.h"

#include <algorithm>
#include <cmath>

namespace drape {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// The pieces of Eq. 9: R_b runs linearly from `radius` at `from` to that of the next piece.
struct RadiusPiece {
  double from, radius;
};
constexpr RadiusPiece kRadius[] = {{0, 0.01}, {0.1, 1}, {0.9, 100}, {0.99, 10000}};
constexpr int kLastPiece = 3;

int radius_piece(double t_b) {
  int piece = 0;
  while (piece < kLastPiece && t_b > kRadius[piece + 1].from) ++piece;
  return piece;
}

}  // namespace

Vec3 interpolation_weights(double phi) {
  const double s = 4 * phi / kPi;
  return s < 1 ? Vec3(1 - s, 0, s) : Vec3(0, s - 1, 2 - s);
}

double threshold_radius_mm(double t_b) {
  if (t_b <= 0) return kRadius[0].radius;
  const int i = radius_piece(t_b);
  if (i == kLastPiece) return kRadius[i].radius;
  const double s = (t_b - kRadius[i].from) / (kRadius[i + 1].from - kRadius[i].from);
  return kRadius[i].radius * (1 - s) + kRadius[i + 1].radius * s;
}

double threshold_radius_mm_derivative(double t_b) {
  const int i = radius_piece(t_b);
  if (t_b <= 0 || i == kLastPiece) return 0;
  return (kRadius[i + 1].radius - kRadius[i].radius) / (kRadius[i + 1].from - kRadius[i].from);
}

WingLaw wing_law(const Wing& wing, const Fabric& fabric, BendingReading reading) {
  WingLaw law;
  law.law = reading.law;
  law.weights = interpolation_weights(wing.phi);
  law.weight = wing.weight;
  law.stiffness = wing.weight * law.weights.dot(Vec3(fabric.k_bu, fabric.k_bv, fabric.k_bh));
  law.scale = law.weights.dot(Vec3(fabric.s_bu, fabric.s_bv, fabric.s_bh));

  const double t_b = law.weights.dot(Vec3(fabric.t_bu, fabric.t_bv, fabric.t_bh));
  const bool by_radius = reading.threshold == BendingThreshold::radius;
  // a wing on the clamp line stands for half the width: the other half is rigid
  const double L_avg_mm = 1e3 * wing.mean_height * (by_radius && wing.on_clamp_line ? 0.5 : 1.0);
  const double R_b = threshold_radius_mm(t_b);
  const double ratio = L_avg_mm / (2 * R_b);
  const double c = std::clamp(ratio, 0.0, 1.0);
  law.threshold = 2 * (by_radius ? std::asin(c) : std::acos(c));
  law.threshold_derivative = 0;
  if (ratio < 1) {
    const double dc_dt = -ratio / R_b * threshold_radius_mm_derivative(t_b);
    law.threshold_derivative = (by_radius ? 2 : -2) / std::sqrt(1 - c * c) * dc_dt;
  }
  return law;
}

Eigen::Matrix<double, 9, 1> wing_moment_dfabric(const WingLaw& law, double delta) {
  const double k_b = law.stiffness / law.weight;
  double dM_dk = 2 * delta, dM_ds = 0, dM_dthreshold = 0;
  if (past_threshold(law, delta)) {
    const double beyond = std::abs(delta) - law.threshold;
    const double sign = std::copysign(1.0, delta);
    if (law.law == BendingLaw::secant) {
      dM_dk = 2 * law.scale * delta;
      dM_ds = 2 * k_b * delta;
    } else {
      dM_dk = sign * 2 * (law.threshold + law.scale * beyond);
      dM_ds = sign * 2 * k_b * beyond;
      dM_dthreshold = sign * 2 * k_b * (1 - law.scale);
    }
  }
  Eigen::Matrix<double, 9, 1> dM;
  dM << dM_dk * law.weights, dM_ds * law.weights,
      dM_dthreshold * law.threshold_derivative * law.weights;
  return law.weight * dM;
}

}  // namespace drape
