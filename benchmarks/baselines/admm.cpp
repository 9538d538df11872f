// ADMM in the manner of Overby et al. (2017), for the static problem: minimise sum_i U_i(z_i) with
// z_i = D_i x by
//
//   z_i <- argmin U_i(z) + omega_i/2 |D_i x - z + u_i|^2    (local, every element for itself)
//   u_i <- u_i + D_i x - z_i
//   x   <- argmin -weight.x + sum omega_i/2 |D_i x - z_i + u_i|^2    (one constant factor)
//
// Elements are the directions of the triangles, D x = w, with a closed local step, and the wings,
// D x = their three edges from x0, with a Newton iteration on the scalar fold angle. As there, the
// weights omega are the elements' own stiffnesses times a factor. The bending's is one for all
// fabrics. The membrane's best factor, found by hindsight in a grid (0.01 to 1, bending 3 to 100)
// over fabrics from soft to stiff, falls with the strain under the weight, nearly as its cube root;
// factors balanced by the residuals on the way (Boyd et al. 2011, 3.4.1) end further off. The
// energies are not convex: nothing ensures convergence, and none of that grid converged.
#include <Eigen/SparseCholesky>
#include <array>
#include <cmath>
#include <utility>

#include "benchmarks/baselines/constraints.h"
#include "benchmarks/baselines/methods.h"

namespace drape::baselines {
namespace {

constexpr double kMembraneWeight = 3, kBendingWeight = 10;  // omega over stiffness (and strain^1/3)
constexpr int kMostIterations = 8;                          // of a wing's local step
constexpr double kSmallChange = 1e-12;                      // of a wing's edges there [m]

using Edges = Eigen::Matrix<double, 3, 3>;  // x1 - x0, x2 - x0, x3 - x0 as columns

Corners4<double> corners_of(const Edges& edges) {
  Corners4<double> corners;
  corners << Vec3::Zero(), edges;
  return corners;
}

Edges angle_gradient(const Edges& edges) {
  return fold_angle_gradient(corners_of(edges)).tail<9>().reshaped(3, 3);
}

/// argmin of U(z) + omega/2 |z - p|^2, from z: along the gradient of the fold angle there its law
/// is linear, so that each iteration is a scalar equation.
Edges local_step(const WingLaw& law, double omega, const Edges& p, Edges z) {
  for (int i = 0; i < kMostIterations; ++i) {
    const Edges d = angle_gradient(z);
    const Bending b = bending(law, fold_angle(corners_of(z)));
    const double slope = b.moment + b.tangent * d.cwiseProduct(p - z).sum();
    const Edges next = p - slope / (omega + b.tangent * d.squaredNorm()) * d;
    const double change = (next - z).cwiseAbs().maxCoeff();
    z = next;
    if (!(change > kSmallChange)) break;
  }
  return z;
}

/// Of the order of the strains that the weight causes: its potential at the distance from the
/// centre over the membrane's stiffness [1].
double weight_strain(const Constraints& constraints, const VecX& rest) {
  double load = 0, stiffness = 0;
  for (Eigen::Index v = 0; v < rest.size() / 3; ++v)
    load += constraints.weight.segment<3>(3 * v).norm() * rest.segment<3>(3 * v).norm();
  for (const Direction& e : constraints.directions) stiffness += e.stiffness;
  return load / stiffness;
}

class Splitting {
 public:
  Splitting(const Potential& potential, const VecX& x)
      : all_(constraints_of(potential)), slot_(static_cast<size_t>(x.size() / 3), -1) {
    const std::vector<int>& free = potential.discretization().free_vertices();
    for (size_t i = 0; i < free.size(); ++i)
      slot_[static_cast<size_t>(free[i])] = static_cast<int>(i);
    const VecX rest = flat_state(potential.mesh());
    const double membrane_weight = kMembraneWeight * std::cbrt(weight_strain(all_, rest));
    for (const Direction& e : all_.directions) {
      direction_weight_.push_back(membrane_weight * e.stiffness);
      const Vec3 w = e.stretched(x);
      stretched_.push_back(w);
      direction_dual_.push_back(e.stiffness * (w.norm() - 1) / direction_weight_.back() *
                                w.normalized());
    }
    for (const BentWing& e : all_.wings) {
      const double k = 2 * e.law.stiffness;
      wing_weight_.push_back(kBendingWeight * k * angle_gradient(edges(e, rest)).squaredNorm());
      const Edges z = edges(e, x);
      edges_.push_back(z);
      wing_dual_.push_back(bending(e.law, fold_angle(corners_of(z))).moment / wing_weight_.back() *
                           angle_gradient(z));
    }
    factorize(static_cast<Eigen::Index>(free.size()));
  }

