#include "estimation/continuation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "adjoint/sensitivity.h"

namespace drape {

BranchPoint make_branch_point(const Potential& potential, const ParameterSpace& space,
                              const VecX& z, Equilibrium equilibrium) {
  MatX dx_dz =
      sensitivities(potential, equilibrium, space.parameters) * space.derivative(z).asDiagonal();
  return {z, std::move(equilibrium), std::move(dx_dz)};
}

std::optional<BranchPoint> follow_branch(Potential& potential, const ParameterSpace& space,
                                         const BranchPoint& from, const VecX& z,
                                         const ContinuationOptions& options,
                                         ContinuationCost* cost) {
  ContinuationCost ignored;
  ContinuationCost& work = cost != nullptr ? *cost : ignored;
  const VecX change = z - from.z;
  const double length = change.cwiseAbs().maxCoeff();
  if (length > options.largest_leap) return std::nullopt;
  // s runs from 0 at from.z to 1 at z
  const auto z_at = [&](double s) -> VecX { return s == 1 ? z : VecX(from.z + s * change); };
  const FabricPath path{[&](double s) { return space.decode(z_at(s)); },
                        [&](double s) {
                          ParameterVector dp = ParameterVector::Zero();
                          const VecX dp_dz = space.derivative(z_at(s));
                          for (int i = 0; i < space.size(); ++i)
                            dp[static_cast<int>(space.parameters[static_cast<size_t>(i)])] =
                                dp_dz[i] * change[i];
                          return dp;
                        }};
  const BranchOptions branch{
      .largest_step = length > 0 ? std::min(1.0, options.largest_step / length) : 1.0,
      .smallest_step = std::pow(0.5, options.halvings),
      .largest_deviation = options.largest_deviation,
      .noise = options.noise,
      .equilibrium = options.equilibrium};
  BranchState state{0, from.equilibrium, from.dx_dz * change};
  if (!follow_minima(potential, path, 1, branch, state, work)) return std::nullopt;
  return make_branch_point(potential, space, z, std::move(state.equilibrium));
}

}  // namespace drape
