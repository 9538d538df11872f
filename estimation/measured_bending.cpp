#include "estimation/measured_bending.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/bending.h"
#include "estimation/bending_rigidity.h"

namespace drape {
namespace {

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
// [1/m], log-normal over the same fabrics (mean of three directions, correlated by .12 to .21 only:
// each direction has its own).
constexpr double kMeanLogPeak = 5.336, kSdLogPeak = 0.500;
constexpr double kLowestPeak = 28.6, kHighestPeak = 1076;
// Two slopes stand for that curve, the second from kappa_p/2 on: its mean up to the peak is a
// quarter of the first. Beyond the peak the measured slope is negative, which no s_b allows.
constexpr double kLowestScale = 0.1, kHighestScale = 0.625;

/// A wing stiffness is at least this share of the largest one. Where non-negative least squares
/// ask for zero, which no fabric allows, this changes B by less than 1 %.
constexpr double kLeastShare = 0.01;

Vec3 normals(Random& random) {
  Vec3 z;
  for (double& value : z) value = random.normal();
  return z;
}

/// From the measured order warp, weft, bias to weft, warp, bias.
Vec3 weft_first(const Vec3& rigidity) { return {rigidity[1], rigidity[0], rigidity[2]}; }

/// The t_b whose R_b is half the radius at which the measured moment peaks (Eq. 9, monotonic).
double random_threshold(Random& random) {
  double peak = 0;
  while (peak < kLowestPeak || peak > kHighestPeak)
    peak = std::exp(kMeanLogPeak + kSdLogPeak * random.normal());
  const double radius_mm = 2e3 / peak;
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (threshold_radius_mm(middle) < radius_mm ? low : high) = middle;
  }
  return low;
}

}  // namespace

MeasuredBending random_bending(Random& random) {
  const Mat4 L = kCovariance.llt().matrixL();
  for (;;) {
    Vec4 z;
    for (double& value : z) value = random.normal();
    const Vec4 drawn = (kMean + L * z).array().exp();
    if ((drawn.array() >= kLowest.array()).all() && (drawn.array() <= kHighest.array()).all())
      return {drawn[0], weft_first(drawn.tail<3>())};
  }
}

Vec3 random_rigidity(double areal_density, double shift, double scatter, Random& random) {
  const Vec3 slope = kCovariance.block<3, 1>(1, 0) / kCovariance(0, 0);
  const Mat3 residual =
      kCovariance.bottomRightCorner<3, 3>() - slope * kCovariance.block<1, 3>(0, 1);
  const Mat3 L = residual.llt().matrixL();
  const Vec3 logs = kMean.tail<3>() + slope * (std::log(areal_density) - kMean[0]) +
                    Vec3::Constant(shift) + scatter * (L * normals(random));
  return weft_first(logs.array().exp());
}

void set_rigidity(Fabric& fabric, const Vec3& rigidity) {
  const Vec3 k_b = hinge_stiffness(rigidity).k_b;
  const Vec3 allowed = k_b.cwiseMax(kLeastShare * k_b.maxCoeff());
  fabric.k_bu = allowed[0];
  fabric.k_bv = allowed[1];
  fabric.k_bh = allowed[2];
}

void set_random_softening(Fabric& fabric, Random& random) {
  for (Parameter p : {Parameter::s_bu, Parameter::s_bv, Parameter::s_bh})
    fabric[p] = random.log_uniform(kLowestScale, kHighestScale);
  for (Parameter p : {Parameter::t_bu, Parameter::t_bv, Parameter::t_bh})
    fabric[p] = random_threshold(random);
}

}  // namespace drape
