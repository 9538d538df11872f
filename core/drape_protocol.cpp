#include "core/drape_protocol.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "core/random.h"

namespace drape {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kRampSteps = 16;
constexpr double kRampStart = 0.02;     // first share of gravity
constexpr double kRampNoise = 1e-6;     // [m]
constexpr double kRampTolerance = 0.1;  // residual of a step, relative to its own gravity
constexpr double kFoldDrop = 0.6;       // share of the overhang's slope taken by a folded start
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

}  // namespace

Equilibrium drape_by_ramp(const Potential& potential, std::uint64_t seed,
                          const EquilibriumOptions& options) {
  Potential ramp = potential;
  ramp.set_guide(std::nullopt);
  VecX x = flat_state(potential.mesh());
  Random random(seed);
  for (int v = 0; v < potential.mesh().vertex_count(); ++v)
    if (!potential.mesh().fixed[static_cast<size_t>(v)])
      for (int k = 0; k < 3; ++k) x[3 * v + k] += kRampNoise * random.uniform(-1, 1);

  Equilibrium result;
  double cpu = 0;
  int iterations = 0, factorizations = 0;
  for (int i = 0; i < kRampSteps; ++i) {
    const bool last = i == kRampSteps - 1;
    EquilibriumOptions step = options;
    step.max_iterations = options.max_iterations - iterations;
    if (!last) step.tolerance = std::max(kRampTolerance, options.tolerance);
    ramp.set_gravity(potential.gravity() *
                     std::pow(kRampStart, 1 - static_cast<double>(i) / (kRampSteps - 1)));
    result = solve_equilibrium(ramp, result.x.size() > 0 ? result.x : x, step);
    cpu += result.cpu_seconds;
    iterations += result.newton_iterations;
    factorizations += result.factorizations;
    if (!last && !result.converged() && result.status != EquilibriumStatus::saddle) break;
  }
  result.cpu_seconds = cpu;
  result.newton_iterations = iterations;
  result.factorizations = factorizations;
  result.protocol = "ramp";
  return result;
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

Equilibrium drape_by_lobes(const Potential& potential, const Scene& scene, int lobes, double phase,
                           const EquilibriumOptions& options) {
  Equilibrium result =
      solve_equilibrium(potential, folded_state(potential.mesh(), scene, lobes, phase), options);
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
