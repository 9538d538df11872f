#include "adjoint/sensitivity.h"

#include "adjoint/adjoint.h"

namespace drape {

MatX sensitivities(const Potential& potential, const Equilibrium& equilibrium,
                   const std::vector<Parameter>& parameters) {
  require_minimum(potential, equilibrium);
  const Discretization& d = potential.discretization();
  const MatX dg = potential.gradient_dfabric(equilibrium.x);
  const auto columns = static_cast<Eigen::Index>(parameters.size());
  MatX right_hand_sides(equilibrium.factor->size(), columns);
  for (Eigen::Index i = 0; i < columns; ++i)
    right_hand_sides.col(i) =
        -d.to_free(dg.col(static_cast<int>(parameters[static_cast<size_t>(i)])));
  const MatX free = equilibrium.factor->solve(right_hand_sides);
  MatX dx_dp(equilibrium.x.size(), columns);
  for (Eigen::Index i = 0; i < columns; ++i) dx_dp.col(i) = d.to_full(free.col(i));
  return dx_dp;
}

MatX profile_sensitivities(const Outline& outline, const Profile& profile, const Vec2& centre,
                           const VecX& x, const MatX& dx_dp) {
  MatX drho_dp(kProfileSize, dx_dp.cols());
  for (Eigen::Index i = 0; i < dx_dp.cols(); ++i)
    drho_dp.col(i) =
        push_forward(profile, outline.points, centre, push_forward(outline, x, dx_dp.col(i)));
  return drho_dp;
}

}  // namespace drape
