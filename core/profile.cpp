#include "core/profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace drape {
namespace {

/// Harmonics kept for the node count, and the least prominence of a node [m]: the definition of the
/// photographs' table.
constexpr int kNodeHarmonics = 30;
constexpr double kNodeProminence = 1.5e-3;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

Vec2 direction(int degree) {
  const double alpha = 2 * std::numbers::pi * degree / kProfileSize;
  return {std::cos(alpha), std::sin(alpha)};
}

/// On the ray along d: rho = cross(P, r) / cross(d, r) with r = Q - P, so that
/// drho = cross((1-s) dP + s dQ, r) / cross(d, r): the gradient by the velocity of the edge where
/// the ray meets it. The centre does not enter.
Vec2 radius_gradient(int i, const Vec2& P, const Vec2& Q) {
  const Vec2 r = Q - P;
  return Vec2(r.y(), -r.x()) / cross(direction(i), r);
}

/// Prominence of the peak at i of a circular sequence: its height over the higher of the two
/// valleys that separate it from higher ground (from itself, once around, for the highest peak).
double prominence(const VecX& values, Eigen::Index i) {
  const Eigen::Index n = values.size();
  double higher_valley = -std::numeric_limits<double>::infinity();
  for (Eigen::Index step : {Eigen::Index{1}, n - 1}) {
    double valley = values[i];
    for (Eigen::Index k = (i + step) % n; k != i && values[k] <= values[i]; k = (k + step) % n)
      valley = std::min(valley, values[k]);
    higher_valley = std::max(higher_valley, valley);
  }
  return values[i] - higher_valley;
}

/// Sum of term(k, cos(k alpha), sin(k alpha)) over 1 <= k < end, by turning on through alpha.
template <typename Term>
double sum_of_orders(double alpha, Eigen::Index end, const Term& term) {
  const double cosine1 = std::cos(alpha), sine1 = std::sin(alpha);
  double cosine = 1, sine = 0, sum = 0;
  for (Eigen::Index k = 1; k < end; ++k) {
    const double turned = cosine * cosine1 - sine * sine1;
    sine = sine * cosine1 + cosine * sine1;
    cosine = turned;
    sum += term(k, cosine, sine);
  }
  return sum;
}

/// Whether a circular sequence rises to i and falls after it, possibly after a plateau.
bool is_peak(const VecX& values, Eigen::Index i) {
  const Eigen::Index n = values.size();
  if (!(values[(i + n - 1) % n] < values[i])) return false;
  Eigen::Index k = (i + 1) % n;
  while (values[k] == values[i]) k = (k + 1) % n;
  return values[k] < values[i];
}

}  // namespace

Profile radial_profile(const Points2& polygon, const Vec2& centre) {
  const int n = static_cast<int>(polygon.rows());
  Profile profile{VecX::Zero(kProfileSize), std::vector<int>(kProfileSize, -1),
                  std::vector<double>(kProfileSize, 0)};
  std::vector<double> degrees(static_cast<size_t>(n));
  for (int k = 0; k < n; ++k) {
    const Vec2 P = polygon.row(k).transpose() - centre;
    degrees[static_cast<size_t>(k)] =
        std::atan2(P.y(), P.x()) * (kProfileSize / (2 * std::numbers::pi));
  }
  std::vector<Vec2> directions;
  for (int i = 0; i < kProfileSize; ++i) directions.push_back(direction(i));

  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    const Vec2 P = polygon.row(k).transpose() - centre, Q = polygon.row(next).transpose() - centre;
    const double start = degrees[static_cast<size_t>(k)];
    const double turn =
        std::remainder(degrees[static_cast<size_t>(next)] - start, double{kProfileSize});
    // The margin lets no ray through an end point slip away by rounding; the signs below decide.
    constexpr double kMargin = 1e-9;
    const int first = static_cast<int>(std::ceil(start + std::min(turn, 0.0) - kMargin));
    const int last = static_cast<int>(std::floor(start + std::max(turn, 0.0) + kMargin));
    for (int ray = first; ray <= last; ++ray) {
      const int i = (ray + 2 * kProfileSize) % kProfileSize;
      const Vec2& d = directions[static_cast<size_t>(i)];
      const double P_side = cross(d, P), Q_side = cross(d, Q);
      if ((P_side >= 0) == (Q_side >= 0)) continue;
      const double s = P_side / (P_side - Q_side);
      const double rho = d.dot(P + s * (Q - P));
      if (rho <= profile.radius[i]) continue;
      profile.radius[i] = rho;
      profile.edge[static_cast<size_t>(i)] = k;
      profile.fraction[static_cast<size_t>(i)] = s;
    }
  }
  const auto missed = std::find(profile.edge.begin(), profile.edge.end(), -1);
  if (missed != profile.edge.end()) {
    std::ostringstream message;
    message << "radial_profile: the ray at " << missed - profile.edge.begin() << " degrees from ("
            << centre.x() << ", " << centre.y()
            << ") m does not meet the polygon: the centre must lie inside of it";
    throw std::invalid_argument(message.str());
  }
  return profile;
}

