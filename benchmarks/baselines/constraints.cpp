#include "benchmarks/baselines/constraints.h"

#include <cmath>
#include <stdexcept>

namespace drape::baselines {

Corners4<double> BentWing::corners(const VecX& x) const {
  Corners4<double> columns;
  for (size_t k = 0; k < 4; ++k)
    columns.col(static_cast<Eigen::Index>(k)) = position(x, vertices[k]);
  return columns;
}

Bending bending(const WingLaw& law, double delta) {
  if (!past_threshold(law, delta)) return {2 * law.stiffness * delta, 2 * law.stiffness};
  const double tangent = 2 * law.stiffness * law.scale;
  if (law.law == BendingLaw::secant) return {tangent * delta, tangent};
  const double beyond = std::abs(delta) - law.threshold;
  return {std::copysign(2 * law.stiffness * law.threshold + tangent * beyond, delta), tangent};
}

Constraints constraints_of(const Potential& potential) {
  if (potential.guide() || potential.plate() || potential.support())
    throw std::invalid_argument(
        "a method of local steps: the potential has a guide, a plate or contact; only membrane, "
        "bending and weight are treated");
  const Mesh& mesh = potential.mesh();
  const Fabric& fabric = potential.fabric();
  Constraints all;
  for (int t : potential.discretization().active_triangles()) {
    const RestTriangle& rest = mesh.rest[static_cast<size_t>(t)];
    const Eigen::Matrix<double, 3, 4> c = membrane_directions(rest);
    const double k[4] = {fabric.k_u, fabric.k_v, fabric.k_h, fabric.k_h};
    for (int i = 0; i < 4; ++i)
      all.directions.push_back({{mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)},
                                c.col(i),
                                k[i] * rest.area});
  }
  for (const Wing& wing : mesh.wings)
    all.wings.push_back({wing.vertices, wing_law(wing, fabric, potential.reading())});
  all.weight = VecX::Zero(3 * mesh.vertex_count());
  for (int v : potential.discretization().free_vertices())
    all.weight[3 * v + 2] = fabric.areal_density * potential.gravity() * mesh.nodal_area[v];
  return all;
}

}  // namespace drape::baselines
