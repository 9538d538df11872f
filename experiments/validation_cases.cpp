#include "experiments/validation_cases.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/bending.h"
#include "core/dihedral_angle.h"
#include "core/equilibrium.h"

namespace drape {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// The rest state on a cylinder of curvature kappa; flat where `one_sided` and along < 0.
VecX cylinder(const Mesh& mesh, double kappa, double angle, bool one_sided) {
  const Vec2 along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
  VecX x = flat_state(mesh);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Vec2 uv = mesh.rest_uv.row(v);
    const double s = uv.dot(along);
    if (one_sided && s <= 0) continue;
    const Vec2 plane = std::sin(kappa * s) / kappa * along + uv.dot(across) * across;
    x.segment<3>(3 * v) << plane, -(1 - std::cos(kappa * s)) / kappa;
  }
  return x;
}

/// A fabric with one bending stiffness, never past the threshold.
Fabric evenly_bent(Fabric fabric, double k_b) {
  fabric.k_bu = fabric.k_bv = fabric.k_bh = k_b;
  fabric.s_bu = fabric.s_bv = fabric.s_bh = 1;
  return fabric;
}

double energy_of(const Wing& wing, const Fabric& fabric, const VecX& x) {
  Corners4<double> corners;
  for (size_t k = 0; k < 4; ++k)
    corners.col(static_cast<Eigen::Index>(k)) = position(x, wing.vertices[k]);
  return wing_energy(wing_law(wing, fabric, {}), fold_angle(corners));
}

/// Comparison::radial_energy_ratio of a fabric whose bulk rigidity on the mesh is B.
double radial_energy_ratio(const Mesh& mesh, const Scene& scene, const Fabric& fabric, double B) {
  const double a = scene.support_radius, b = scene.specimen_radius, nu = -1.0 / 3;
  const double kappa = 1e-2;  // a sag of 2e-5 m: angles are small
  VecX x = flat_state(mesh);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    x[3 * v + 2] = -kappa / 2 * std::pow(std::max(0.0, mesh.rest_uv.row(v).norm() - a), 2);
  double energy = 0;
  for (const Wing& wing : mesh.wings) energy += energy_of(wing, fabric, x);
  // Kirchhoff: pi B times the integral of (k_r^2 + k_t^2 + 2 nu k_r k_t) r dr, k_t = kappa (r-a)/r
  const double l = b - a, logarithm = std::log(b / a);
  const double radial = (b * b - a * a) / 2;
  const double tangential = (b * b - a * a) / 2 - 2 * a * l + a * a * logarithm;
  const double mixed = l * l / 2;
  return energy / (kPi * B * kappa * kappa * (radial + tangential + 2 * nu * mixed));
}

Comparison solved(const Potential& potential, const Equilibrium& equilibrium) {
  Comparison result;
  result.status = name(equilibrium.status);
  result.vertices = potential.mesh().vertex_count();
  result.residual = equilibrium.residual;
  result.cpu_seconds = equilibrium.cpu_seconds;
  return result;
}

}  // namespace

CylinderRigidity cylinder_rigidity(const Mesh& mesh, const Fabric& fabric, double angle) {
  const double kappa = 0.1;  // fold angles of 1e-3: the dependence on kappa^2 is gone
  const VecX x = cylinder(mesh, kappa, angle, false);
  double energy = 0, wing_area = 0, free_area = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (!mesh.triangle_is_fixed(t)) free_area += mesh.rest[static_cast<size_t>(t)].area;
  for (Wing wing : mesh.wings) {
    // a wing on the clamp line belongs to the free area by half
    const double share = wing.on_clamp_line ? 0.5 : 1;
    if (wing.on_clamp_line) wing.weight /= mesh.clamp_wing_factor;
    energy += share * energy_of(wing, fabric, x);
    const Vec2 edge = mesh.rest_uv.row(wing.vertices[1]) - mesh.rest_uv.row(wing.vertices[0]);
    wing_area += share * edge.norm() * wing.mean_height / 3;
  }
  const double scale = 2 / (kappa * kappa);
  return {scale * energy / wing_area, scale * energy / free_area};
}

