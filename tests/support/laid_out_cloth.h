// An annular cloth and formulas that lay it out in the plane, from flat to overhanging folds:
// states for tests of what is seen from above. They are not equilibria and need no solver.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh.h"
#include "core/random.h"
#include "core/scene.h"

namespace drape::test {

inline const Scene kScene;  // the standard instrument: specimen 0.15 m, support 0.09 m

/// An annulus of `sectors` x `rings` squares, each cut along alternating diagonals, with one fixed
/// ring inside the clamp. Free inner vertices are shifted at random.
inline Mesh annulus(int sectors, int rings) {
  Random random(1);
  Mesh mesh;
  const int circles = rings + 2;
  mesh.rest_uv.resize(sectors * circles, 2);
  mesh.triangles.resize(2 * sectors * (circles - 1), 3);
  mesh.fixed.assign(static_cast<size_t>(sectors * circles), 0);
  const double step = (kScene.specimen_radius - kScene.support_radius) / rings;
  for (int circle = 0; circle < circles; ++circle)
    for (int k = 0; k < sectors; ++k) {
      const bool moved = circle > 1 && circle < circles - 1;
      const double shift = moved ? 0.2 : 0;
      const double alpha = 2 * std::numbers::pi / sectors * (k + random.uniform(-shift, shift));
      const double r = kScene.support_radius + step * (circle - 1 + random.uniform(-shift, shift));
      mesh.rest_uv.row(circle * sectors + k) = r * Vec2(std::cos(alpha), std::sin(alpha));
      mesh.fixed[static_cast<size_t>(circle * sectors + k)] = circle < 2;
      if (circle == circles - 1) mesh.boundary.push_back(circle * sectors + k);
    }
  int t = 0;
  for (int circle = 0; circle + 1 < circles; ++circle)
    for (int k = 0; k < sectors; ++k) {
      const int a = circle * sectors + k, b = a + sectors;
      const int c = circle * sectors + (k + 1) % sectors, d = c + sectors;
      if ((circle + k) % 2 == 0) {
        mesh.triangles.row(t++) << a, b, d;
        mesh.triangles.row(t++) << a, d, c;
      } else {
        mesh.triangles.row(t++) << a, b, c;
        mesh.triangles.row(t++) << b, d, c;
      }
    }
  std::map<std::pair<int, int>, int> apex;  // directed edge -> third vertex of its triangle
  for (Eigen::Index i = 0; i < mesh.triangles.rows(); ++i)
    for (int j = 0; j < 3; ++j)
      apex[{mesh.triangles(i, j), mesh.triangles(i, (j + 1) % 3)}] = mesh.triangles(i, (j + 2) % 3);
  for (const auto& [edge, left] : apex) {
    const auto right = apex.find({edge.second, edge.first});
    if (edge.first > edge.second || right == apex.end()) continue;
    const std::array<int, 4> vertices{edge.first, edge.second, left, right->second};
    if (std::any_of(vertices.begin(), vertices.end(),
                    [&](int i) { return !mesh.fixed[static_cast<size_t>(i)]; }))
      mesh.wings.push_back({vertices, 1, 0.01, 0, false});
  }
  return mesh;
}

/// A cloth laid out by a formula: s in [0, 1] runs from the clamp to the rim, alpha around it.
using Shape = std::function<Vec3(double s, double alpha)>;

inline VecX state(const Mesh& mesh, const Shape& shape) {
  VecX x(3 * mesh.vertex_count());
  for (int i = 0; i < mesh.vertex_count(); ++i) {
    const Vec2 uv = mesh.rest_uv.row(i);
    const double s =
        (uv.norm() - kScene.support_radius) / (kScene.specimen_radius - kScene.support_radius);
    x.segment<3>(3 * i) = mesh.fixed[static_cast<size_t>(i)] ? Vec3(uv.x(), uv.y(), 0)
                                                             : shape(s, std::atan2(uv.y(), uv.x()));
  }
  return x;
}

inline Vec3 polar(double radius, double alpha, double z) {
  return {radius * std::cos(alpha), radius * std::sin(alpha), z};
}

inline Vec3 flat(double s, double alpha) { return polar(0.09 + 0.06 * s, alpha, 0); }

/// Star-shaped lobes: every part of the rim is seen.
inline Vec3 lobes(double s, double alpha) {
  return polar(0.09 + 0.03 * s * (1 + 0.7 * std::cos(7 * alpha)), alpha, -0.04 * s);
}

/// Lobes that swing sideways until they overhang: folds hide parts of the rim.
inline Vec3 swung(double s, double alpha) {
  return polar(0.09 + 0.03 * s * (1 + 0.7 * std::cos(7 * alpha)),
               alpha + 0.35 * s * std::sin(7 * alpha + 0.4), -0.04 * s);
}

/// The cloth bulges and turns back inwards: a circle of folds is all that is seen of it.
inline Vec3 bulging(double s, double alpha) {
  return polar(0.09 + 0.08 * s * (1.1 - s) * (1 + 0.3 * std::cos(3 * alpha + 1)), alpha, -0.05 * s);
}

/// Some lobes tuck in under the support, which shows between the others.
inline Vec3 tucked(double s, double alpha) {
  return polar(0.09 + 0.035 * s * (0.2 + std::cos(6 * alpha + 0.2)),
               alpha + 0.05 * s * std::sin(2 * alpha), -0.05 * s);
}

/// All of the cloth is below the support.
inline Vec3 hidden(double s, double alpha) { return polar(0.09 - 0.03 * s, alpha, -0.05 * s); }

/// Random overhanging folds.
inline Shape rough(std::uint64_t seed) {
  Random random(seed);
  std::array<double, 12> phase, radial, angular;
  for (size_t k = 0; k < phase.size(); ++k) {
    phase[k] = random.uniform(0, 6.3);
    radial[k] = random.uniform(-1, 1);
    angular[k] = random.uniform(-1, 1);
  }
  return [=](double s, double alpha) {
    double out = 0.7, swing = 0;
    for (size_t k = 0; k < phase.size(); ++k) {
      const double angle = static_cast<double>(k + 1) * alpha + phase[k] + 3 * s * radial[k];
      out += 0.25 * radial[k] * std::cos(angle);
      swing += 0.1 * angular[k] * std::sin(angle);
    }
    return polar(0.09 + 0.05 * s * out, alpha + s * swing, -0.05 * s);
  };
}

struct NamedShape {
  std::string name;
  Shape shape;
};

inline std::vector<NamedShape> all_shapes() {
  std::vector<NamedShape> shapes{{"flat", flat},       {"lobes", lobes},   {"swung", swung},
                                 {"bulging", bulging}, {"tucked", tucked}, {"hidden", hidden}};
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    shapes.push_back({"rough " + std::to_string(seed), rough(seed)});
  return shapes;
}

}  // namespace drape::test
