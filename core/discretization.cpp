#include "core/discretization.h"

#include <metis.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

namespace drape {
namespace {

/// Calls visit(vertices, count, first corner, first block) for every element.
template <typename Visit>
void for_each_element(const Discretization& d, Visit visit) {
  const Mesh& mesh = d.mesh();
  int corner = 0;
  for (size_t i = 0; i < d.active_triangles().size(); ++i) {
    const int t = d.active_triangles()[i];
    const int vertices[3] = {mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)};
    visit(vertices, 3, corner, d.triangle_block(static_cast<int>(i)));
    corner += 3;
  }
  for (size_t w = 0; w < mesh.wings.size(); ++w) {
    visit(mesh.wings[w].vertices.data(), 4, corner, d.wing_block(static_cast<int>(w)));
    corner += 4;
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

Discretization::Discretization(Mesh mesh, FactorBackend backend) : mesh_(std::move(mesh)) {
  for (int t = 0; t < mesh_.triangle_count(); ++t)
    if (!mesh_.triangle_is_fixed(t)) active_triangles_.push_back(t);
  order_free_vertices();
  list_corner_sources();
  list_block_sources();
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
  for_each_element(*this, [&](const int* vertices, int count, int, int) {
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

void Discretization::list_corner_sources() {
  std::vector<std::vector<int>> lists(free_vertices_.size());
  for_each_element(*this, [&](const int* vertices, int count, int corner, int) {
    for (int i = 0; i < count; ++i)
      if (const int a = slot_[static_cast<size_t>(vertices[i])]; a >= 0)
        lists[static_cast<size_t>(a)].push_back(corner + i);
  });
  corner_start_ = {0};
  for (const auto& list : lists) {
    corner_sources_.insert(corner_sources_.end(), list.begin(), list.end());
    corner_start_.push_back(static_cast<int>(corner_sources_.size()));
  }
}

void Discretization::list_block_sources() {
  struct Entry {
    int column, row;
    BlockSource source;
  };
  std::vector<Entry> entries;
  for_each_element(*this, [&](const int* vertices, int count, int, int first_block) {
    for (int i = 0; i < count; ++i)
      for (int j = 0; j <= i; ++j) {
        const int a = slot_[static_cast<size_t>(vertices[i])];
        const int b = slot_[static_cast<size_t>(vertices[j])];
        if (a < 0 || b < 0) continue;
        entries.push_back(
            {std::min(a, b), std::max(a, b), {first_block + lower_index(i, j), a < b}});
      }
  });
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& p, const Entry& q) {
    return std::pair(p.column, p.row) < std::pair(q.column, q.row);
  });

  const int n = free_vertex_count();
  block_column_start_.assign(static_cast<size_t>(n) + 1, 0);
  for (size_t k = 0; k < entries.size(); ++k) {
    const Entry& entry = entries[k];
    if (k == 0 || entry.column != entries[k - 1].column || entry.row != entries[k - 1].row) {
      block_row_.push_back(entry.row);
      source_start_.push_back(static_cast<int>(k));
      block_column_start_[static_cast<size_t>(entry.column) + 1] =
          static_cast<int>(block_row_.size());
    }
    sources_.push_back(entry.source);
  }
  source_start_.push_back(static_cast<int>(entries.size()));

  pattern_.resize(3 * n, 3 * n);
  std::vector<Eigen::Triplet<double>> triplets;
  for (int column = 0; column < n; ++column)
    for (int b = block_column_start_[static_cast<size_t>(column)];
         b < block_column_start_[static_cast<size_t>(column) + 1]; ++b)
      for (int c = 0; c < 3; ++c)
        for (int r = block_row_[static_cast<size_t>(b)] == column ? c : 0; r < 3; ++r)
          triplets.emplace_back(3 * block_row_[static_cast<size_t>(b)] + r, 3 * column + c, 0.0);
  pattern_.setFromTriplets(triplets.begin(), triplets.end());
  pattern_.makeCompressed();
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

int Discretization::element_block_count() const {
  return wing_block(static_cast<int>(mesh_.wings.size()));
}

int Discretization::element_corner_count() const {
  return 3 * static_cast<int>(active_triangles_.size()) + 4 * static_cast<int>(mesh_.wings.size());
}

int Discretization::diagonal_entry(int vertex, int r, int c) const {
  const int a = slot_[static_cast<size_t>(vertex)];
  return a < 0 ? -1 : pattern_.outerIndexPtr()[3 * a + c] + r - c;
}

void Discretization::gather_hessian(const std::vector<double>& blocks, SparseMatrix& H) const {
  double* const values = H.valuePtr();
  const int* const column_start = H.outerIndexPtr();
  const int n = free_vertex_count();
#pragma omp parallel for schedule(static)
  for (int column = 0; column < n; ++column) {
    const int first = block_column_start_[static_cast<size_t>(column)];
    const int last = block_column_start_[static_cast<size_t>(column) + 1];
    for (int b = first; b < last; ++b) {
      Mat3 sum = Mat3::Zero();
      for (int s = source_start_[static_cast<size_t>(b)];
           s < source_start_[static_cast<size_t>(b) + 1]; ++s) {
        const BlockSource source = sources_[static_cast<size_t>(s)];
        const Eigen::Map<const Mat3> block(blocks.data() + 9 * static_cast<size_t>(source.block));
        if (source.transpose)
          sum += block.transpose();
        else
          sum += block;
      }
      for (int c = 0; c < 3; ++c) {
        // a column holds the lower part of its diagonal block, then three rows a block
        double* const target = values + column_start[3 * column + c];
        if (b == first)
          for (int r = c; r < 3; ++r) target[r - c] += sum(r, c);
        else
          for (int r = 0; r < 3; ++r) target[3 - c + 3 * (b - first - 1) + r] += sum(r, c);
      }
    }
  }
}

void Discretization::gather_gradient(const std::vector<double>& corners, VecX& gradient) const {
  const int n = free_vertex_count();
#pragma omp parallel for schedule(static)
  for (int k = 0; k < n; ++k) {
    Vec3 sum = Vec3::Zero();
    for (int s = corner_start_[static_cast<size_t>(k)];
         s < corner_start_[static_cast<size_t>(k) + 1]; ++s)
      sum += Eigen::Map<const Vec3>(
          corners.data() + 3 * static_cast<size_t>(corner_sources_[static_cast<size_t>(s)]));
    gradient.segment<3>(3 * free_vertices_[static_cast<size_t>(k)]) += sum;
  }
}

}  // namespace drape
