#include "experiments/fabric_distribution.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/bending.h"
#include "core/scene.h"
#include "estimation/bending_rigidity.h"
#include "experiments/random_fabric.h"

namespace drape {
namespace {

constexpr double kPi = 3.14159265358979323846;
using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

// Measured by Feng et al. 2022: 618 rows, of which 251 are distinct. A repeated row is one fabric
// listed twice, so each distinct row counts once. Natural logarithms of kg/m^2 and N m, in the
// order areal density, B_warp, B_weft, B_bias.
//
// How well a truncated normal fits: its medians lie 10 to 18 % below the data's, its 5 and 95 %
// points within a factor of 1.31 of theirs. Kolmogorov-Smirnov distances are .10 to .11 for the
// four (more than the .086 of chance at 5 %: the data are skewed), .07 for B_warp/B_weft, .03 for
// B_bias/sqrt(B_warp B_weft) and .08 for the mean ln B less ln density, which sets the folds.
const Vec4 kMean{-1.7684, -11.2364, -11.6237, -11.4784};
const Mat4 kCovariance{{0.58492, 0.76091, 0.67135, 0.73330},
                       {0.76091, 1.85625, 1.44725, 1.56874},
                       {0.67135, 1.44725, 1.49818, 1.35313},
                       {0.73330, 1.56874, 1.35313, 1.58505}};
const Vec4 kLowest{0.0153, 3.367e-7, 2.230e-7, 3.299e-7};
const Vec4 kHighest{0.8703, 2.657e-4, 1.2302e-4, 8.881e-5};

// The measured moment is B (kappa - kappa^2 / (2 kappa_p)): its slope falls to zero at kappa_p
// [1/m], log-normal over the same fabrics (mean of three directions).
constexpr double kMeanLogPeak = 5.336, kSdLogPeak = 0.500;
constexpr double kLowestPeak = 28.6, kHighestPeak = 1076;
// Two slopes stand for that curve, the second from kappa_p/2 on: its mean up to the peak is a
// quarter of the first. Beyond the peak the measured slope is negative, which no s_b allows.
constexpr Interval kPastThreshold{0.1, 0.625};

constexpr Interval kStretch{10, 3e4};  // knits to wovens and coated fabrics [N/m]
constexpr Interval kShear{10, 3e3};    // soft knits to coated fabrics [N/m]

/// A wing stiffness is at least this share of the largest one. Where non-negative least squares
/// ask for zero, which no fabric allows, this changes B by less than 1 %.
constexpr double kLeastShare = 0.01;

constexpr double kShortestBendingLength = 2e-3;  // [m]

/// Standard normal (Box and Muller).
double normal(Random& random) {
  const double radius = std::sqrt(-2 * std::log1p(-random.uniform()));
  return radius * std::cos(2 * kPi * random.uniform());
}

/// Areal density, B_warp, B_weft, B_bias.
Vec4 measured_density_and_rigidity(Random& random) {
  const Mat4 L = kCovariance.llt().matrixL();
  for (;;) {
    Vec4 z;
    for (double& value : z) value = normal(random);
    const Vec4 drawn = (kMean + L * z).array().exp();
    if ((drawn.array() >= kLowest.array()).all() && (drawn.array() <= kHighest.array()).all())
      return drawn;
  }
}

/// The t_b whose R_b is half the radius at which the measured moment peaks (Eq. 9, monotonic).
double measured_threshold(Random& random) {
  double peak = 0;
  while (peak < kLowestPeak || peak > kHighestPeak)
    peak = std::exp(kMeanLogPeak + kSdLogPeak * normal(random));
  const double radius_mm = 2e3 / peak;
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (threshold_radius_mm(middle) < radius_mm ? low : high) = middle;
  }
  return low;
}

Fabric measured_fabric(Random& random) {
  Fabric fabric;
  const Vec4 drawn = measured_density_and_rigidity(random);
  fabric.areal_density = drawn[0];
  const double B_warp = drawn[1], B_weft = drawn[2], B_bias = drawn[3];
  const Vec3 k_b = hinge_stiffness({B_weft, B_warp, B_bias}).k_b;
  const Vec3 allowed = k_b.cwiseMax(kLeastShare * k_b.maxCoeff());
  fabric.k_bu = allowed[0];
  fabric.k_bv = allowed[1];
  fabric.k_bh = allowed[2];
  fabric.k_u = random.log_uniform(kStretch.low, kStretch.high);
  fabric.k_v = random.log_uniform(kStretch.low, kStretch.high);
  fabric.k_h = random.log_uniform(kShear.low, kShear.high);
  for (Parameter p : {Parameter::s_bu, Parameter::s_bv, Parameter::s_bh})
    fabric[p] = random.log_uniform(kPastThreshold.low, kPastThreshold.high);
  for (Parameter p : {Parameter::t_bu, Parameter::t_bv, Parameter::t_bh})
    fabric[p] = measured_threshold(random);
  return fabric;
}

Fabric wide_fabric(Random& random) {
  FabricBox box;
  box.areal_density = {0.02, 1};
  box.stretch = {5, 1e5};
  box.shear = {1, 1e4};
  box.flexural_rigidity = {1e-8, 1e-2};
  box.anisotropy = {std::sqrt(0.1), std::sqrt(10.0)};
  box.past_threshold = {0.05, 2};
  box.threshold = {0, 1};
  for (;;) {
    const Fabric fabric = random_fabric(random, box);
    if (bending_length(fabric, Scene{}.gravity) >= kShortestBendingLength) return fabric;
  }
}

}  // namespace

std::string_view name(FabricDistribution distribution) {
  return distribution == FabricDistribution::measured ? "measured" : "wide";
}

Fabric random_fabric(Random& random, FabricDistribution distribution) {
  switch (distribution) {
    case FabricDistribution::measured:
      return measured_fabric(random);
    case FabricDistribution::wide:
      return wide_fabric(random);
  }
  throw std::logic_error("a distribution without a function");
}

double bending_length(const Fabric& fabric, double gravity) {
  return std::cbrt(effective_rigidity(fabric).mean() / (fabric.areal_density * gravity));
}

}  // namespace drape
