#include "core/drape_protocol.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "core/coarse_choice.h"
#include "core/random.h"

namespace drape {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kRampSteps = 16;
constexpr int kCoarseRampSteps = 8;
constexpr double kRampStart = 0.02;      // first share of gravity
constexpr double kLooseTolerance = 0.1;  // residual of a step, relative to its own gravity
constexpr double kSoftTolerance = 10;    // residual with a membrane that is too soft
constexpr double kSoftStrain = 0.03;     // of the softest membrane under the overhang's weight
constexpr double kStiffening = 10;       // from one membrane to the next
constexpr double kFoldDrop = 0.6;        // share of the overhang's slope taken by a folded start
constexpr int kOutlineSamples = 1440;

/// A circular arc of length `length`, tangent to the horizontal at its start, whose horizontal
/// reach is `reach`: total turning angle in [0, pi].
double arc_angle(double length, double reach) {
  double low = 0, high = kPi;  // sin(a)/a falls from 1 to 0
  for (int i = 0; i < 60; ++i) {
    const double a = (low + high) / 2;
    (std::sin(a) > a * reach / length ? low : high) = a;
  }
  return (low + high) / 2;
}

/// A gravity ramp from flat on the mesh of the potential.
struct RampSteps {
  int steps;
  bool predicted;  ///< go on as the last step went
};

Equilibrium ramp(Potential potential, const RampSteps& how, std::uint64_t seed,
                 const EquilibriumOptions& options) {
  VecX x = noisy_flat_state(potential.mesh(), seed);
  const double gravity = potential.gravity();
  Equilibrium result;
  VecX before;
  for (int i = 0; i < how.steps; ++i) {
    const bool last = i == how.steps - 1;
    EquilibriumOptions step = last ? options : options.loosened(kLooseTolerance);
    step.max_iterations -= result.newton_iterations;
    potential.set_gravity(gravity *
                          std::pow(kRampStart, 1 - static_cast<double>(i) / (how.steps - 1)));
    const VecX start = how.predicted && i > 1 ? VecX(2 * x - before) : x;
    Equilibrium next = solve_equilibrium(potential, start, step);
    next.add_work_of(result);
    result = std::move(next);
    if (!result.converged()) break;
    before = std::move(x);
    x = result.x;
  }
  return result;
}

Potential without_guide(Potential potential) {
  potential.set_guide(std::nullopt);
  return potential;
}

}  // namespace

Equilibrium drape_by_coarse_ramp(const Potential& potential, std::uint64_t seed,
                                 const EquilibriumOptions& options) {
  Equilibrium result = chosen_on_coarse_mesh(
      without_guide(potential), options,
      [&](const Potential& coarse, const EquilibriumOptions& loose) {
        return ramp(coarse, {.steps = kCoarseRampSteps, .predicted = true}, seed, loose);
      });
  result.protocol = "coarse_ramp";
  return result;
}

Equilibrium drape_by_ramp(const Potential& potential, std::uint64_t seed,
                          const EquilibriumOptions& options) {
  const Potential free = without_guide(potential);
  Equilibrium result =
      restated(free, ramp(free, {.steps = kRampSteps, .predicted = false}, seed, options));
  result.protocol = "ramp";
  return result;
}

VecX noisy_flat_state(const Mesh& mesh, std::uint64_t seed) {
  VecX x = flat_state(mesh);
  Random random(seed);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (!mesh.fixed[static_cast<size_t>(v)])
      for (int k = 0; k < 3; ++k) x[3 * v + k] += kStartNoise * random.uniform(-1, 1);
  return x;
}

VecX folded_state(const Mesh& mesh, const Scene& scene, int lobes, double phase) {
  const double overhang = scene.specimen_radius - scene.support_radius;
  VecX x = flat_state(mesh);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.fixed[static_cast<size_t>(v)]) continue;
    const Vec2 uv = mesh.rest_uv.row(v);
    const double angle = std::atan2(uv.y(), uv.x());
    const double out = std::max(0.0, uv.norm() - scene.support_radius);
    // meridians bend down along arcs whose reach varies around the disc
    const double wave = std::cos(lobes * (angle - phase));
    const double turning = kPi / 2 * kFoldDrop * (1 - 0.6 * wave) * out / overhang;
    const double reach = turning > 1e-9 ? out * std::sin(turning) / turning : out;
    const double drop = turning > 1e-9 ? out * (1 - std::cos(turning)) / turning : 0;
    x.segment<2>(3 * v) = uv.normalized() * (scene.support_radius + reach);
    x[3 * v + 2] = -drop;
  }
  return x;
}

