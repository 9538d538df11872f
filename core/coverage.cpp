#include "core/coverage.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "core/outline.h"

namespace drape {
namespace {

/// Corners in units of pixels from the lower left corner of the image: u to the right, v upwards.
Points2 in_pixels(const Points2& polygon, const PixelGrid& grid) {
  return (polygon.rowwise() - grid.origin.transpose()) / grid.pixel_size;
}

/// A part of an edge inside one pixel, from the fraction t0 of the edge to t1. `row` counts from
/// the top as in the image; `column` is -1 for a part to the left of the image, `columns` to the
/// right.
struct Piece {
  int row, column;
  double u0, v0, t0;
  double u1, v1, t1;
};

/// Calls visit(piece) for the pieces of the edge from p to q, in order, in all rows of the image.
/// Lines of the grid and end points enter with their exact coordinates, so that the heights of the
/// pieces of a closed polygon cancel.
template <typename Visit>
void for_pieces(const Vec2& p, const Vec2& q, const PixelGrid& grid, const Visit& visit) {
  const double du = q.x() - p.x(), dv = q.y() - p.y();
  const int rows = grid.rows, columns = grid.columns;
  constexpr double kNever = std::numeric_limits<double>::infinity();

  double u = p.x(), v = p.y(), t = 0;
  if (std::max(v, q.y()) <= 0 || std::min(v, q.y()) >= rows) return;
  if (v < 0 || v > rows) {
    v = v < 0 ? 0 : rows;
    t = (v - p.y()) / dv;
    u = p.x() + t * du;
  }
  // The pixel ahead: on a grid line, the one on the side towards which the edge runs.
  const auto ahead = [](double at, double step, int size) {
    const double cell = step < 0 ? std::ceil(at) - 1 : std::floor(at);
    return static_cast<int>(std::clamp(cell, -1.0, static_cast<double>(size)));
  };
  int column = ahead(u, du, columns), level = ahead(v, dv, rows);
  while (level >= 0 && level < rows) {
    const int next_u = du > 0 ? column + 1 : column, next_v = dv > 0 ? level + 1 : level;
    const bool u_line = du > 0 ? column < columns : du < 0 && column >= 0;
    const double u_time = u_line ? (next_u - p.x()) / du : kNever;
    const double v_time = dv != 0 ? (next_v - p.y()) / dv : kNever;
    Piece piece{rows - 1 - level, column, u, v, t, q.x(), q.y(), 1};
    const bool ends = u_time >= 1 && v_time >= 1;
    if (!ends) {
      const bool across_u = u_time < v_time;
      piece.t1 = across_u ? u_time : v_time;
      piece.u1 = across_u ? next_u : p.x() + v_time * du;
      piece.v1 = across_u ? p.y() + u_time * dv : next_v;
      (across_u ? column : level) += (across_u ? du : dv) > 0 ? 1 : -1;
    }
    visit(piece);
    if (ends) return;
    u = piece.u1, v = piece.v1, t = piece.t1;
  }
}

template <typename Visit>
void for_all_pieces(const Points2& polygon, const PixelGrid& grid, const Visit& visit) {
  const Points2 corners = in_pixels(polygon, grid);
  const Eigen::Index n = corners.rows();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index next = (k + 1) % n;
    for_pieces(corners.row(k), corners.row(next), grid,
               [&](const Piece& piece) { visit(k, next, piece); });
  }
}

}  // namespace

PixelGrid centred_grid(int pixels, double width) {
  if (pixels < 1 || !std::isfinite(width) || !(width > 0)) {
    std::ostringstream message;
    message << "centred_grid: " << pixels << " pixels over " << width
            << " m: both must be greater than 0";
    throw std::invalid_argument(message.str());
  }
  return {pixels, pixels, width / pixels, Vec2::Constant(-width / 2)};
}

