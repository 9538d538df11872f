// Triangles and wings in batches of kLanes (see lanes.h), and the place of every element block in
// the values of a Hessian. The last batch is filled up with copies of a valid element that carry no
// stiffness: they add exact zeros.
#pragma once

#include <vector>

#include "core/lanes.h"
#include "core/mesh.h"

namespace drape {

/// kLanes triangles: the edges x1 - x0 and x2 - x0 times (du1, du2) give w_u, times (dv1, dv2) w_v.
struct TriangleBatch {
  int vertices[3][kLanes];
  Lanes du1, du2, dv1, dv2;  ///< [1/m]
  Lanes area;                ///< [m^2]; 0 in the lanes that fill up
};

/// kLanes wings.
struct WingBatch {
  int vertices[4][kLanes];
  int wing[kLanes];  ///< index into Mesh::wings; -1 in the lanes that fill up
};

/// Place of a 3x3 block in the values of a column-major lower triangle: entry (r, c) is at
/// first + column_step(c) + r. `first` is -1 for a block that has no place (a fixed vertex).
struct BlockPlace {
  int first = -1;
  int stride = 0;  ///< from a column of the block to the next; negative: store the transpose

  bool transposed() const { return stride < 0; }
};

/// Lower blocks (i >= j) of an element of three or four corners.
constexpr int lower_index(int i, int j) { return i * (i + 1) / 2 + j; }
inline constexpr int kTriangleBlocks = 6, kWingBlocks = 10;

struct TrianglePlaces {
  BlockPlace block[kTriangleBlocks][kLanes];
};
struct WingPlaces {
  BlockPlace block[kWingBlocks][kLanes];
};

/// Batches of the triangles and wings listed, in that order.
std::vector<TriangleBatch> batches_of_triangles(const Mesh& mesh,
                                                const std::vector<int>& triangles);
std::vector<WingBatch> batches_of_wings(const Mesh& mesh, const std::vector<int>& wings);

/// A 3x3 matrix a lane.
using BlockLanes = Lanes[3][3];  // [column][row]

/// Adds a block a lane to the values of a Hessian; a diagonal block adds its lower triangle.
inline void add_block(double* values, const BlockPlace* places, const BlockLanes& block,
                      bool diagonal) {
  alignas(Lanes) double entries[9 * kLanes];
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r)
      block[c][r].copy_to(entries + (3 * c + r) * kLanes, std::experimental::vector_aligned);
  for (int i = 0; i < kLanes; ++i) {
    const BlockPlace place = places[i];
    if (place.first < 0) continue;
    const int row_step = place.transposed() ? 3 * kLanes : kLanes;
    const int column_step = 4 * kLanes - row_step;
    const int stride = place.transposed() ? -place.stride : place.stride;
    for (int c = 0; c < 3; ++c) {
      // in a lower triangle the third column of a block column begins one entry earlier
      double* const column = values + place.first + c * stride - (c == 2);
      for (int r = diagonal ? c : 0; r < 3; ++r)
        column[r] += entries[c * column_step + r * row_step + i];
    }
  }
}

}  // namespace drape
