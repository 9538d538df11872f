#include "core/support_contact.h"

#include <algorithm>
#include <cmath>

namespace drape {
namespace {

constexpr double kDepthUnit = 5e-5;  // l of the header [m]

bool inside(const SupportContact& support, const Vec3& point) {
  return point.z() < 0 &&
         point.head<2>().squaredNorm() < support.column_radius * support.column_radius;
}

}  // namespace

SupportContact support_contact(const Scene& scene) {
  return {column_radius(scene), scene.specimen_radius - scene.support_radius};
}

double support_penetration(const SupportContact& support, const Vec3& point) {
  return std::max(0.0, std::min(support.column_radius - point.head<2>().norm(), -point.z()));
}

double support_penetration(const SupportContact& support, const Mesh& mesh, const VecX& x) {
  double deepest = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (!mesh.fixed[static_cast<size_t>(v)])
      deepest = std::max(deepest, support_penetration(support, position(x, v)));
  return deepest;
}

SupportDepth support_depth(const SupportContact& support, const Vec3& point) {
  const double r = point.head<2>().norm();
  const double p = support.column_radius - r, q = -point.z();
  if (!(p > 0 && q > 0)) return {0, Vec3::Zero(), Mat3::Zero()};
  const double s = std::hypot(p, q);
  const Vec3 radial(point.x() / r, point.y() / r, 0), around(-radial.y(), radial.x(), 0);
  const double cosine = p / s, sine = q / s;
  const double d_p = sine * sine * sine, d_q = cosine * cosine * cosine;
  // grad p = -radial, grad q = -z
  SupportDepth depth;
  depth.value = p * sine;
  depth.gradient = -d_p * radial - d_q * Vec3::UnitZ();
  // d'' in the (p, q) plane has rank one, for d is homogeneous; Hess p = -around around^T / r
  const Vec3 across = sine * radial - cosine * Vec3::UnitZ();
  depth.hessian =
      -3 * cosine * sine / s * across * across.transpose() - d_p / r * around * around.transpose();
  return depth;
}

double support_energy(const SupportContact& support, double weight, const Vec3& point) {
  if (!inside(support, point)) return 0;
  const double d = support_depth(support, point).value / kDepthUnit;
  return weight * kDepthUnit * d * d * d / 3;
}

Vec3 support_gradient(const SupportContact& support, double weight, const Vec3& point) {
  if (!inside(support, point)) return Vec3::Zero();
  const SupportDepth depth = support_depth(support, point);
  const double d = depth.value / kDepthUnit;
  return weight * d * d * depth.gradient;
}

Mat3 support_hessian(const SupportContact& support, double weight, const Vec3& point,
                     double blend) {
  if (!inside(support, point)) return Mat3::Zero();
  const SupportDepth depth = support_depth(support, point);
  const double d = depth.value / kDepthUnit;
  return weight * d *
         (2 / kDepthUnit * depth.gradient * depth.gradient.transpose() +
          (1 - blend) * d * depth.hessian);
}

}  // namespace drape
