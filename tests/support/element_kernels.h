// The kernels for whole meshes applied to a single element: value, gradient and full Hessian.
#pragma once

#include <vector>

#include "core/batched_bending.h"
#include "core/batched_membrane.h"
#include "tests/support/derivative_check.h"

namespace drape::test {

struct ElementDerivatives {
  double energy;
  VecX gradient;
  MatX hessian;
};

/// Positions of an element, and a dense lower triangle that takes its blocks.
template <typename Places, int kCorners>
struct SingleElement {
  explicit SingleElement(const Eigen::Matrix<double, 3, kCorners>& corners)
      : x(PaddedState::Zero(4, kCorners)),
        gradient(PaddedState::Zero(4, kCorners)),
        values(VecX::Zero(kSize * (kSize + 1) / 2)) {
    x.topRows(3) = corners;
    for (int i = 0; i < kCorners; ++i)
      for (int j = 0; j <= i; ++j)
        places.block[lower_index(i, j)][0] = {column_start(3 * j) + 3 * (i - j), kSize - 3 * j - 1};
  }

  ElementDerivatives result(double energy) const {
    MatX H(kSize, kSize);
    for (int c = 0; c < kSize; ++c)
      for (int r = c; r < kSize; ++r) H(r, c) = H(c, r) = values[column_start(c) + r - c];
    return {energy, gradient.topRows(3).reshaped(), H};
  }

  static constexpr int kSize = 3 * kCorners;
  static int column_start(int c) { return c * kSize - c * (c - 1) / 2; }

  PaddedState x, gradient;
  VecX values;
  Places places;
};

inline ElementDerivatives membrane_derivatives(const RestTriangle& rest, const MembraneStiffness& k,
                                               const Eigen::Matrix<double, 3, 3>& corners,
                                               double blend = 0) {
  Mesh mesh;
  mesh.rest = {rest};
  mesh.triangles.resize(1, 3);
  mesh.triangles << 0, 1, 2;
  const std::vector<TriangleBatch> batches = batches_of_triangles(mesh, {0});
  SingleElement<TrianglePlaces, 3> element(corners);
  const double energy = add_membrane_gradient(batches, k, element.x, element.gradient);
  add_membrane_hessian(batches, {element.places}, k, element.x, blend, element.values.data());
  return element.result(energy);
}

inline std::vector<WingBatch> single_wing() {
  Mesh mesh;
  mesh.wings.resize(1);
  mesh.wings[0].vertices = {0, 1, 2, 3};
  return batches_of_wings(mesh, {0});
}

inline ElementDerivatives wing_derivatives(const WingLaw& law,
                                           const Eigen::Matrix<double, 3, 4>& corners,
                                           double blend = 0) {
  const std::vector<WingBatch> batches = single_wing();
  const std::vector<WingLawBatch> laws = batches_of_laws(batches, {law});
  SingleElement<WingPlaces, 4> element(corners);
  const double energy = add_bending_gradient({batches, laws, law.law}, element.x, element.gradient);
  add_bending_hessian({batches, laws, law.law}, {element.places}, element.x, blend,
                      element.values.data());
  return element.result(energy);
}

inline double wing_moment(const WingLaw& law, double delta) {
  return WingResponse(batches_of_laws(single_wing(), {law})[0], law.law, delta).moment[0];
}
inline double wing_tangent(const WingLaw& law, double delta) {
  return WingResponse(batches_of_laws(single_wing(), {law})[0], law.law, delta).tangent[0];
}

}  // namespace drape::test
