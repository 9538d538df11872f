// Smooth transfer of a state from one mesh of a specimen to another, for coarse-to-fine solves.
//
// Moving least squares (Lancaster and Salkauskas 1981) on the displacement u = x - rest: at every
// free vertex of the target the quadratic that fits the displacements of the source vertices around
// it, weighted by Wendland's C2 function of their rest distance over one support radius for the
// whole mesh. The result is a C2 function of the place, so that no facets of the source show, and
// quadratic displacement fields are reproduced exactly. Fixed vertices stay exactly at rest.
#pragma once

#include <Eigen/SparseCore>

#include "core/mesh.h"
#include "core/types.h"

namespace drape {

/// Built once for a pair of meshes in O(n log n) at most; applying it is a sparse product.
class Transfer {
 public:
  /// Throws std::invalid_argument where a free vertex of `to` lies so far from `from` that the fit
  /// around it is not determined (meshes of different specimens).
  Transfer(const Mesh& from, const Mesh& to);

  /// x: state on `from`, 3n [m]. Returns the state on `to`.
  VecX operator()(const VecX& x) const;

  /// The linear map of displacements: a row a vertex of `to` (empty for fixed ones), a column a
  /// vertex of `from`. Rows of free vertices sum to 1.
  const Eigen::SparseMatrix<double, Eigen::RowMajor>& weights() const { return weights_; }

 private:
  VecX rest_from_, rest_to_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> weights_;
};

}  // namespace drape
