#include "experiments/gradient_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "adjoint/adjoint.h"
#include "adjoint/loss.h"
#include "adjoint/sensitivity.h"
#include "core/cpu_clock.h"
#include "core/random.h"
#include "estimation/continuation.h"
#include "estimation/parameter_space.h"
#include "experiments/extrapolation.h"
#include "experiments/factorization_unit.h"
#include "experiments/model.h"

namespace drape {
namespace {

constexpr int kObservationHarmonics = 6;
constexpr double kSmallShare = 1e-4;  // of the largest derivative, below which errors are absolute
constexpr double kLargestDeviation =
    0.35;                        // of a state from its prediction, over predicted movement
constexpr double kNoise = 1e-6;  // deviations below this are never a snap [m]
constexpr int kTimings = 5;

/// A profile 1 to 2 mm beside `radius`, smoothly.
VecX observation_near(const VecX& radius, std::uint64_t seed) {
  Random random(seed);
  VecX observed = radius;
  for (int k = 1; k <= kObservationHarmonics; ++k) {
    const double amplitude = random.uniform(1e-3, 2e-3) / std::sqrt(kObservationHarmonics);
    const double phase = random.uniform(0, 2 * std::numbers::pi);
    for (Eigen::Index i = 0; i < observed.size(); ++i)
      observed[i] +=
          amplitude *
          std::cos(2 * std::numbers::pi * k * static_cast<double>(i) / kProfileSize + phase);
  }
  return observed;
}

Points2 polygon_of(const VecX& radius) {
  Points2 polygon(radius.size(), 2);
  for (Eigen::Index i = 0; i < radius.size(); ++i) {
    const double alpha = 2 * std::numbers::pi * static_cast<double>(i) / kProfileSize;
    polygon.row(i) = radius[i] * Vec2(std::cos(alpha), std::sin(alpha)).transpose();
  }
  return polygon;
}

/// The loss of the settings against a fixed observation.
class CheckedOutlineLoss {
 public:
  CheckedOutlineLoss(const Settings& settings, VecX observed_profile)
      : scene_(settings.scene),
        loss_(settings.gradient_check.loss),
        grid_(observation_grid(settings)),
        profile_(std::move(observed_profile)) {
    if (loss_ == CheckedLoss::coverage) coverage_ = drape::coverage(polygon_of(profile_), grid_);
  }

  Loss operator()(const Outline& outline) const {
    switch (loss_) {
      case CheckedLoss::profile:
        return profile_loss(outline, profile_);
      case CheckedLoss::coverage:
        return coverage_loss(outline, grid_, coverage_);
      case CheckedLoss::drape_coefficient:
        return drape_coefficient_loss(outline, scene_);
    }
    throw std::logic_error("a loss without a function");
  }

  /// dL/dp by the tangent: J^T r with the profile's Jacobian, or the corners' velocities.
  VecX tangent(const Outline& outline, const VecX& x, const MatX& dx_dp) const {
    if (loss_ == CheckedLoss::profile) {
      const Profile profile = radial_profile(outline.points);
      const MatX J = profile_sensitivities(outline, profile, Vec2::Zero(), x, dx_dp);
      return J.transpose() * (profile.radius - profile_) / kProfileSize;
    }
    const Points2 dL_dpoints = (*this)(outline).dL_dpoints;
    VecX rates(dx_dp.cols());
    for (Eigen::Index j = 0; j < dx_dp.cols(); ++j)
      rates[j] = dL_dpoints.cwiseProduct(push_forward(outline, x, dx_dp.col(j))).sum();
    return rates;
  }

 private:
  Scene scene_;
  CheckedLoss loss_;
  PixelGrid grid_;
  VecX profile_;
  CoverageImage coverage_;
};

/// As far down as rounding allows. Where the solver cannot prove that it got there (the floor is
/// measured by one random sample), within twice the floor.
Equilibrium solve_to_floor(const Potential& potential, const VecX& x) {
  EquilibriumOptions options;
  options.tolerance = 0;
  options.max_iterations = 1000;
  Equilibrium equilibrium = solve_equilibrium(potential, x, options);
  if (equilibrium.converged()) return equilibrium;
  options.tolerance = 2 * potential.rounding_floor(equilibrium.x);
  return solve_equilibrium(potential, equilibrium.x, options);
}

/// Differences about one equilibrium.
class Differences {
 public:
  Differences(const Settings& settings, Potential potential, const CheckedOutlineLoss& loss,
              ParameterSpace space, Equilibrium centre)
      : scene_(settings.scene),
        potential_(std::move(potential)),
        loss_(loss),
        space_(std::move(space)),
        z_(space_.encode(space_.reference)),
        regimes_(potential_.wing_regimes(centre.x)),
        centre_(make_branch_point(potential_, space_, z_, std::move(centre))) {}

  const MatX& dx_dz() const { return centre_.dx_dz; }

  /// Central difference, NaN when the step is excluded.
  double central(int parameter, double step) {
    return (loss_at(parameter, step) - loss_at(parameter, -step)) / (2 * step);
  }

