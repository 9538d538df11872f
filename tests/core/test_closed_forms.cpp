// Equilibria that are known in closed form or from an ordinary differential equation.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <memory>

#include "core/equilibrium.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

constexpr double kGravity = 9.80665;

/// A fabric that bends alike in all directions.
Fabric plain_fabric(double k_b) {
  Fabric fabric;
  fabric.areal_density = 0.2;
  fabric.k_bu = fabric.k_bv = fabric.k_bh = k_b;
  return fabric;
}

TEST(ClosedForms, HangingStripStretchesUnderItsWeight) {
  const double width = 0.02;
  const auto d = std::make_shared<const Discretization>(strip(0.1, width, 4));
  Fabric fabric = plain_fabric(1e-6);
  fabric.k_u = 300;
  fabric.k_v = 500;
  fabric.k_h = 40;
  const Potential E(d, fabric, {}, kGravity);
  const Mesh& mesh = d->mesh();
  VecX x = flat_state(mesh);  // hung up: u becomes -z
  for (int v = 0; v < mesh.vertex_count(); ++v)
    x.segment<3>(3 * v) << 0, mesh.rest_uv(v, 1), -mesh.rest_uv(v, 0);
  const Equilibrium hanging = solve_equilibrium(E, x);
  ASSERT_TRUE(hanging.converged()) << name(hanging.status);

  // uniaxial modulus from C_uu = k_u + k_h/2, C_vv = k_v + k_h/2, C_uv = k_h/2
  const double C_uu = fabric.k_u + fabric.k_h / 2, C_vv = fabric.k_v + fabric.k_h / 2;
  const double modulus = C_uu - fabric.k_h * fabric.k_h / 4 / C_vv;
  const double length = mesh.rest_uv.col(0).maxCoeff();
  const double stretch = fabric.areal_density * kGravity * length * length / (2 * modulus);
  double mean = 0;
  int count = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.rest_uv(v, 0) > length - 1e-9) {
      mean += -hanging.x[3 * v + 2] - length;
      ++count;
    }
  // strains of 6e-4 are small to that order; the clamp holds the width on a fifth of the length,
  // which matters to (C_uv / C)^2 = 2e-3
  EXPECT_NEAR(mean / count / stretch, 1, 3e-3);
}

/// Drop of the tip of a heavy elastica clamped horizontally: B theta'' = -q (L - s) cos theta,
/// theta(0) = 0, theta'(L) = 0, by shooting with Runge and Kutta's method; q: weight per length and
/// width [N/m^2], B: rigidity [N m].
double elastica_drop(double B, double q, double L) {
  const int steps = 400;
  const double h = L / steps;
  double drop = 0;
  const auto end_curvature = [&](double start) {
    Vec3 y(0, start, 0);  // theta, theta', drop
    const auto rate = [&](double s, const Vec3& state) {
      return Vec3(state[1], -q / B * (L - s) * std::cos(state[0]), std::sin(state[0]));
    };
    for (int i = 0; i < steps; ++i) {
      const double s = i * h;
      const Vec3 k1 = rate(s, y), k2 = rate(s + h / 2, y + h / 2 * k1);
      const Vec3 k3 = rate(s + h / 2, y + h / 2 * k2), k4 = rate(s + h, y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    drop = y[2];
    return y[1];
  };
  double low = 0, high = q * L * L / B;  // the moment of the weight at full reach bounds theta'(0)
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (end_curvature(middle) < 0 ? low : high) = middle;
  }
  return drop;
}

TEST(ClosedForms, ElasticaItselfHasTheSmallDeflectionOfABeam) {
  const double B = 1, q = 1e-3, L = 1;
  EXPECT_NEAR(elastica_drop(B, q, L), q / (8 * B), 1e-9);  // q L^4 / (8 B), cubic corrections
}

TEST(ClosedForms, CantileverFollowsTheHeavyElastica) {
  const double kappa = 0.01;
  const auto d = std::make_shared<const Discretization>(strip(0.05, 0.03, 6));
  const Mesh& mesh = d->mesh();
  const double length = mesh.rest_uv.col(0).maxCoeff();
  for (const double k_b : {2e-5, 2e-6}) {  // slopes of the tip from 10 to 60 degrees
    const Fabric fabric = plain_fabric(k_b);
    // the mesh's own rigidity for a cylinder that begins at the clamp
    const double area = length * 0.03;
    const double B =
        2 * bending_energy(mesh, fabric, cylinder(mesh, kappa, 0, true)) / (kappa * kappa * area);
    EXPECT_GT(B / k_b, 3.6);
    EXPECT_LT(B / k_b, 4.2);

    const double expected = elastica_drop(B, fabric.areal_density * kGravity, length);

    const Potential E(d, fabric, {}, kGravity);
    const VecX start = cylinder(mesh, 2 * expected / (length * length), 0, true);
    const Equilibrium hanging = solve_equilibrium(E, start);
    ASSERT_TRUE(hanging.converged()) << name(hanging.status);
    double drop = 0;
    int count = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.rest_uv(v, 0) > length - 1e-9) {
        drop -= hanging.x[3 * v + 2];
        ++count;
      }
    // edges bend sideways (nu = -1/3), which a strip 0.03 wide resists all but near its sides
    EXPECT_NEAR(drop / count / expected, 1, 0.02) << "k_b " << k_b;
  }
}

