// What all potentials on one mesh share: the order of the free degrees of freedom, the sparsity of
// the Hessian, where every element block goes, and the symbolic factorisation. Built once a mesh.
//
// The free vertices are numbered by nested dissection (METIS), so that every factorisation may take
// the matrix in its natural order. Assembly gathers instead of scattering: each entry of the result
// adds its element contributions in a fixed order, so that it does not depend on the number of
// threads.
#pragma once

#include <memory>
#include <vector>

#include "core/mesh.h"
#include "core/sparse_factor.h"
#include "core/types.h"

namespace drape {

/// One element block that adds to a 3x3 block of the Hessian.
struct BlockSource {
  int block;       ///< index into the element blocks (see Discretization::triangle_block)
  bool transpose;  ///< the stored block is the transpose of the one needed
};

class Discretization {
 public:
  explicit Discretization(Mesh mesh, FactorBackend backend = default_factor_backend());

  const Mesh& mesh() const { return mesh_; }
  int free_vertex_count() const { return static_cast<int>(free_vertices_.size()); }
  /// Free vertices in the order of the unknowns.
  const std::vector<int>& free_vertices() const { return free_vertices_; }
  /// Triangles with a free vertex.
  const std::vector<int>& active_triangles() const { return active_triangles_; }

  /// Entries of the free vertices of a 3n vector, in the order of the unknowns, and back (fixed:
  /// 0).
  VecX to_free(const VecX& full) const;
  VecX to_full(const VecX& free) const;

  /// Element blocks of a Hessian, lower ones only (corner i >= corner j), 3x3 column-major: six for
  /// every active triangle, then ten for every wing.
  int element_block_count() const;
  int triangle_block(int active_triangle) const { return 6 * active_triangle; }
  int wing_block(int wing) const {
    return 6 * static_cast<int>(active_triangles_.size()) + 10 * wing;
  }
  static int lower_index(int i, int j) { return i * (i + 1) / 2 + j; }

  /// Adds element blocks (9 doubles each) to a Hessian in the free order, lower triangle.
  void gather_hessian(const std::vector<double>& blocks, SparseMatrix& H) const;
  /// Adds 3 doubles per element corner (3 an active triangle, then 4 a wing) to a 3n vector.
  void gather_gradient(const std::vector<double>& corners, VecX& gradient) const;
  int element_corner_count() const;

  /// A zero matrix with the sparsity of the Hessian.
  const SparseMatrix& hessian_pattern() const { return pattern_; }
  /// Position in the values of the Hessian of the diagonal block of a free vertex (given as mesh
  /// vertex): entry (r, c), r >= c, of the block. -1 for a fixed vertex.
  int diagonal_entry(int vertex, int r, int c) const;
  std::shared_ptr<const SymbolicFactor> symbolic_factor() const { return symbolic_; }

 private:
  void order_free_vertices();
  void list_corner_sources();
  void list_block_sources();

  Mesh mesh_;
  std::vector<int> free_vertices_, slot_;  // slot_: vertex -> unknown, -1 if fixed
  std::vector<int> active_triangles_;
  std::vector<int> corner_start_, corner_sources_;   // per free vertex: element corners to add
  std::vector<int> block_column_start_, block_row_;  // block CSC, lower, diagonal block first
  std::vector<int> source_start_;                    // per block: range of sources
  std::vector<BlockSource> sources_;
  SparseMatrix pattern_;
  std::shared_ptr<const SymbolicFactor> symbolic_;
};

}  // namespace drape
