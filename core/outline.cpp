#include "core/outline.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/outer_face.h"
#include "core/random.h"

namespace drape {
namespace {

/// Corners of the polygon that stands for the support disc; its area is 3e-6 short of the circle's.
constexpr int kSupportCorners = 1440;

/// Every projected vertex carries a constant offset of at most this many metres. It is far below
/// what a solver resolves and no derivative sees it, but it removes what would stop the trace:
/// edges and vertices that coincide exactly, as in a skirt that hangs straight down.
constexpr double kOffset = 1e-13;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Projected vertex with its offset, drawn from the vertex index.
Vec2 projected(const VecX& x, int vertex) {
  const std::uint64_t bits = seed_of_item(0, static_cast<std::uint64_t>(vertex));
  const auto signed_unit = [](std::uint64_t word) {
    return static_cast<double>(word & 0xffffffffu) * 0x1p-31 - 1;
  };
  return {x[3 * vertex] + kOffset * signed_unit(bits),
          x[3 * vertex + 1] + kOffset * signed_unit(bits >> 32)};
}

/// Edges that can be part of the cloth's outline: the rim, and inner edges over which the
/// projection folds back. (The inner rim of the clamped ring lies on the support.)
std::vector<Segment> cloth_edges(const Mesh& mesh, const std::vector<Vec2>& points) {
  // A wing folds where its two apexes project to the same side of the shared edge.
  const auto folds = [&](const Wing& wing) {
    const auto from_first = [&](size_t k) -> Vec2 {
      return points[static_cast<size_t>(wing.vertices[k])] -
             points[static_cast<size_t>(wing.vertices[0])];
    };
    const Vec2 edge = from_first(1);
    return (cross(edge, from_first(2)) > 0) == (cross(edge, from_first(3)) > 0);
  };
  std::vector<Segment> edges;
  int previous = mesh.boundary.back();
  for (int vertex : mesh.boundary) edges.push_back({std::exchange(previous, vertex), vertex});
  for (const Wing& wing : mesh.wings)
    if (folds(wing)) edges.push_back({wing.vertices[0], wing.vertices[1]});
  return edges;
}

/// Whether the segment from a to b comes closer to the axis than `radius`.
bool enters_disc(const Vec2& a, const Vec2& b, double radius) {
  const Vec2 r = b - a;
  const double length2 = r.squaredNorm();
  const double t = length2 > 0 ? std::clamp(-a.dot(r) / length2, 0.0, 1.0) : 0.0;
  return (a + t * r).squaredNorm() < radius * radius;
}

/// Adds the support's polygon. Its corners lie half a step off the axes, away from where meshes
/// like to have a clamped vertex.
void add_support(double radius, std::vector<Vec2>& points, std::vector<Segment>& edges) {
  const int first = static_cast<int>(points.size());
  for (int k = 0; k < kSupportCorners; ++k) {
    const double alpha = 2 * std::numbers::pi * (k + 0.5) / kSupportCorners;
    points.emplace_back(radius * std::cos(alpha), radius * std::sin(alpha));
    edges.push_back({first + k, first + (k + 1) % kSupportCorners});
  }
}

/// The crossing P = A + t r = C + s q of the lines A B and C D, with r = B - A and q = D - C. From
/// cross(r, dP) = cross(r, da) and cross(q, dP) = cross(q, dc), where da = (1-t) dA + t dB and
/// dc = (1-s) dC + s dD are the velocities of the two edges at P:
///   dP = (q cross(r, da) - r cross(q, dc)) / cross(r, q).
struct Crossing {
  Vec2 r, q;
  double determinant, t, s;

  Crossing(const std::array<Vec2, 2>& first, const std::array<Vec2, 2>& second)
      : r(first[1] - first[0]),
        q(second[1] - second[0]),
        determinant(cross(r, q)),
        t(cross(second[0] - first[0], q) / determinant),
        s(cross(second[0] - first[0], r) / determinant) {}

  Crossing(const OutlineCorner& corner, const VecX& x)
      : Crossing(ends(corner, 0, x), ends(corner, 2, x)) {}