  void iterate(VecX& x) {
    MatX b = MatX::Zero(factor_.rows(), 3);
    for (size_t v = 0; v < slot_.size(); ++v)
      if (slot_[v] >= 0)
        b.row(slot_[v]) = -all_.weight.segment<3>(3 * static_cast<Eigen::Index>(v)).transpose();
    const auto pull = [&](int v, double c, const Vec3& aim) {
      if (const int row = slot_[static_cast<size_t>(v)]; row >= 0)
        b.row(row) += c * aim.transpose();
    };
    for (size_t i = 0; i < all_.directions.size(); ++i) {
      const Direction& e = all_.directions[i];
      const double omega = direction_weight_[i];
      const Vec3 w = e.stretched(x), p = w + direction_dual_[i];
      stretched_[i] = (e.stiffness + omega * p.norm()) / (e.stiffness + omega) * p.normalized();
      direction_dual_[i] = p - stretched_[i];
      const Vec3 aim = stretched_[i] - direction_dual_[i] - fixed_part(e.vertices, e.c, x);
      for (size_t k = 0; k < 3; ++k)
        pull(e.vertices[k], omega * e.c[static_cast<Eigen::Index>(k)], aim);
    }
    for (size_t i = 0; i < all_.wings.size(); ++i) {
      const BentWing& e = all_.wings[i];
      const double omega = wing_weight_[i];
      const Edges p = edges(e, x) + wing_dual_[i];
      edges_[i] = local_step(e.law, omega, p, edges_[i]);
      wing_dual_[i] = p - edges_[i];
      for (size_t k = 1; k < 4; ++k) {
        const std::array<int, 2> ends{e.vertices[0], e.vertices[k]};
        const Vec2 c(-1, 1);
        const auto column = static_cast<Eigen::Index>(k - 1);
        const Vec3 aim = edges_[i].col(column) - wing_dual_[i].col(column) - fixed_part(ends, c, x);
        pull(ends[0], -omega, aim);
        pull(ends[1], omega, aim);
      }
    }
    const MatX solution = factor_.solve(b);
    for (size_t v = 0; v < slot_.size(); ++v)
      if (slot_[v] >= 0)
        x.segment<3>(3 * static_cast<Eigen::Index>(v)) = solution.row(slot_[v]).transpose();
  }

 private:
  static Edges edges(const BentWing& wing, const VecX& x) {
    const Corners4<double> corners = wing.corners(x);
    return corners.rightCols<3>().colwise() - corners.col(0);
  }

  /// What the fixed vertices contribute to sum c_i x_i.
  template <size_t kVertices, typename Coefficients>
  Vec3 fixed_part(const std::array<int, kVertices>& vertices, const Coefficients& c,
                  const VecX& x) const {
    Vec3 sum = Vec3::Zero();
    for (size_t k = 0; k < kVertices; ++k)
      if (slot_[static_cast<size_t>(vertices[k])] < 0)
        sum += c[static_cast<Eigen::Index>(k)] * position(x, vertices[k]);
    return sum;
  }

  /// sum omega_i D_i^T D_i over the free vertices, the same for the three coordinates.
  void factorize(Eigen::Index size) {
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](const auto& vertices, const auto& c, double omega) {
      for (size_t i = 0; i < vertices.size(); ++i)
        for (size_t j = 0; j < vertices.size(); ++j) {
          const int row = slot_[static_cast<size_t>(vertices[i])];
          const int column = slot_[static_cast<size_t>(vertices[j])];
          if (row >= 0 && column >= 0)
            entries.emplace_back(
                row, column,
                omega * c[static_cast<Eigen::Index>(i)] * c[static_cast<Eigen::Index>(j)]);
        }
    };
    for (size_t i = 0; i < all_.directions.size(); ++i)
      add(all_.directions[i].vertices, all_.directions[i].c, direction_weight_[i]);
    for (size_t i = 0; i < all_.wings.size(); ++i)
      for (size_t k = 1; k < 4; ++k)
        add(std::array<int, 2>{all_.wings[i].vertices[0], all_.wings[i].vertices[k]}, Vec2(-1, 1),
            wing_weight_[i]);
    SparseMatrix A(size, size);
    A.setFromTriplets(entries.begin(), entries.end());
    factor_.compute(A);
  }

  Constraints all_;
  std::vector<int> slot_;  // of a vertex among the free ones, -1 if fixed
  std::vector<double> direction_weight_, wing_weight_;  // omega
  std::vector<Vec3> stretched_, direction_dual_;        // z and u
  std::vector<Edges> edges_, wing_dual_;                // z and u
  // in the order of the unknowns, which is fill-reducing
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factor_;
};

}  // namespace

VecX admm(const Potential& potential, VecX x, Course& course) {
  Splitting splitting(potential, x);
  do {
    splitting.iterate(x);
  } while (course.go_on(x));
  return x;
}

}  // namespace drape::baselines