Comparison cantilever(const StripMeshOptions& strip, Fabric fabric, double slenderness,
                      double gravity) {
  const auto d = std::make_shared<const Discretization>(make_strip_mesh(strip));
  const Mesh& mesh = d->mesh();
  const double q = fabric.areal_density * gravity;
  const double B = q * std::pow(strip.length / slenderness, 3);
  const CylinderRigidity unit = cylinder_rigidity(mesh, evenly_bent(fabric, 1), strip.angle);
  fabric = evenly_bent(fabric, B / unit.bulk);

  const double modulus =
      reference::uniaxial_modulus({fabric.k_u, fabric.k_v, fabric.k_h}, strip.angle);
  const reference::StripSection section{B, -1.0 / 3, strip.width, modulus};
  const double expected = reference::heavy_elastica(section, q, strip.length).drop;
  const Potential potential(d, fabric, {}, gravity);
  const double start = std::min(2 * expected / (strip.length * strip.length), 1.5 / strip.length);
  const Equilibrium hanging =
      solve_equilibrium(potential, cylinder(mesh, start, strip.angle, true));

  Comparison result = solved(potential, hanging);
  result.rigidity_over_k = unit.bulk;
  result.mean_rigidity_over_k = unit.mean;
  result.expected = expected;
  int tip = 0;
  double sum = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (place_in_strip(strip, mesh.rest_uv.row(v)).x() > strip.length * (1 - 1e-9)) {
      sum -= hanging.x[3 * v + 2];
      ++tip;
    }
  result.measured = sum / tip;
  return result;
}

Comparison hanging_strip(const StripMeshOptions& strip, const Fabric& fabric, double gravity) {
  const auto d = std::make_shared<const Discretization>(make_strip_mesh(strip));
  const Mesh& mesh = d->mesh();
  const Potential potential(d, fabric, {}, gravity);
  VecX x = flat_state(mesh);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Vec2 place = place_in_strip(strip, mesh.rest_uv.row(v));
    x.segment<3>(3 * v) << place.y(), 0, -place.x();
  }
  const Equilibrium hanging = solve_equilibrium(potential, x);

  const reference::Stretch k{fabric.k_u, fabric.k_v, fabric.k_h};
  const double q = fabric.areal_density * gravity, quarter = strip.length / 4;
  const auto displacement = [&](double s) {
    return reference::hanging_displacement(k, strip.angle, q, strip.length, s);
  };
  // differences from the reference below the first quarter, whose own displacement is their mean
  std::vector<double> difference, tip;
  double sum = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const double s = place_in_strip(strip, mesh.rest_uv.row(v)).x();
    if (s < quarter) continue;
    difference.push_back(-hanging.x[3 * v + 2] - s - displacement(s));
    sum += difference.back();
    if (s > strip.length * (1 - 1e-9)) tip.push_back(difference.back());
  }
  const double offset = sum / static_cast<double>(difference.size());
  Comparison result = solved(potential, hanging);
  result.expected = displacement(strip.length) - displacement(quarter);
  double tip_mean = 0;
  for (const double t : tip) tip_mean += t / static_cast<double>(tip.size());
  result.measured = result.expected + tip_mean - offset;
  for (const double t : difference)
    result.worst_place = std::max(result.worst_place, std::abs(t - offset) / result.expected);
  return result;
}

Comparison annulus_sag(const DiscMeshOptions& disc) {
  const Scene scene;
  const auto d = std::make_shared<const Discretization>(make_disc_mesh(scene, disc));
  Fabric fabric = evenly_bent({}, 1);
  const CylinderRigidity unit = cylinder_rigidity(d->mesh(), fabric, 0);
  // B = .2 N m: the sag of 1.6e-5 m is 1/2000 of sqrt(12 B/k_u), the thickness of an equal plate,
  // and stretches it by nothing
  const double B = 0.2, q = fabric.areal_density * scene.gravity;
  fabric = evenly_bent(fabric, B / unit.bulk);
  const Potential potential(d, fabric, {}, scene.gravity);
  const Equilibrium plate = solve_equilibrium(potential, flat_state(d->mesh()));
  Comparison result = solved(potential, plate);
  result.rigidity_over_k = unit.bulk;
  result.mean_rigidity_over_k = unit.mean;
  result.radial_energy_ratio = radial_energy_ratio(d->mesh(), scene, fabric, B);
  result.expected =
      reference::annulus_sag(B, q, scene.support_radius, scene.specimen_radius, -1.0 / 3);
  for (const int v : d->mesh().boundary) result.measured -= plate.x[3 * v + 2];
  result.measured /= static_cast<double>(d->mesh().boundary.size());
  return result;
}

}  // namespace drape