 private:
  double loss_at(int parameter, double step) {
    constexpr double kExcluded = std::numeric_limits<double>::quiet_NaN();
    VecX z = z_;
    z[parameter] += step;
    potential_.set_fabric(space_.decode(z));
    const VecX movement = step * centre_.dx_dz.col(parameter);
    const VecX prediction = centre_.equilibrium.x + movement;
    const Equilibrium equilibrium = solve_to_floor(potential_, prediction);
    if (!equilibrium.converged()) return kExcluded;
    const double allowed =
        std::max(kNoise, kLargestDeviation * largest_distance(prediction, centre_.equilibrium.x));
    if (largest_distance(equilibrium.x, prediction) > allowed) return kExcluded;
    if (potential_.wing_regimes(equilibrium.x) != regimes_) return kExcluded;
    return loss_(trace_outline(potential_.mesh(), scene_, equilibrium.x)).value;
  }

  Scene scene_;
  Potential potential_;
  const CheckedOutlineLoss& loss_;
  ParameterSpace space_;
  VecX z_;
  std::vector<bool> regimes_;
  BranchPoint centre_;
};

ParameterCheck check_parameter(Differences& differences, const std::vector<double>& steps,
                               Parameter parameter, int index, double adjoint) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  ParameterCheck check;
  check.parameter = parameter;
  check.adjoint = adjoint;
  check.difference = kNone;
  const auto take_if_nearest = [&](double f, double step) {
    if (std::isnan(f) || std::abs(f - adjoint) >= std::abs(check.difference - adjoint)) return;
    check.difference = f;
    check.step = step;
  };
  for (size_t i = 0; i < steps.size(); ++i) {
    const double f = differences.central(index, steps[i]);
    const double limit =
        i > 0 ? extrapolated(check.differences.back(), f, steps[i - 1] / steps[i], 2) : kNone;
    check.differences.push_back(f);
    check.extrapolated.push_back(limit);
    if (std::isnan(f)) ++check.excluded;
    take_if_nearest(f, steps[i]);
    take_if_nearest(limit, steps[i]);
  }
  return check;
}

}  // namespace

GradientCheck check_gradient(const Settings& settings,
                             std::shared_ptr<const Discretization> discretization,
                             const Fabric& fabric, std::uint64_t seed) {
  GradientCheck result;
  Potential potential = make_potential(std::move(discretization), fabric, settings);
  const Equilibrium cold = drape(settings, potential).equilibrium;
  result.forward_cpu_seconds = cold.cpu_seconds;
  const Equilibrium equilibrium = cold.converged() ? solve_to_floor(potential, cold.x) : cold;
  result.status = equilibrium.converged() ? "ok" : name(equilibrium.status);
  result.record = make_record(settings, potential, equilibrium);
  result.record.stats.protocol = cold.protocol;
  if (!equilibrium.converged()) return result;
  result.wings = static_cast<int>(potential.mesh().wings.size());
  result.wings_past_threshold = potential.wings_past_threshold(equilibrium.x);
  result.unit_cpu_seconds = factorization_unit(potential, equilibrium.x);

  const Mesh& mesh = potential.mesh();
  const Outline outline = trace_outline(mesh, settings.scene, equilibrium.x);
  const CheckedOutlineLoss loss(settings,
                                observation_near(radial_profile(outline.points).radius, seed));
  ParameterVector dL_dp;
  result.adjoint_cpu_seconds = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTimings; ++i) {
    const double start = thread_cpu_seconds();
    const Outline traced = trace_outline(mesh, settings.scene, equilibrium.x);
    dL_dp = adjoint_gradient(potential, equilibrium,
                             pull_back(traced, equilibrium.x, loss(traced).dL_dpoints));
    result.adjoint_cpu_seconds = std::min(result.adjoint_cpu_seconds, thread_cpu_seconds() - start);
  }

  const ParameterSpace space{settings.gradient_check.parameters, fabric};
  const VecX dp_dz = space.derivative(space.encode(fabric));
  VecX a(space.size());
  for (int j = 0; j < space.size(); ++j)
    a[j] = dL_dp[static_cast<int>(space.parameters[static_cast<size_t>(j)])] * dp_dz[j];

  Differences differences(settings, potential, loss, space, equilibrium);
  const VecX tangent = loss.tangent(outline, equilibrium.x, differences.dx_dz());
  result.adjoint_versus_tangent =
      ((a - tangent).array().abs() / a.array().abs().max(kSmallShare * a.cwiseAbs().maxCoeff()))
          .maxCoeff();

  double largest = 0;
  for (int j = 0; j < space.size(); ++j) {
    result.parameters.push_back(check_parameter(differences, settings.gradient_check.steps,
                                                space.parameters[static_cast<size_t>(j)], j, a[j]));
    largest = std::fmax(largest, std::abs(result.parameters.back().difference));
  }
  for (ParameterCheck& check : result.parameters)
    check.error = std::abs(check.adjoint - check.difference) /
                  std::fmax(std::abs(check.difference), kSmallShare * largest);
  return result;
}

}  // namespace drape
