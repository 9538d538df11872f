#include "core/discretization.h"

#include <metis.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

namespace drape {
namespace {

/// Calls visit(vertices, count) for every element.
template <typename Visit>
void for_each_element(const Mesh& mesh, const std::vector<int>& triangles, Visit visit) {
  for (const int t : triangles) {
    const int vertices[3] = {mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)};
    visit(vertices, 3);
  }
  for (const Wing& wing : mesh.wings) visit(wing.vertices.data(), 4);
}

/// Calls visit(batch, lane, i, j, block) for the lower blocks of all lanes that hold an element.
template <int kCorners, typename Batch, typename Visit>
void for_each_block(const std::vector<Batch>& batches, size_t elements, Visit visit) {
  for (size_t e = 0; e < elements; ++e)
    for (int i = 0; i < kCorners; ++i)
      for (int j = 0; j <= i; ++j) {
        const size_t batch = e / kLanes, lane = e % kLanes;
        visit(batch, lane, batches[batch].vertices[i][lane], batches[batch].vertices[j][lane],
              lower_index(i, j));
      }
}

/// Fill-reducing order: result[k] is the k-th node to eliminate.
std::vector<int> nested_dissection(const std::vector<std::set<int>>& neighbours) {
  auto n = static_cast<idx_t>(neighbours.size());
  std::vector<idx_t> start{0}, adjacent;
  for (const auto& list : neighbours) {
    adjacent.insert(adjacent.end(), list.begin(), list.end());
    start.push_back(static_cast<idx_t>(adjacent.size()));
  }
  std::vector<idx_t> order(neighbours.size()), inverse(neighbours.size());
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  if (METIS_NodeND(&n, start.data(), adjacent.data(), nullptr, options, order.data(),
                   inverse.data()) != METIS_OK)
    throw std::runtime_error("discretization: METIS could not order the vertices");
  return {order.begin(), order.end()};
}

}  // namespace

Discretization::Discretization(Mesh mesh, FactorBackend backend,
                               std::shared_ptr<const CoarseLevel> coarse)
    : mesh_(std::move(mesh)), coarse_(std::move(coarse)) {
  for (int t = 0; t < mesh_.triangle_count(); ++t)
    if (!mesh_.triangle_is_fixed(t)) active_triangles_.push_back(t);
  order_free_vertices();
  sort_elements();
  build_pattern();
  place_blocks();
  symbolic_ = std::make_shared<const SymbolicFactor>(pattern_, backend);
}

void Discretization::order_free_vertices() {
  slot_.assign(mesh_.fixed.size(), -1);
  for (int v = 0; v < mesh_.vertex_count(); ++v)
    if (!mesh_.fixed[static_cast<size_t>(v)]) {
      slot_[static_cast<size_t>(v)] = static_cast<int>(free_vertices_.size());
      free_vertices_.push_back(v);
    }
  if (free_vertices_.empty()) throw std::invalid_argument("mesh: every vertex is fixed");

  std::vector<std::set<int>> neighbours(free_vertices_.size());
  for_each_element(mesh_, active_triangles_, [&](const int* vertices, int count) {
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) {
        const int a = slot_[static_cast<size_t>(vertices[i])];
        const int b = slot_[static_cast<size_t>(vertices[j])];
        if (a >= 0 && b >= 0 && a != b) neighbours[static_cast<size_t>(a)].insert(b);
      }
  });
  std::vector<int> ordered;
  for (int k : nested_dissection(neighbours))
    ordered.push_back(free_vertices_[static_cast<size_t>(k)]);
  free_vertices_ = std::move(ordered);
  for (size_t k = 0; k < free_vertices_.size(); ++k)
    slot_[static_cast<size_t>(free_vertices_[k])] = static_cast<int>(k);
}