CoverageImage coverage(const Points2& polygon, const PixelGrid& grid) {
  if (!polygon.allFinite() || !(area(polygon) > 0))
    throw std::invalid_argument(
        "coverage: the polygon has no area, a coordinate that is not finite or clockwise corners");
  // Signed-area accumulation: an edge that rises by h in a pixel row takes h from every pixel to
  // its right, an edge that falls gives it, and in the edge's own pixel the share to the right of
  // it counts. The sums of the rows' prefixes are the areas.
  CoverageImage image = CoverageImage::Zero(grid.rows, grid.columns);
  for_all_pieces(polygon, grid, [&](Eigen::Index, Eigen::Index, const Piece& piece) {
    if (piece.column >= grid.columns) return;
    const double fall = piece.v0 - piece.v1;
    if (piece.column < 0) {
      image(piece.row, 0) += fall;
      return;
    }
    const double left_share = (piece.u0 + piece.u1) / 2 - piece.column;
    image(piece.row, piece.column) += fall * (1 - left_share);
    if (piece.column + 1 < grid.columns) image(piece.row, piece.column + 1) += fall * left_share;
  });
  for (int row = 0; row < grid.rows; ++row) {
    double sum = 0;
    for (int column = 0; column < grid.columns; ++column) {
      sum += image(row, column);
      image(row, column) = std::clamp(sum, 0.0, 1.0);  // takes away rounding only
    }
  }
  return image;
}

Points2 pull_back(const Points2& polygon, const PixelGrid& grid,
                  const CoverageImage& dL_dcoverage) {
  assert(dL_dcoverage.rows() == grid.rows && dL_dcoverage.cols() == grid.columns);
  Points2 dL_dpolygon = Points2::Zero(polygon.rows(), 2);
  // d(area in pixel) = int (velocity . outward normal) ds over the piece, the velocity linear in t.
  for_all_pieces(polygon, grid, [&](Eigen::Index k, Eigen::Index next, const Piece& piece) {
    if (piece.column < 0 || piece.column >= grid.columns) return;
    const double dt = piece.t1 - piece.t0, middle = (piece.t0 + piece.t1) / 2;
    const Vec2 edge = polygon.row(next) - polygon.row(k);
    const Vec2 gradient = dL_dcoverage(piece.row, piece.column) * dt /
                          (grid.pixel_size * grid.pixel_size) * Vec2(edge.y(), -edge.x());
    dL_dpolygon.row(k) += (1 - middle) * gradient;
    dL_dpolygon.row(next) += middle * gradient;
  });
  return dL_dpolygon;
}

CoverageImage push_forward(const Points2& polygon, const PixelGrid& grid, const Points2& dpolygon) {
  CoverageImage rate = CoverageImage::Zero(grid.rows, grid.columns);
  for_all_pieces(polygon, grid, [&](Eigen::Index k, Eigen::Index next, const Piece& piece) {
    if (piece.column < 0 || piece.column >= grid.columns) return;
    const double dt = piece.t1 - piece.t0, middle = (piece.t0 + piece.t1) / 2;
    const Vec2 edge = polygon.row(next) - polygon.row(k);
    const Vec2 velocity = (1 - middle) * dpolygon.row(k) + middle * dpolygon.row(next);
    rate(piece.row, piece.column) +=
        dt / (grid.pixel_size * grid.pixel_size) * velocity.dot(Vec2(edge.y(), -edge.x()));
  });
  return rate;
}

double intersection_over_union(const CoverageImage& a, const CoverageImage& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) {
    std::ostringstream message;
    message << "intersection_over_union: images of " << a.rows() << " x " << a.cols() << " and "
            << b.rows() << " x " << b.cols() << " pixels: must be of one size";
    throw std::invalid_argument(message.str());
  }
  const double joint = a.cwiseMax(b).sum();
  if (!(joint > 0)) throw std::invalid_argument("intersection_over_union: both images are empty");
  return a.cwiseMin(b).sum() / joint;
}

}  // namespace drape
