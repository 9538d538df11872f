#include "core/indefinite_factor.h"

namespace drape {

bool IndefiniteFactor::factorize(const SparseMatrix& lower) {
  if (!Eigen::Map<const VecX>(lower.valuePtr(), lower.nonZeros()).allFinite()) return false;
  if (!analysed_) factor_.analyzePattern(lower);
  analysed_ = true;
  factor_.factorize(lower);
  return factor_.info() == Eigen::Success;
}

int IndefiniteFactor::negative_eigenvalues() const {
  return static_cast<int>((factor_.vectorD().array() < 0).count());
}

VecX IndefiniteFactor::solve(const VecX& b) const { return factor_.solve(b); }

}  // namespace drape
