#include "experiments/hard_cases.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/drape_protocol.h"
#include "core/equilibrium.h"
#include "experiments/model.h"
#include "experiments/study_fabrics.h"

namespace drape {
namespace {

constexpr double kRigidityOverStiffness = 4;  // B / k_b (bending.h)
constexpr double kShearOverStretch = 0.03;
constexpr double kVanishing = 1e-12;  // k_b [N m]
constexpr double kNeedle = 1e-3;      // height over edge
constexpr int kNeedles = 5;
constexpr double kSoftening = 0.05, kStiffening = 20;  // s_b
constexpr double kThreshold = 0.25;                    // t_b: a radius of about 20 mm
constexpr double kSweepStep = 0.02, kSweepEnd = 3;     // of the logarithm of k_b
constexpr double kSnap = 2e-3;                         // jump of a vertex [m]
constexpr double kBeforeSnap = 1e-5;                   // of the logarithm of k_b

/// The mesh with some free vertices moved almost onto an edge opposite to them.
Mesh with_needles(const Mesh& mesh) {
  Points2 uv = mesh.rest_uv;
  std::set<int> touched;
  int needles = 0;
  for (int t = 0; t < mesh.triangle_count() && needles < kNeedles; ++t) {
    const int v = mesh.triangles(t, 0), a = mesh.triangles(t, 1), b = mesh.triangles(t, 2);
    const auto taken = [&](int i) { return touched.contains(i); };
    if (mesh.fixed[static_cast<size_t>(v)] || std::ranges::count(mesh.boundary, v) > 0 ||
        taken(v) || taken(a) || taken(b))
      continue;
    Points2 moved = uv;
    const Vec2 edge = uv.row(b) - uv.row(a), normal(-edge.y(), edge.x());
    moved.row(v) = 0.5 * (uv.row(a) + uv.row(b)) + kNeedle * normal.transpose();
    try {  // the triangles around must stay counter-clockwise
      make_mesh(moved, mesh.triangles, mesh.fixed, mesh.clamp_wing_factor);
    } catch (const std::invalid_argument&) {
      continue;
    }
    uv = moved;
    ++needles;
    for (int i = 0; i < mesh.triangle_count(); ++i)
      for (int k = 0; k < 3; ++k)
        if (mesh.triangles(i, k) == v)
          for (int other = 0; other < 3; ++other) touched.insert(mesh.triangles(i, other));
  }
  return make_mesh(uv, mesh.triangles, mesh.fixed, mesh.clamp_wing_factor);
}

Fabric with_bending_scaled(Fabric fabric, double factor) {
  for (Parameter k : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh}) fabric[k] *= factor;
  return fabric;
}

/// The folded drape softened in bending until it snaps: the fabric just before that, and the
/// equilibrium of one a little stiffer.
Problem near_snap(const Settings& settings, Potential potential) {
  const Fabric fabric = potential.fabric();
  const EquilibriumOptions options{.tolerance = 1e-9};
  Equilibrium at = drape_by_lobes(potential, settings.scene, settings.start.lobes,
                                  settings.start.phase, options);
  double log_factor = 0, step = kSweepStep;
  VecX start = at.x;
  while (log_factor < kSweepEnd) {
    potential.set_fabric(with_bending_scaled(fabric, std::exp(-log_factor - step)));
    const Equilibrium next = solve_equilibrium(potential, at.x, options, at.preconditioner);
    const bool snapped = !next.converged() || largest_distance(next.x, at.x) > kSnap;
    if (!snapped) {
      if (step == kSweepStep) start = at.x;
      at = next;
      log_factor += step;
    } else {
      step /= 2;
      if (step < kBeforeSnap) {
        potential.set_fabric(with_bending_scaled(fabric, std::exp(-log_factor)));
        return {potential, start};
      }
    }
  }
  throw std::runtime_error("near_snap: this branch has no snap on this mesh");
}

}  // namespace

const std::vector<std::string>& hard_cases() {
  static const std::vector<std::string> names{
      "vanishing_bending",    "ratio_1e8", "needles",  "threshold_softening",
      "threshold_stiffening", "secant",    "near_snap"};
  return names;
}

Fabric make_fabric(const Scene& scene, double membrane_to_bending, double areal_density) {
  Fabric fabric = study_fabric(1).fabric;
  const double overhang = scene.specimen_radius - scene.support_radius;
  fabric.k_u = fabric.k_v =
      membrane_to_bending * kRigidityOverStiffness * fabric.k_bh / (overhang * overhang);
  fabric.k_h = kShearOverStretch * fabric.k_u;
  fabric.areal_density = areal_density;
  return fabric;
}

Problem hard_case(const std::string& name, const Settings& settings, int vertices) {
  Fabric fabric = study_fabric(1).fabric;
  Settings changed = settings;
  auto mesh = make_discretization(settings, vertices);
  const auto past_threshold = [&](double s_b) {
    fabric.s_bu = fabric.s_bv = fabric.s_bh = s_b;
    fabric.t_bu = fabric.t_bv = fabric.t_bh = kThreshold;
    changed.reading.threshold = BendingThreshold::radius;
  };
  if (name == "vanishing_bending") {
    fabric.k_bu = fabric.k_bv = fabric.k_bh = kVanishing;
  } else if (name == "ratio_1e8") {
    fabric = make_fabric(settings.scene, 1e8, fabric.areal_density);
  } else if (name == "needles") {
    mesh = std::make_shared<const Discretization>(with_needles(mesh->mesh()),
                                                  settings.solver.factorization);
  } else if (name == "threshold_softening") {
    past_threshold(kSoftening);
  } else if (name == "threshold_stiffening") {
    past_threshold(kStiffening);
  } else if (name == "secant") {
    past_threshold(0.5);
    changed.reading.law = BendingLaw::secant;
  }
  Potential potential = make_potential(mesh, fabric, changed);
  if (name == "near_snap") return near_snap(settings, std::move(potential));
  return {potential,
          folded_state(mesh->mesh(), settings.scene, settings.start.lobes, settings.start.phase)};
}

}  // namespace drape