Equilibrium solve_stiffening(Potential potential, const Scene& scene, const VecX& x,
                             const EquilibriumOptions& options) {
  const Fabric fabric = potential.fabric();
  const double tension = fabric.areal_density * potential.gravity() *
                         (scene.specimen_radius - scene.support_radius);  // [N/m]
  const double stiffest = std::max({fabric.k_u, fabric.k_v, fabric.k_h});
  Equilibrium result;
  result.x = x;
  for (double most = tension / kSoftStrain;; most *= kStiffening) {
    const bool last = 3 * most > stiffest;
    EquilibriumOptions step = last ? options : options.loosened(kSoftTolerance);
    step.max_iterations -= result.newton_iterations;
    Fabric softened = fabric;
    if (!last) {
      for (Parameter k : {Parameter::k_u, Parameter::k_v, Parameter::k_h})
        softened[k] = std::min(fabric[k], most);
    }
    potential.set_fabric(softened);
    Equilibrium next = solve_equilibrium(potential, result.x, step);
    next.add_work_of(result);
    result = std::move(next);
    if (last || !result.converged()) return result;
  }
}

Equilibrium drape_by_lobes(const Potential& potential, const Scene& scene, int lobes, double phase,
                           const EquilibriumOptions& options) {
  Equilibrium result = chosen_on_coarse_mesh(
      without_guide(potential), options,
      [&](const Potential& coarse, const EquilibriumOptions& loose) {
        return solve_stiffening(coarse, scene, folded_state(coarse.mesh(), scene, lobes, phase),
                                loose);
      });
  std::ostringstream protocol;
  protocol << "lobes(" << lobes << ", " << phase << ")";
  result.protocol = protocol.str();
  return result;
}

VecX state_from_outline(const Mesh& mesh, const Scene& scene, const Guide& guide) {
  const double overhang = scene.specimen_radius - scene.support_radius;
  // cumulative arc length of the outline over its polar angle about the guide's centre
  const auto outline_point = [&](double alpha) -> Vec2 {
    return guide.centre + guide.radius(alpha) * Vec2(std::cos(alpha), std::sin(alpha));
  };
  std::vector<double> arc(kOutlineSamples + 1, 0);
  for (size_t i = 0; i < kOutlineSamples; ++i)
    arc[i + 1] = arc[i] + (outline_point(2 * kPi * static_cast<double>(i + 1) / kOutlineSamples) -
                           outline_point(2 * kPi * static_cast<double>(i) / kOutlineSamples))
                              .norm();
  const auto alpha_at = [&](double share) {
    const double target = share * arc.back();
    const auto above = std::upper_bound(arc.begin(), arc.end(), target);
    const size_t i = std::min(static_cast<size_t>(above - arc.begin()), arc.size() - 1) - 1;
    const double fraction = (target - arc[i]) / (arc[i + 1] - arc[i]);
    return 2 * kPi * (static_cast<double>(i) + fraction) / kOutlineSamples;
  };

  VecX x = flat_state(mesh);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.fixed[static_cast<size_t>(v)]) continue;
    const Vec2 uv = mesh.rest_uv.row(v);
    const double angle = std::atan2(uv.y(), uv.x());
    const double out = std::max(0.0, uv.norm() - scene.support_radius);
    const double share = angle / (2 * kPi) - std::floor(angle / (2 * kPi));
    const Vec2 rim = outline_point(alpha_at(share));
    // meridians start at their rest angle on the clamp and end at the outline
    const Vec2 clamp = scene.support_radius * uv.normalized();
    const double reach = std::clamp((rim - clamp).norm(), 0.05 * overhang, 0.999 * overhang);
    const double turning = arc_angle(overhang, reach);
    const double s = out / overhang * turning;
    const double along = overhang * std::sin(s) / turning;  // horizontal distance from the clamp
    x.segment<2>(3 * v) = clamp + (rim - clamp).normalized() * along;
    x[3 * v + 2] = -overhang * (1 - std::cos(s)) / turning;
  }
  return x;
}

}  // namespace drape