void Discretization::sort_elements() {
  const auto first_unknown = [&](const auto& vertices) {
    int first = free_vertex_count();
    for (const int v : vertices)
      if (const int a = slot_[static_cast<size_t>(v)]; a >= 0) first = std::min(first, a);
    return first;
  };
  const auto sort = [](std::vector<int>& elements, const auto& key) {
    std::stable_sort(elements.begin(), elements.end(),
                     [&](int p, int q) { return key(p) < key(q); });
  };
  sort(active_triangles_, [&](int t) { return first_unknown(mesh_.triangles.row(t)); });
  std::vector<int> wings(mesh_.wings.size());
  std::iota(wings.begin(), wings.end(), 0);
  sort(wings, [&](int w) { return first_unknown(mesh_.wings[static_cast<size_t>(w)].vertices); });
  triangle_batches_ = batches_of_triangles(mesh_, active_triangles_);
  wing_batches_ = batches_of_wings(mesh_, wings);
}

void Discretization::build_pattern() {
  std::vector<Eigen::Triplet<double>> triplets;
  for_each_element(mesh_, active_triangles_, [&](const int* vertices, int count) {
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) {
        const int a = slot_[static_cast<size_t>(vertices[i])];
        const int b = slot_[static_cast<size_t>(vertices[j])];
        if (a < b || b < 0) continue;
        for (int c = 0; c < 3; ++c)
          for (int r = a == b ? c : 0; r < 3; ++r) triplets.emplace_back(3 * a + r, 3 * b + c, 0.0);
      }
  });
  const int n = 3 * free_vertex_count();
  pattern_.resize(n, n);
  pattern_.setFromTriplets(triplets.begin(), triplets.end());
  pattern_.makeCompressed();
}

BlockPlace Discretization::block_place(int row_vertex, int column_vertex) const {
  const int a = slot_[static_cast<size_t>(row_vertex)];
  const int b = slot_[static_cast<size_t>(column_vertex)];
  if (a < 0 || b < 0) return {};
  const int row = 3 * std::max(a, b), column = 3 * std::min(a, b);
  const int start = pattern_.outerIndexPtr()[column], end = pattern_.outerIndexPtr()[column + 1];
  const int* const rows = pattern_.innerIndexPtr();
  const auto first = static_cast<int>(std::lower_bound(rows + start, rows + end, row) - rows);
  const int stride = end - start - 1;  // the next column has one entry less above the block
  return {first, a < b ? -stride : stride};
}

void Discretization::place_blocks() {
  triangle_places_.resize(triangle_batches_.size());
  for_each_block<3>(triangle_batches_, active_triangles_.size(),
                    [&](size_t batch, size_t lane, int row, int column, int block) {
                      triangle_places_[batch].block[block][lane] = block_place(row, column);
                    });
  wing_places_.resize(wing_batches_.size());
  for_each_block<4>(wing_batches_, mesh_.wings.size(),
                    [&](size_t batch, size_t lane, int row, int column, int block) {
                      wing_places_[batch].block[block][lane] = block_place(row, column);
                    });
}

void Discretization::reset_hessian(SparseMatrix& H) const {
  const bool has_pattern =
      H.isCompressed() && H.rows() == pattern_.rows() && H.nonZeros() == pattern_.nonZeros() &&
      std::equal(pattern_.outerIndexPtr(), pattern_.outerIndexPtr() + pattern_.outerSize(),
                 H.outerIndexPtr());
  if (has_pattern)
    std::fill_n(H.valuePtr(), H.nonZeros(), 0.0);
  else
    H = pattern_;
}

VecX Discretization::to_free(const VecX& full) const {
  VecX free(3 * free_vertex_count());
  for (size_t k = 0; k < free_vertices_.size(); ++k)
    free.segment<3>(3 * static_cast<Eigen::Index>(k)) = full.segment<3>(3 * free_vertices_[k]);
  return free;
}

VecX Discretization::to_full(const VecX& free) const {
  VecX full = VecX::Zero(3 * mesh_.vertex_count());
  for (size_t k = 0; k < free_vertices_.size(); ++k)
    full.segment<3>(3 * free_vertices_[k]) = free.segment<3>(3 * static_cast<Eigen::Index>(k));
  return full;
}

int Discretization::diagonal_entry(int vertex, int r, int c) const {
  const int a = slot_[static_cast<size_t>(vertex)];
  return a < 0 ? -1 : pattern_.outerIndexPtr()[3 * a + c] + r - c;
}

}  // namespace drape
