#include "core/mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace drape {
namespace {

constexpr double kHalfPi = 1.57079632679489661923;

[[noreturn]] void fail(const std::string& what) { throw std::invalid_argument("mesh: " + what); }

std::string triangle_name(int t) { return "triangle " + std::to_string(t); }

void check_sizes(const Points2& rest_uv, const Triangles& triangles,
                 const std::vector<std::uint8_t>& fixed) {
  if (triangles.rows() == 0) fail("no triangles; at least one is needed");
  if (static_cast<Eigen::Index>(fixed.size()) != rest_uv.rows())
    fail(std::to_string(fixed.size()) + " clamp flags for " + std::to_string(rest_uv.rows()) +
         " vertices; one a vertex is needed");
  if (!rest_uv.allFinite()) fail("a rest coordinate is not finite");
  std::vector<bool> used(fixed.size(), false);
  for (int t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int v = triangles(t, k);
      if (v < 0 || v >= rest_uv.rows())
        fail(triangle_name(t) + " names vertex " + std::to_string(v) + "; there are " +
             std::to_string(rest_uv.rows()));
      used[static_cast<size_t>(v)] = true;
    }
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused != used.end())
    fail("vertex " + std::to_string(unused - used.begin()) + " belongs to no triangle");
}

RestTriangle rest_triangle(const Points2& uv, const Triangles& triangles, int t) {
  const Vec2 p = uv.row(triangles(t, 0));
  const Vec2 e1 = Vec2(uv.row(triangles(t, 1))) - p;
  const Vec2 e2 = Vec2(uv.row(triangles(t, 2))) - p;
  const double twice_area = e1.x() * e2.y() - e1.y() * e2.x();
  if (!(twice_area > 1e-12 * std::max(e1.squaredNorm(), e2.squaredNorm())))
    fail(triangle_name(t) + " is degenerate or clockwise in the (u, v) plane");
  RestTriangle rest;
  rest.area = twice_area / 2;
  rest.du = Vec3(e1.y() - e2.y(), e2.y(), -e1.y()) / twice_area;
  rest.dv = Vec3(e2.x() - e1.x(), -e2.x(), e1.x()) / twice_area;
  return rest;
}

/// The two triangles beside an edge (a < b): the apex to the left of a->b and to its right, -1 if
/// none.
struct EdgeSides {
  int left = -1, right = -1;
};
using EdgeMap = std::map<std::pair<int, int>, EdgeSides>;

EdgeMap edges_of(const Triangles& triangles) {
  EdgeMap edges;
  for (int t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(t, k), b = triangles(t, (k + 1) % 3), c = triangles(t, (k + 2) % 3);
      EdgeSides& sides = edges[{std::min(a, b), std::max(a, b)}];
      int& side = a < b ? sides.left : sides.right;
      if (side != -1)
        fail("edge " + std::to_string(a) + "-" + std::to_string(b) +
             " is shared by more than two triangles or by two of opposite orientation");
      side = c;
    }
  return edges;
}

double folded_into_first_quadrant(const Vec2& direction) {
  return std::atan2(std::abs(direction.y()), std::abs(direction.x()));
}

Wing make_wing(const Mesh& mesh, int a, int b, const EdgeSides& sides) {
  const auto point = [&](int v) -> Vec2 { return mesh.rest_uv.row(v); };
  const auto is_fixed = [&](int v) { return mesh.fixed[static_cast<size_t>(v)] != 0; };
  const Vec2 edge = point(b) - point(a);
  const double length = edge.norm();
  const auto height = [&](int apex) {
    const Vec2 r = point(apex) - point(a);
    return std::abs(edge.x() * r.y() - edge.y() * r.x()) / length;
  };
  const double height_left = height(sides.left), height_right = height(sides.right);

  Wing wing;
  wing.vertices = {a, b, sides.left, sides.right};
  wing.on_clamp_line = is_fixed(a) && is_fixed(b) && is_fixed(sides.left) != is_fixed(sides.right);
  wing.weight = (length / height_left + length / height_right) *
                (wing.on_clamp_line ? mesh.clamp_wing_factor : 1.0);
  wing.mean_height = (height_left + height_right) / 2;
  wing.phi = std::min(folded_into_first_quadrant({-edge.y(), edge.x()}), kHalfPi);
  return wing;
}

std::vector<int> longest_boundary_loop(const Points2& uv, const EdgeMap& edges) {
  std::map<int, int> next;  // boundary edges, with the triangle on their left
  for (const auto& [edge, sides] : edges) {
    if (sides.left != -1 && sides.right != -1) continue;
    const auto [from, to] = sides.right == -1 ? edge : std::pair(edge.second, edge.first);
    if (!next.emplace(from, to).second)
      fail("vertex " + std::to_string(from) + " is on the boundary twice");
  }
  std::vector<int> longest;
  double longest_length = -1;
  while (!next.empty()) {
    std::vector<int> loop;
    double length = 0;
    for (auto it = next.begin(); it != next.end(); it = next.find(loop.back())) {
      const auto [from, to] = *it;
      if (loop.empty()) loop.push_back(from);
      length += (uv.row(to) - uv.row(from)).norm();
      loop.push_back(to);
      next.erase(it);
    }
    if (loop.front() != loop.back()) fail("the boundary is not a closed loop");
    loop.pop_back();
    if (length > longest_length) {
      longest_length = length;
      longest = std::move(loop);
    }
  }
  return longest;
}

}  // namespace

Mesh make_mesh(Points2 rest_uv, Triangles triangles, std::vector<std::uint8_t> fixed,
               double clamp_wing_factor) {
  check_sizes(rest_uv, triangles, fixed);
  if (!(clamp_wing_factor > 0) || !std::isfinite(clamp_wing_factor))
    fail("clamp_wing_factor = " + std::to_string(clamp_wing_factor) + "; must be finite and > 0");

  Mesh mesh;
  mesh.rest_uv = std::move(rest_uv);
  mesh.triangles = std::move(triangles);
  mesh.fixed = std::move(fixed);
  mesh.clamp_wing_factor = clamp_wing_factor;

  mesh.nodal_area = VecX::Zero(mesh.vertex_count());
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    mesh.rest.push_back(rest_triangle(mesh.rest_uv, mesh.triangles, t));
    for (int k = 0; k < 3; ++k) mesh.nodal_area[mesh.triangles(t, k)] += mesh.rest.back().area / 3;
  }

  const EdgeMap edges = edges_of(mesh.triangles);
  for (const auto& [edge, sides] : edges) {
    if (sides.left == -1 || sides.right == -1) continue;
    const Wing wing = make_wing(mesh, edge.first, edge.second, sides);
    const auto is_free = [&](int v) { return mesh.fixed[static_cast<size_t>(v)] == 0; };
    if (std::any_of(wing.vertices.begin(), wing.vertices.end(), is_free))
      mesh.wings.push_back(wing);
  }
  mesh.boundary = longest_boundary_loop(mesh.rest_uv, edges);
  return mesh;
}

VecX flat_state(const Mesh& mesh) {
  VecX x = VecX::Zero(3 * mesh.vertex_count());
  for (int v = 0; v < mesh.vertex_count(); ++v) x.segment<2>(3 * v) = mesh.rest_uv.row(v);
  return x;
}

}  // namespace drape
