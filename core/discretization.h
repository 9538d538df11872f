// What all potentials on one mesh share: the order of the free degrees of freedom, the sparsity of
// the Hessian, where every element block goes, and the symbolic factorisation. Built once a mesh.
//
// The free vertices are numbered by nested dissection (METIS), so that every factorisation may take
// the matrix in its natural order. Elements are visited in the order of their first unknown, which
// keeps neighbours together in memory; evaluations are serial, so that their sums have one order.
#pragma once

#include <memory>
#include <vector>

#include "core/element_batches.h"
#include "core/mesh.h"
#include "core/sparse_factor.h"
#include "core/types.h"

namespace drape {

struct CoarseLevel;  // coarse_level.h

class Discretization {
 public:
  /// `coarse`: where drapes choose their branch; without it they do so on this mesh.
  explicit Discretization(Mesh mesh, FactorBackend backend = default_factor_backend(),
                          std::shared_ptr<const CoarseLevel> coarse = nullptr);

  const Mesh& mesh() const { return mesh_; }
  int free_vertex_count() const { return static_cast<int>(free_vertices_.size()); }
  /// Free vertices in the order of the unknowns.
  const std::vector<int>& free_vertices() const { return free_vertices_; }
  /// Triangles with a free vertex, in the order of the batches.
  const std::vector<int>& active_triangles() const { return active_triangles_; }

  /// Entries of the free vertices of a 3n vector, in the order of the unknowns, and back (fixed:
  /// 0).
  VecX to_free(const VecX& full) const;
  VecX to_full(const VecX& free) const;

  /// The active triangles and all wings, and where their blocks go in the values of a Hessian.
  const std::vector<TriangleBatch>& triangle_batches() const { return triangle_batches_; }
  const std::vector<WingBatch>& wing_batches() const { return wing_batches_; }
  const std::vector<TrianglePlaces>& triangle_places() const { return triangle_places_; }
  const std::vector<WingPlaces>& wing_places() const { return wing_places_; }

  /// A zero matrix with the sparsity of the Hessian.
  const SparseMatrix& hessian_pattern() const { return pattern_; }
  /// Makes H a zero matrix with that sparsity; where it has it already, only its values are set.
  void reset_hessian(SparseMatrix& H) const;
  /// Position in the values of the Hessian of the diagonal block of a free vertex (given as mesh
  /// vertex): entry (r, c), r >= c, of the block. -1 for a fixed vertex.
  int diagonal_entry(int vertex, int r, int c) const;
  std::shared_ptr<const SymbolicFactor> symbolic_factor() const { return symbolic_; }
  /// Null where there is none.
  const CoarseLevel* coarse() const { return coarse_.get(); }

 private:
  void order_free_vertices();
  void sort_elements();
  void build_pattern();
  BlockPlace block_place(int row_vertex, int column_vertex) const;
  void place_blocks();

  Mesh mesh_;
  std::vector<int> free_vertices_, slot_;  // slot_: vertex -> unknown, -1 if fixed
  std::vector<int> active_triangles_;
  std::vector<TriangleBatch> triangle_batches_;
  std::vector<WingBatch> wing_batches_;
  std::vector<TrianglePlaces> triangle_places_;
  std::vector<WingPlaces> wing_places_;
  SparseMatrix pattern_;
  std::shared_ptr<const SymbolicFactor> symbolic_;
  std::shared_ptr<const CoarseLevel> coarse_;
};

}  // namespace drape
