#include "core/signed_distance.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace drape {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

Eigen::Index next_of(const Points2& polygon, Eigen::Index k) {
  return k + 1 < polygon.rows() ? k + 1 : 0;
}

/// The unit vector to the right of an edge of a counter-clockwise polygon.
Vec2 right_of(const Vec2& edge) { return Vec2(edge.y(), -edge.x()).normalized(); }

}  // namespace

SignedDistances signed_distances(const Points2& polygon, const Points2& at) {
  const Eigen::Index n = polygon.rows(), m = at.rows();
  if (n < 3) throw std::invalid_argument("signed distances: the outline has fewer than 3 corners");
  SignedDistances result{VecX(m), std::vector<int>(static_cast<size_t>(m)),
                         std::vector<double>(static_cast<size_t>(m)), Points2(m, 2)};
  for (Eigen::Index i = 0; i < m; ++i) {
    const Vec2 q = at.row(i);
    double least = std::numeric_limits<double>::infinity(), fraction = 0;
    Eigen::Index nearest = 0;
    for (Eigen::Index k = 0; k < n; ++k) {
      const Vec2 a = polygon.row(k), edge = Vec2(polygon.row(next_of(polygon, k))) - a;
      const double length2 = edge.squaredNorm();
      const double t = length2 > 0 ? std::clamp(edge.dot(q - a) / length2, 0.0, 1.0) : 0;
      const double squared = (q - a - t * edge).squaredNorm();
      if (squared >= least) continue;
      least = squared;
      nearest = k;
      fraction = t;
    }
    if (fraction == 1) {  // a corner belongs to the edge that starts there
      nearest = next_of(polygon, nearest);
      fraction = 0;
    }
    const Vec2 a = polygon.row(nearest), edge = Vec2(polygon.row(next_of(polygon, nearest))) - a;
    Vec2 outward = right_of(edge);
    const Vec2 away = q - a - fraction * edge;
    if (fraction == 0 && least > 0) {  // outside of a corner that sticks out, else inside
      const Vec2 before = a - Vec2(polygon.row(nearest > 0 ? nearest - 1 : n - 1));
      outward = (cross(before, edge) >= 0 ? 1 : -1) * away.normalized();
    }
    result.distance[i] = outward.dot(away);
    result.edge[static_cast<size_t>(i)] = static_cast<int>(nearest);
    result.fraction[static_cast<size_t>(i)] = fraction;
    result.outward.row(i) = outward;
  }
  return result;
}

Points2 pull_back(const SignedDistances& distances, const Points2& polygon,
                  const VecX& dL_ddistance) {
  Points2 dL_dpolygon = Points2::Zero(polygon.rows(), 2);
  for (Eigen::Index i = 0; i < dL_ddistance.size(); ++i) {
    const Eigen::Index k = distances.edge[static_cast<size_t>(i)];
    const double t = distances.fraction[static_cast<size_t>(i)];
    const Eigen::RowVector2d dL_dP = -dL_ddistance[i] * distances.outward.row(i);
    dL_dpolygon.row(k) += (1 - t) * dL_dP;
    dL_dpolygon.row(next_of(polygon, k)) += t * dL_dP;
  }
  return dL_dpolygon;
}

VecX push_forward(const SignedDistances& distances, const Points2& dpolygon) {
  VecX rate(distances.distance.size());
  for (Eigen::Index i = 0; i < rate.size(); ++i) {
    const Eigen::Index k = distances.edge[static_cast<size_t>(i)];
    const double t = distances.fraction[static_cast<size_t>(i)];
    rate[i] = -distances.outward.row(i).dot((1 - t) * dpolygon.row(k) +
                                            t * dpolygon.row(next_of(dpolygon, k)));
  }
  return rate;
}

Points2 equally_spaced(const Points2& polygon, int count) {
  const Eigen::Index n = polygon.rows();
  VecX reached = VecX::Zero(n + 1);  // length up to each corner
  for (Eigen::Index k = 0; k < n; ++k)
    reached[k + 1] = reached[k] + (polygon.row(next_of(polygon, k)) - polygon.row(k)).norm();
  Points2 points(count, 2);
  Eigen::Index k = 0;
  for (int i = 0; i < count; ++i) {
    const double length = reached[n] * i / count;
    while (reached[k + 1] <= length && k + 1 < n) ++k;
    const double step = reached[k + 1] - reached[k];
    const double t = step > 0 ? (length - reached[k]) / step : 0;
    points.row(i) = (1 - t) * polygon.row(k) + t * polygon.row(next_of(polygon, k));
  }
  return points;
}

}  // namespace drape
