#include "core/self_intersection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace drape {
namespace {

using Corners = std::array<Vec3, 3>;

/// Sign of the volume of a, b, c, d (positive with d below the plane in which a, b, c turn
/// counter-clockwise); 0 where rounding could have made it.
int volume_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon() / 2;
  constexpr double kErrorBound = (7 + 56 * kEpsilon) * kEpsilon;  // of Shewchuk's stage A
  const Vec3 u = a - d, v = b - d, w = c - d;
  const double vw = v.x() * w.y(), wv = w.x() * v.y();
  const double wu = w.x() * u.y(), uw = u.x() * w.y();
  const double uv = u.x() * v.y(), vu = v.x() * u.y();
  const double volume = u.z() * (vw - wv) + v.z() * (wu - uw) + w.z() * (uv - vu);
  const double size = std::abs(u.z()) * (std::abs(vw) + std::abs(wv)) +
                      std::abs(v.z()) * (std::abs(wu) + std::abs(uw)) +
                      std::abs(w.z()) * (std::abs(uv) + std::abs(vu));
  if (std::abs(volume) <= kErrorBound * size) return 0;
  return volume > 0 ? 1 : -1;
}

/// Whether the segment p q passes through the triangle t, whose plane it is known to cross.
bool passes_through(const Vec3& p, const Vec3& q, const Corners& t) {
  const int first = volume_sign(p, q, t[0], t[1]);
  const int second = volume_sign(p, q, t[1], t[2]);
  if (first * second < 0) return false;
  const int third = volume_sign(p, q, t[2], t[0]);
  // a zero is a passage through an edge of t: the two still meet
  return first * third >= 0 && second * third >= 0 && (first || second || third);
}

/// Whether an edge of `a` passes through `b`; `skipped` is the corner of `a` on `b`, or -1.
bool edge_passes(const Corners& a, int skipped, const Corners& b) {
  std::array<int, 3> side;
  for (size_t k = 0; k < 3; ++k)
    side[k] = static_cast<int>(k) == skipped ? 0 : volume_sign(b[0], b[1], b[2], a[k]);
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    if (side[k] * side[next] < 0 && passes_through(a[k], a[next], b)) return true;
  }
  return false;
}

struct Box {
  int triangle;
  Vec3 low, high;
};

std::vector<Box> boxes_along_x(const Triangles& triangles, const VecX& x) {
  std::vector<Box> boxes(static_cast<size_t>(triangles.rows()));
  for (int t = 0; t < static_cast<int>(triangles.rows()); ++t) {
    const Vec3 a = position(x, triangles(t, 0)), b = position(x, triangles(t, 1)),
               c = position(x, triangles(t, 2));
    boxes[static_cast<size_t>(t)] = {t, a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
  }
  std::sort(boxes.begin(), boxes.end(),
            [](const Box& a, const Box& b) { return a.low.x() < b.low.x(); });
  return boxes;
}

}  // namespace

SelfIntersections self_intersections(const Triangles& triangles, const VecX& x) {
  if (!x.allFinite())
    throw std::invalid_argument("self_intersections: the state holds a value that is not finite");
  const auto corners = [&](int t) -> Corners {
    return {position(x, triangles(t, 0)), position(x, triangles(t, 1)),
            position(x, triangles(t, 2))};
  };
  SelfIntersections found;
  const auto test = [&](int t, int u) {
    int common = 0, corner_of_t = -1, corner_of_u = -1;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (triangles(t, i) == triangles(u, j)) {
          ++common;
          corner_of_t = i;
          corner_of_u = j;
        }
    if (common > 1) return;
    const Corners a = corners(t), b = corners(u);
    if (!edge_passes(a, corner_of_t, b) && !edge_passes(b, corner_of_u, a)) return;
    (common == 0 ? found.disjoint : found.adjacent).push_back({std::min(t, u), std::max(t, u)});
  };

  const std::vector<Box> boxes = boxes_along_x(triangles, x);
  for (size_t i = 0; i < boxes.size(); ++i) {
    const Box& a = boxes[i];
    for (size_t j = i + 1; j < boxes.size() && boxes[j].low.x() <= a.high.x(); ++j) {
      const Box& b = boxes[j];
      if (b.low.y() <= a.high.y() && a.low.y() <= b.high.y() && b.low.z() <= a.high.z() &&
          a.low.z() <= b.high.z())
        test(a.triangle, b.triangle);
    }
  }
  std::sort(found.disjoint.begin(), found.disjoint.end());
  std::sort(found.adjacent.begin(), found.adjacent.end());
  return found;
}

}  // namespace drape
