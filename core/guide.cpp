#include "core/guide.h"

#include <cmath>

namespace drape {

Rim rim_of(const Mesh& mesh) {
  Rim rim;
  const size_t n = mesh.boundary.size();
  double total = 0;
  for (size_t i = 0; i < n; ++i) {
    const Vec2 before = mesh.rest_uv.row(mesh.boundary[(i + n - 1) % n]);
    const Vec2 here = mesh.rest_uv.row(mesh.boundary[i]);
    const Vec2 after = mesh.rest_uv.row(mesh.boundary[(i + 1) % n]);
    const double length = ((here - before).norm() + (after - here).norm()) / 2;
    total += length;
    if (mesh.fixed[static_cast<size_t>(mesh.boundary[i])]) continue;
    rim.vertices.push_back(mesh.boundary[i]);
    rim.share.push_back(length);
  }
  for (double& share : rim.share) share /= total;
  return rim;
}

GuideMiss guide_miss(const Guide& guide, const Vec2& point) {
  const Vec2 p = point - guide.centre;
  const double r = p.norm(), alpha = std::atan2(p.y(), p.x());
  const Vec2 radial = p / r, around(-radial.y(), radial.x());
  const double d = guide.radius.derivative(alpha), dd = guide.radius.second_derivative(alpha);
  GuideMiss miss;
  miss.value = r - guide.radius(alpha);
  // grad r = radial, grad alpha = around / r
  miss.gradient = radial - d / r * around;
  miss.hessian = around * around.transpose() / r - dd / (r * r) * around * around.transpose() +
                 d / (r * r) * (around * radial.transpose() + radial * around.transpose());
  return miss;
}

}  // namespace drape
