#include "core/dihedral_angle.h"

namespace drape {

Vec12 fold_angle_gradient(const Corners4<double>& x) {
  const Vec3 edge = x.col(1) - x.col(0);
  const double l = edge.norm();
  Vec12 g = Vec12::Zero();
  const auto add_side = [&](int apex, const Vec3& normal) {
    const Vec3 by_area = normal / normal.squaredNorm();
    g.segment<3>(0) += (x.col(apex) - x.col(1)).dot(edge) / l * by_area;
    g.segment<3>(3) -= (x.col(apex) - x.col(0)).dot(edge) / l * by_area;
    g.segment<3>(3 * apex) += l * by_area;
  };
  add_side(2, edge.cross(x.col(2) - x.col(0)));
  add_side(3, (x.col(3) - x.col(0)).cross(edge));
  return g;
}

}  // namespace drape
