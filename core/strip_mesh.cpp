#include "core/strip_mesh.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/lloyd.h"
#include "core/random.h"

namespace drape {
namespace {

void check(const StripMeshOptions& o) {
  const double shorter = std::min(o.length, o.width);
  if (o.edge_length > 0 && 3 * o.edge_length <= shorter * (1 + 1e-12) &&
      std::isfinite(o.length + o.width + o.angle))
    return;
  std::ostringstream message;
  message << "strip mesh: length " << o.length << " m, width " << o.width << " m, edge length "
          << o.edge_length << " m, angle " << o.angle
          << ": must be finite, with 0 < edge length <= a third of length and width";
  throw std::invalid_argument(message.str());
}

/// Points at equal steps from a to b, without b.
void add_side(std::vector<Vec2>& points, const Vec2& a, const Vec2& b, int steps) {
  for (int i = 0; i < steps; ++i) points.emplace_back(a + (b - a) * i / steps);
}

}  // namespace

Mesh make_strip_mesh(const StripMeshOptions& options) {
  check(options);
  const double length = options.length, width = options.width, h = options.edge_length;
  const int along = static_cast<int>(std::lround(length / h));
  const int across = static_cast<int>(std::lround(width / h));
  const double low = -width / 2, high = width / 2;

  std::vector<Vec2> boundary;  // the clamp line first, then clockwise
  add_side(boundary, {0, low}, {0, high}, across);
  add_side(boundary, {0, high}, {length, high}, along);
  add_side(boundary, {length, high}, {length, low}, across);
  add_side(boundary, {length, low}, {0, low}, along);
  const int clamp_count = across + 1, first_inside = static_cast<int>(boundary.size());
  const int inside =
      static_cast<int>(std::lround(inside_count(length * width, h, first_inside) + 1));

  Points2 points(first_inside + inside, 2);
  for (int i = 0; i < first_inside; ++i) points.row(i) = boundary[static_cast<size_t>(i)];
  Random random(options.seed);
  const double row_height = std::sqrt(3.0) / 2 * h;
  const auto place = [&](const Vec2& share, double margin) -> Vec2 {
    return {margin + (length - 2 * margin) * share.x(),
            low + margin + (width - 2 * margin) * share.y()};
  };
  for (int i = 0; i < inside; ++i)
    points.row(first_inside + i) = place(uniform_point(random), 0.5 * row_height);

  const double margin = 0.6 * row_height;
  const MeshRegion region{first_inside,
                          [&](const Eigen::RowVector3i& triangle) {  // not three points of one side
                            const Vec2 a = points.row(triangle[0]);
                            const Vec2 p = Vec2(points.row(triangle[1])) - a,
                                       q = Vec2(points.row(triangle[2])) - a;
                            return p.x() * q.y() - p.y() * q.x() > 1e-6 * h * h;
                          },
                          [=](const Vec2& p) -> Vec2 {
                            return {std::clamp(p.x(), margin, length - margin),
                                    std::clamp(p.y(), low + margin, high - margin)};
                          }};
  relax(points, region);
  Triangles triangles = region_triangles(points, region);
  add_fixed_row(points, triangles, 0, clamp_count, false);

  std::vector<std::uint8_t> fixed(static_cast<size_t>(points.rows()), 0);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    fixed[static_cast<size_t>(i)] = i < clamp_count || i >= first_inside + inside;
  const Eigen::Rotation2Dd turn(options.angle);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    points.row(i) = (turn * Vec2(points.row(i))).transpose();
  return make_mesh(std::move(points), std::move(triangles), std::move(fixed),
                   options.clamp_wing_factor);
}

Vec2 place_in_strip(const StripMeshOptions& options, const Vec2& rest_uv) {
  return Eigen::Rotation2Dd(-options.angle) * rest_uv;
}

}  // namespace drape