/// Deflection at the rim r = b of an annular plate clamped at r = a, free at b, under a uniform
/// load q (Kirchhoff): w = q r^4 / (64 B) + c0 + c1 ln r + c2 r^2 + c3 r^2 ln r.
double annulus_sag(double B, double q, double a, double b, double nu) {
  const auto row = [](double r, int derivative) -> Eigen::RowVector4d {
    const double l = std::log(r);
    if (derivative == 0) return {1, l, r * r, r * r * l};
    if (derivative == 1) return {0, 1 / r, 2 * r, 2 * r * l + r};
    return {0, -1 / (r * r), 2, 2 * l + 3};
  };
  Eigen::Matrix4d A;
  Eigen::Vector4d load;
  A.row(0) = row(a, 0);
  A.row(1) = row(a, 1);
  A.row(2) = row(b, 2) + nu / b * row(b, 1);
  A.row(3) << 0, 0, 0, 4 / b;  // shear force: d/dr of the Laplacian, 4 (c2 + c3 (ln r + 1))
  const double p = q / (64 * B);
  load << -p * std::pow(a, 4), -4 * p * std::pow(a, 3), -p * (12 + 4 * nu) * b * b, -32 * p * b;
  const Eigen::Vector4d c = A.partialPivLu().solve(load);
  return p * std::pow(b, 4) + row(b, 0) * c;
}

TEST(ClosedForms, ClampedAnnulusSagsLikeAPlateWithNuMinusOneThird) {
  const auto d = disc(1000);
  const double k_b = 5e-2;  // sag far below the thickness of an equal plate, sqrt(12 B / k)
  const Fabric fabric = plain_fabric(k_b);
  const Potential E(d, fabric, {}, kGravity);
  const Equilibrium plate = solve_equilibrium(E, flat_state(d->mesh()));
  ASSERT_TRUE(plate.converged()) << name(plate.status);
  double sag = 0;
  for (const int v : d->mesh().boundary) sag -= plate.x[3 * v + 2];
  sag /= static_cast<double>(d->mesh().boundary.size());
  const double B = 4.15 * k_b, q = fabric.areal_density * kGravity;  // isotropic meshes
  const double expected =
      annulus_sag(B, q, kCusick.support_radius, kCusick.specimen_radius, -1.0 / 3);
  EXPECT_NEAR(sag / expected, 1, 0.05);  // O(h) at the clamp: 7 % at 500 vertices
  // the wrong Poisson's ratio would be seen
  const double steel = annulus_sag(B, q, kCusick.support_radius, kCusick.specimen_radius, 0.3);
  EXPECT_GT(std::abs(sag / steel - 1), 0.05) << sag << " " << steel;
}

}  // namespace
}  // namespace drape::test
