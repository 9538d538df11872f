// Exact-coverage image of an outline: every pixel holds the share of its area inside the polygon.
//
// The derivative is exact as well: an edge that moves outward by d covers d times its length
// inside the pixel. No smoothing and no sampling is involved (area to rounding).
#pragma once

#include "core/types.h"

namespace drape {

/// A grid of square pixels. Row 0 is the top row (+y); `origin` is the lower left corner of the
/// image.
struct PixelGrid {
  int rows = 256;
  int columns = 256;
  double pixel_size = 1.39e-3;  ///< [m]
  Vec2 origin = Vec2::Zero();   ///< lower left corner [m]
};

/// A square grid of `pixels` x `pixels` centred on the instrument's axis that covers `width` [m].
PixelGrid centred_grid(int pixels, double width);

/// Rows x columns values in [0, 1] (row 0 at +y).
using CoverageImage = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Coverage of a simple counter-clockwise polygon [m]. Parts outside of the grid are not counted.
CoverageImage coverage(const Points2& polygon, const PixelGrid& grid);

/// dL/dpolygon (one row a corner) from dL/dcoverage (rows x columns).
Points2 pull_back(const Points2& polygon, const PixelGrid& grid, const CoverageImage& dL_dcoverage);

/// Rate of the coverage (rows x columns) when the corners move with velocity dpolygon.
CoverageImage push_forward(const Points2& polygon, const PixelGrid& grid, const Points2& dpolygon);

/// Intersection over union of two coverage images, sum(min) / sum(max).
double intersection_over_union(const CoverageImage& a, const CoverageImage& b);

}  // namespace drape
