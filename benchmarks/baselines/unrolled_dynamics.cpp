#include "benchmarks/baselines/unrolled_dynamics.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "benchmarks/baselines/lumped_mass.h"
#include "core/sparse_factor.h"

namespace drape::baselines {
namespace {

constexpr double kTolerance = 1e-9;       // of a step, as of a static residual, or rounding floor
constexpr double kRoundingSlack = 1e-13;  // of energy differences
constexpr double kShortest = 1e-6;        // step of a line search
constexpr double kLargestMove = 0.02;     // of a vertex in a Newton step [m]
constexpr int kMostIterations = 200;      // of Newton in a time step

}  // namespace

UnrolledDynamics::UnrolledDynamics(const Potential& potential, VecX x, double h)
    : potential_(potential), inertia_(lumped_masses(potential) / (h * h)), states_{std::move(x)} {}

bool UnrolledDynamics::advance() {
  const Discretization& mesh = potential_.discretization();
  const VecX free_inertia = mesh.to_free(inertia_);
  const VecX aim = 2 * states_.back() - before(states_.size() - 1);
  const auto kinetic = [&](const VecX& at) {
    return 0.5 * (at - aim).dot(inertia_.cwiseProduct(at - aim));
  };
  SparseFactor factor(mesh.symbolic_factor());
  SparseMatrix H;
  VecX x = states_.back(), gradient;
  const double tolerance = std::max(kTolerance, 2 * potential_.rounding_floor(x));
  for (int i = 0; i < kMostIterations; ++i) {
    const double here = potential_.energy_and_gradient(x, gradient) + kinetic(x);
    const VecX force = mesh.to_free(gradient + inertia_.cwiseProduct(x - aim));
    if (potential_.residual(mesh.to_full(force)) <= tolerance) {
      states_.push_back(std::move(x));
      return true;
    }
    for (const double blend : {0.0, 1.0}) {  // the true Hessian where it will do
      potential_.hessian(x, blend, H);
      H.diagonal() += free_inertia;
      if (factor.factorize(H)) break;
      if (blend == 1) return false;
    }
    VecX d = -force;
    factor.solve_in_place(d);
    if (const double move = largest_move(d); move > kLargestMove) d *= kLargestMove / move;
    const VecX full = mesh.to_full(d);
    const double noise = kRoundingSlack * std::abs(here);
    double length = 1;
    while (!(potential_.energy(x + length * full) + kinetic(x + length * full) <= here + noise)) {
      length /= 2;
      if (length < kShortest) return false;
    }
    x += length * full;
  }
  return false;
}

ParameterVector UnrolledDynamics::gradient(const VecX& dL_dx) const {
  const Discretization& mesh = potential_.discretization();
  const VecX free_inertia = mesh.to_free(inertia_);
  SparseFactor factor(mesh.symbolic_factor());
  SparseMatrix H;
  ParameterVector dL_dp = ParameterVector::Zero();
  VecX bar = mesh.to_free(dL_dx), bar_before = VecX::Zero(bar.size());
  for (size_t k = states_.size() - 1; k > 0; --k) {
    potential_.hessian(states_[k], 0, H);
    H.diagonal() += free_inertia;
    if (!factor.factorize(H))
      throw std::runtime_error("unrolled dynamics: a time step ends at no minimum");
    VecX mu = bar;
    factor.solve_in_place(mu);
    const VecX full = mesh.to_full(mu);
    dL_dp -= potential_.gradient_dfabric_transposed(states_[k], full);
    const VecX acceleration = states_[k] - 2 * states_[k - 1] + before(k - 1);
    dL_dp[static_cast<int>(Parameter::areal_density)] -=
        full.dot(inertia_.cwiseProduct(acceleration)) / potential_.fabric().areal_density;
    const VecX pushed = free_inertia.cwiseProduct(mu);
    bar = bar_before + 2 * pushed;
    bar_before = -pushed;
  }
  return dL_dp;
}

}  // namespace drape::baselines