 private:
  static std::array<Vec2, 2> ends(const OutlineCorner& corner, size_t slot, const VecX& x) {
    if (corner.vertices[slot] < 0) return corner.support_edge;
    return {projected(x, corner.vertices[slot]), projected(x, corner.vertices[slot + 1])};
  }
};

}  // namespace

Outline trace_outline(const Mesh& mesh, const Scene& scene, const VecX& x) {
  const int n = mesh.vertex_count();
  if (x.size() != 3 * n) {
    std::ostringstream message;
    message << "trace_outline: a state of " << x.size() << " values for a mesh of " << n
            << " vertices: must be " << 3 * n;
    throw std::invalid_argument(message.str());
  }
  if (mesh.boundary.size() < 3)
    throw std::invalid_argument("trace_outline: the mesh has a rim of fewer than 3 vertices");
  if (!x.allFinite()) throw std::runtime_error("trace_outline: a coordinate is not finite");

  std::vector<Vec2> points;
  points.reserve(static_cast<size_t>(n + kSupportCorners));
  for (int i = 0; i < n; ++i) points.push_back(projected(x, i));
  std::vector<Segment> edges = cloth_edges(mesh, points);
  const auto at = [&](int i) -> const Vec2& { return points[static_cast<size_t>(i)]; };
  // A cloth none of whose candidate edges enters the disc hides it.
  if (std::any_of(edges.begin(), edges.end(), [&](const Segment& e) {
        return enters_disc(at(e.a), at(e.b), scene.support_radius);
      }))
    add_support(scene.support_radius, points, edges);

  Outline outline;
  const std::vector<FaceCorner> face = outer_face(points, edges);
  outline.points.resize(static_cast<Eigen::Index>(face.size()), 2);
  outline.corners.reserve(face.size());
  for (const FaceCorner& from : face) {
    OutlineCorner corner{.kind = OutlineCorner::Kind::crossing};
    Vec2 point;
    if (from.point >= 0) {
      const bool on_cloth = from.point < n;
      corner.kind = on_cloth ? OutlineCorner::Kind::vertex : OutlineCorner::Kind::support;
      if (on_cloth) corner.vertices[0] = from.point;
      point = at(from.point);
    } else {
      size_t slot = 0;
      for (int segment : {from.segment, from.crossing_segment}) {
        const auto [a, b] = edges[static_cast<size_t>(segment)];
        if (a < n) {
          corner.vertices[slot] = a;
          corner.vertices[slot + 1] = b;
        } else {
          corner.support_edge = {at(a), at(b)};
        }
        slot += 2;
      }
      const Crossing crossing(corner, x);
      const int a = edges[static_cast<size_t>(from.segment)].a;
      point = at(a) + crossing.t * crossing.r;
    }
    outline.points.row(static_cast<Eigen::Index>(outline.corners.size())) = point;
    outline.corners.push_back(corner);
  }
  return outline;
}

VecX pull_back(const Outline& outline, const VecX& x, const Points2& dL_dpoints) {
  assert(dL_dpoints.rows() == outline.points.rows());
  VecX dL_dx = VecX::Zero(x.size());
  const auto add = [&](int vertex, const Vec2& gradient) {
    if (vertex >= 0) dL_dx.segment<2>(3 * vertex) += gradient;
  };
  for (int k = 0; k < outline.size(); ++k) {
    const OutlineCorner& corner = outline.corners[static_cast<size_t>(k)];
    const Vec2 dL_dP = dL_dpoints.row(k);
    if (corner.kind == OutlineCorner::Kind::vertex) add(corner.vertices[0], dL_dP);
    if (corner.kind != OutlineCorner::Kind::crossing) continue;
    const Crossing at(corner, x);
    const Vec2 dL_da = at.q.dot(dL_dP) / at.determinant * Vec2(-at.r.y(), at.r.x());
    const Vec2 dL_dc = -at.r.dot(dL_dP) / at.determinant * Vec2(-at.q.y(), at.q.x());
    add(corner.vertices[0], (1 - at.t) * dL_da);
    add(corner.vertices[1], at.t * dL_da);
    add(corner.vertices[2], (1 - at.s) * dL_dc);
    add(corner.vertices[3], at.s * dL_dc);
  }
  return dL_dx;
}

Points2 push_forward(const Outline& outline, const VecX& x, const VecX& dx) {
  assert(dx.size() == x.size());
  Points2 dpoints = Points2::Zero(outline.size(), 2);
  const auto velocity = [&](int vertex) -> Vec2 {
    return vertex >= 0 ? Vec2(dx.segment<2>(3 * vertex)) : Vec2::Zero();
  };
  for (int k = 0; k < outline.size(); ++k) {
    const OutlineCorner& corner = outline.corners[static_cast<size_t>(k)];
    const auto& v = corner.vertices;
    if (corner.kind == OutlineCorner::Kind::vertex) dpoints.row(k) = velocity(v[0]);
    if (corner.kind != OutlineCorner::Kind::crossing) continue;
    const Crossing at(corner, x);
    const Vec2 da = (1 - at.t) * velocity(v[0]) + at.t * velocity(v[1]);
    const Vec2 dc = (1 - at.s) * velocity(v[2]) + at.s * velocity(v[3]);
    dpoints.row(k) = (at.q * cross(at.r, da) - at.r * cross(at.q, dc)) / at.determinant;
  }
  return dpoints;
}

double area(const Points2& polygon) {
  // Relative to a corner, so that a polygon far from the origin loses no digits.
  double twice = 0;
  for (Eigen::Index k = 1; k + 1 < polygon.rows(); ++k)
    twice += cross(polygon.row(k) - polygon.row(0), polygon.row(k + 1) - polygon.row(0));
  return twice / 2;
}

Points2 area_gradient(const Points2& polygon) {
  const Eigen::Index n = polygon.rows();
  Points2 gradient(n, 2);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Vec2 chord = polygon.row((k + 1) % n) - polygon.row((k + n - 1) % n);
    gradient.row(k) = Vec2(chord.y(), -chord.x()) / 2;
  }
  return gradient;
}

Vec2 centroid(const Points2& polygon) {
  Vec2 moment = Vec2::Zero();
  double twice_area = 0;
  for (Eigen::Index k = 1; k + 1 < polygon.rows(); ++k) {
    const Vec2 u = polygon.row(k) - polygon.row(0), w = polygon.row(k + 1) - polygon.row(0);
    const double twice = cross(u, w);
    twice_area += twice;
    moment += twice * (u + w) / 3;
  }
  return polygon.row(0).transpose() + moment / twice_area;
}

double drape_coefficient(const Scene& scene, double shadow_area) {
  const double support = std::numbers::pi * scene.support_radius * scene.support_radius;
  const double specimen = std::numbers::pi * scene.specimen_radius * scene.specimen_radius;
  return (shadow_area - support) / (specimen - support);
}

}  // namespace drape
