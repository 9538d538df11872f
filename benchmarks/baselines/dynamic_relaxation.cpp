// Dynamic relaxation with kinetic damping (Cundall 1976; Barnes 1999): a fictitious motion of unit
// time steps with fictitious masses, stopped at every peak of its kinetic energy.
//
// The masses make unit steps stable: by Gershgorin's theorem a quarter of the absolute row sum of
// the stiffness suffices. They are renewed, from the projected Hessian, when the motion is stopped.
// At a peak the state goes back half a step, to where the peak is taken to be (Barnes, Eq. 14).
#include <algorithm>
#include <cmath>

#include "benchmarks/baselines/methods.h"

namespace drape::baselines {
namespace {

constexpr int kLeastSteps = 20;  // between two renewals of the masses

/// In the layout of a state (3n); alike in the three directions of a vertex, 1 at fixed vertices.
VecX fictitious_masses(const Potential& potential, const VecX& x, SparseMatrix& H) {
  potential.hessian(x, 1, H);
  VecX row_sum = VecX::Zero(H.rows());
  for (int c = 0; c < H.outerSize(); ++c)
    for (SparseMatrix::InnerIterator entry(H, c); entry; ++entry) {
      row_sum[entry.row()] += std::abs(entry.value());
      if (entry.row() != c) row_sum[c] += std::abs(entry.value());
    }
  VecX mass = VecX::Ones(x.size());
  const std::vector<int>& vertices = potential.discretization().free_vertices();
  for (size_t i = 0; i < vertices.size(); ++i)
    mass.segment<3>(3 * vertices[i])
        .setConstant(row_sum.segment<3>(3 * static_cast<Eigen::Index>(i)).maxCoeff() / 4);
  return mass;
}

}  // namespace

VecX dynamic_relaxation(const Potential& potential, VecX x, Course& course) {
  SparseMatrix H;
  VecX mass = fictitious_masses(potential, x, H);
  VecX v = VecX::Zero(x.size()), gradient;
  double kinetic = 0;
  bool at_rest = true;
  int age = 0;  // of the masses
  for (bool first = true;; first = false) {
    potential.energy_and_gradient(x, gradient);
    if (!first && !course.go_on(x, gradient)) return x;
    ++age;
    const VecX faster = v - (at_rest ? 0.5 : 1.0) * gradient.cwiseQuotient(mass);
    const double energy = faster.dot(mass.cwiseProduct(faster));
    if (!at_rest && energy < kinetic) {
      x -= 0.5 * v;
      v.setZero();
      kinetic = 0;
      at_rest = true;
      if (age >= kLeastSteps) {
        mass = fictitious_masses(potential, x, H);
        age = 0;
      }
      continue;
    }
    at_rest = false;
    kinetic = energy;
    v = faster;
    x += v;
  }
}

}  // namespace drape::baselines