Points2 pull_back(const Profile& profile, const Points2& polygon, const Vec2& /*centre*/,
                  const VecX& dL_dradius) {
  assert(dL_dradius.size() == profile.radius.size());
  Points2 dL_dpolygon = Points2::Zero(polygon.rows(), 2);
  for (int i = 0; i < kProfileSize; ++i) {
    const int k = profile.edge[static_cast<size_t>(i)];
    const int next = (k + 1) % static_cast<int>(polygon.rows());
    const double s = profile.fraction[static_cast<size_t>(i)];
    const Vec2 gradient = dL_dradius[i] * radius_gradient(i, polygon.row(k), polygon.row(next));
    dL_dpolygon.row(k) += (1 - s) * gradient;
    dL_dpolygon.row(next) += s * gradient;
  }
  return dL_dpolygon;
}

VecX push_forward(const Profile& profile, const Points2& polygon, const Vec2& /*centre*/,
                  const Points2& dpolygon) {
  assert(dpolygon.rows() == polygon.rows());
  VecX dradius(kProfileSize);
  for (int i = 0; i < kProfileSize; ++i) {
    const int k = profile.edge[static_cast<size_t>(i)];
    const int next = (k + 1) % static_cast<int>(polygon.rows());
    const double s = profile.fraction[static_cast<size_t>(i)];
    const Vec2 velocity = (1 - s) * dpolygon.row(k) + s * dpolygon.row(next);
    dradius[i] = radius_gradient(i, polygon.row(k), polygon.row(next)).dot(velocity);
  }
  return dradius;
}

double Harmonics::operator()(double alpha) const {
  return a[0] + sum_of_orders(alpha, a.size(), [this](Eigen::Index k, double cosine, double sine) {
           return a[k] * cosine + b[k] * sine;
         });
}

double Harmonics::derivative(double alpha) const {
  return sum_of_orders(alpha, a.size(), [this](Eigen::Index k, double cosine, double sine) {
    return static_cast<double>(k) * (b[k] * cosine - a[k] * sine);
  });
}

double Harmonics::second_derivative(double alpha) const {
  return sum_of_orders(alpha, a.size(), [this](Eigen::Index k, double cosine, double sine) {
    return -static_cast<double>(k * k) * (a[k] * cosine + b[k] * sine);
  });
}

Harmonics harmonics(const VecX& samples, int count) {
  const Eigen::Index n = samples.size();
  if (count < 0 || 2 * count >= n) {
    std::ostringstream message;
    message << "harmonics: " << count << " harmonics of " << n
            << " samples: must be at least 0 and less than half the number of samples";
    throw std::invalid_argument(message.str());
  }
  VecX cosine(n), sine(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double alpha = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    cosine[i] = std::cos(alpha);
    sine[i] = std::sin(alpha);
  }
  Harmonics series{VecX::Zero(count + 1), VecX::Zero(count + 1)};
  series.a[0] = samples.mean();
  for (Eigen::Index k = 1; k <= count; ++k)
    for (Eigen::Index i = 0; i < n; ++i) {
      series.a[k] += samples[i] * cosine[i * k % n] * 2 / static_cast<double>(n);
      series.b[k] += samples[i] * sine[i * k % n] * 2 / static_cast<double>(n);
    }
  return series;
}

int node_count(const VecX& radius) {
  const Harmonics series = harmonics(radius, kNodeHarmonics);
  const Eigen::Index n = radius.size();
  VecX smooth(n);
  for (Eigen::Index i = 0; i < n; ++i)
    smooth[i] = series(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
  int nodes = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    if (is_peak(smooth, i) && prominence(smooth, i) >= kNodeProminence) ++nodes;
  return nodes;
}

}  // namespace drape
