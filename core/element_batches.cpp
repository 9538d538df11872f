#include "core/element_batches.h"

#include <algorithm>

namespace drape {
namespace {

/// Calls fill(batch, lane, element, copy) for all lanes of all batches.
template <typename Batch, typename Fill>
std::vector<Batch> batches(const std::vector<int>& elements, Fill fill) {
  const size_t lanes = kLanes;
  std::vector<Batch> result((elements.size() + lanes - 1) / lanes);
  for (size_t i = 0; i < result.size() * lanes; ++i) {
    const bool copy = i >= elements.size();
    fill(result[i / lanes], i % lanes, copy ? elements.back() : elements[i], copy);
  }
  return result;
}

}  // namespace

std::vector<TriangleBatch> batches_of_triangles(const Mesh& mesh,
                                                const std::vector<int>& triangles) {
  return batches<TriangleBatch>(
      triangles, [&](TriangleBatch& batch, size_t lane, int triangle, bool copy) {
        const RestTriangle& rest = mesh.rest[static_cast<size_t>(triangle)];
        for (int k = 0; k < 3; ++k) batch.vertices[k][lane] = mesh.triangles(triangle, k);
        batch.du1[lane] = rest.du[1];
        batch.du2[lane] = rest.du[2];
        batch.dv1[lane] = rest.dv[1];
        batch.dv2[lane] = rest.dv[2];
        batch.area[lane] = copy ? 0 : rest.area;
      });
}

std::vector<WingBatch> batches_of_wings(const Mesh& mesh, const std::vector<int>& wings) {
  return batches<WingBatch>(wings, [&](WingBatch& batch, size_t lane, int wing, bool copy) {
    for (size_t k = 0; k < 4; ++k)
      batch.vertices[k][lane] = mesh.wings[static_cast<size_t>(wing)].vertices[k];
    batch.wing[lane] = copy ? -1 : wing;
  });
}

}  // namespace drape
