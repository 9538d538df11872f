#include "estimation/bending_rigidity.h"

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace drape {
namespace {

/// 4 M for equilateral wings in all directions alike: a bend of curvature kappa opens a wing at
/// angle a from it by kappa L (cos^2 a - sin^2 a / 3), and M averages the square of the bracket
/// over the hats of Eq. 4. Rows sum to one.
Mat3 rigidity_matrix() {
  return 4 * Mat3{{0.587737, 0.047358, 0.364905},
                  {0.047358, 0.587737, 0.364905},
                  {0.182453, 0.182453, 0.635095}};
}

}  // namespace

Vec3 effective_rigidity(const Fabric& fabric) {
  return rigidity_matrix() * Vec3(fabric.k_bu, fabric.k_bv, fabric.k_bh);
}

HingeStiffness hinge_stiffness(const Vec3& rigidity) {
  if (!rigidity.allFinite() || rigidity.minCoeff() <= 0) {
    std::ostringstream message;
    message << "the rigidities (B_u, B_v, B_45) are (" << rigidity.transpose()
            << ") N m; each must be positive and finite";
    throw std::invalid_argument(message.str());
  }
  const Mat3 A = rigidity_matrix();
  // The optimum is the least-squares solution on the set of its positive entries; of the seven
  // candidate sets (bit i set: k_b[i] is free) the best feasible one is therefore the exact answer.
  HingeStiffness best{Vec3::Zero(), std::numeric_limits<double>::infinity()};
  for (int set = 1; set < 8; ++set) {
    std::vector<int> free;
    for (int i = 0; i < 3; ++i)
      if (set & (1 << i)) free.push_back(i);
    const MatX columns = A(Eigen::all, free);
    const VecX solution = columns.colPivHouseholderQr().solve(rigidity);
    if (solution.minCoeff() < 0) continue;
    const double misfit = (columns * solution - rigidity).norm() / rigidity.norm();
    if (misfit >= best.misfit) continue;
    best.k_b.setZero();
    best.k_b(free) = solution;
    best.misfit = misfit;
  }
  return best;
}

}  // namespace drape
