// XPBD (Macklin et al. 2016) with small steps (Macklin et al. 2019): one Gauss-Seidel sweep a time
// step over compliant constraints,
//
//   C = |w| - 1, compliance 1/(k A), and C = delta, compliance delta/U'(delta), which is the
//   constant 1/(2 k_b w) of the energy where s_b = 1,
//
// with viscous damping in proportion to the masses as in explicit dynamics. A constraint with a
// large stiffness over mass converges slowly: what is left of it after one sweep is carried into
// the next step, and the state comes to rest without equilibrium of forces. The smaller h, the
// closer and the slower; the h here comes to rest within a few seconds at a thousand vertices.
#include <cmath>

#include "benchmarks/baselines/constraints.h"
#include "benchmarks/baselines/lumped_mass.h"
#include "benchmarks/baselines/methods.h"

namespace drape::baselines {
namespace {

constexpr double kStep = 1e-4;   // h [s]
constexpr double kDamping = 40;  // [1/s]
constexpr double kFlat = 1e-12;  // fold angle below which its compliance is that of a flat wing

/// Positions with their inverse masses, 0 at fixed vertices.
struct Particles {
  VecX x, inverse_mass;

  double weight(int v) const { return inverse_mass[3 * v]; }
  void move(int v, const Vec3& by) { x.segment<3>(3 * v) += weight(v) * by; }
};

/// The multiplier's change for a constraint of value C, whose multiplier was 0 before this sweep.
double multiplier(double C, double gradient_square, double compliance, double h) {
  return -C / (gradient_square + compliance / (h * h));
}

void satisfy(const Direction& direction, double h, Particles& p) {
  const Vec3 w = direction.stretched(p.x);
  const double length = w.norm();
  double gradient_square = 0;
  for (size_t i = 0; i < 3; ++i) {
    const double c = direction.c[static_cast<Eigen::Index>(i)];
    gradient_square += p.weight(direction.vertices[i]) * c * c;
  }
  const Vec3 push =
      multiplier(length - 1, gradient_square, 1 / direction.stiffness, h) / length * w;
  for (size_t i = 0; i < 3; ++i)
    p.move(direction.vertices[i], direction.c[static_cast<Eigen::Index>(i)] * push);
}

void satisfy(const BentWing& wing, double h, Particles& p) {
  const Corners4<double> corners = wing.corners(p.x);
  const double delta = fold_angle(corners);
  const double compliance = std::abs(delta) < kFlat ? 1 / bending(wing.law, 0).tangent
                                                    : delta / bending(wing.law, delta).moment;
  if (!std::isfinite(compliance)) return;
  const Vec12 d = fold_angle_gradient(corners);
  double gradient_square = 0;
  for (size_t i = 0; i < 4; ++i)
    gradient_square +=
        p.weight(wing.vertices[i]) * d.segment<3>(3 * static_cast<Eigen::Index>(i)).squaredNorm();
  const double lambda = multiplier(delta, gradient_square, compliance, h);
  for (size_t i = 0; i < 4; ++i)
    p.move(wing.vertices[i], lambda * d.segment<3>(3 * static_cast<Eigen::Index>(i)));
}

}  // namespace

VecX xpbd(const Potential& potential, VecX x, Course& course) {
  const Constraints constraints = constraints_of(potential);
  const double h = course.time_step(kStep);
  Particles p{std::move(x), VecX::Zero(constraints.weight.size())};
  const VecX mass = lumped_masses(potential);
  for (int v : potential.discretization().free_vertices())
    p.inverse_mass.segment<3>(3 * v) = mass.segment<3>(3 * v).cwiseInverse();
  VecX v = VecX::Zero(p.x.size());
  for (;;) {
    v = v / (1 + kDamping * h) - h * constraints.weight.cwiseProduct(p.inverse_mass);
    const VecX before = p.x;
    p.x += h * v;
    for (const Direction& direction : constraints.directions) satisfy(direction, h, p);
    for (const BentWing& wing : constraints.wings) satisfy(wing, h, p);
    v = (p.x - before) / h;
    if (!course.go_on(p.x)) return p.x;
  }
}

}  // namespace drape::baselines
