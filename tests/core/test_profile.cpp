#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/profile.h"
#include "core/random.h"

namespace drape {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// A ring of corners that doubles back over itself in some directions.
Points2 overhanging_polygon(std::uint64_t seed) {
  Random random(seed);
  const int corners = 211;
  const double phase = random.uniform(0, 6), amount = random.uniform(0.2, 0.3);
  Points2 polygon(corners, 2);
  for (int k = 0; k < corners; ++k) {
    const double t = 2 * std::numbers::pi * k / corners;
    const double alpha = t + amount * std::sin(7 * t + phase);  // 7 amount > 1: not monotone
    const double radius = 0.12 + 0.02 * std::cos(7 * t) + random.uniform(-2e-4, 2e-4);
    polygon.row(k) = radius * Vec2(std::cos(alpha), std::sin(alpha));
  }
  return polygon;
}

TEST(Profile, OfASquareAboutAnyCentre) {
  Points2 square(4, 2);
  square << 1, 1, -1, 1, -1, -1, 1, -1;
  // The corners lie exactly on rays for the first centre, the sides' middles for both.
  for (const Vec2& centre : {Vec2(0, 0), Vec2(0.5, -0.25)}) {
    const Profile profile = radial_profile(square, centre);
    for (int i = 0; i < kProfileSize; ++i) {
      const double c = std::cos(radians(i)), s = std::sin(radians(i));
      const double to_x = (1 - (c > 0 ? 1 : -1) * centre.x()) / std::abs(c);
      const double to_y = (1 - (s > 0 ? 1 : -1) * centre.y()) / std::abs(s);
      EXPECT_NEAR(profile.radius[i], std::min(to_x, to_y), 1e-14) << i;  // rounding
    }
  }
}

TEST(Profile, TakesTheOutermostCrossing) {
  // A hook: the ray along +x leaves at 1, enters again at 2 and leaves for good at 3.
  Points2 hook(8, 2);
  hook << -1, -1, 3, -1, 3, 1, 2, 1, 2, -0.5, 1, -0.5, 1, 1, -1, 1;
  const Profile profile = radial_profile(hook);
  EXPECT_DOUBLE_EQ(profile.radius[0], 3);
  EXPECT_EQ(profile.edge[0], 1);
  EXPECT_DOUBLE_EQ(profile.fraction[0], 0.5);
  EXPECT_DOUBLE_EQ(profile.radius[90], 1);
  // The corner (2, 1) lies at 26.6 degrees: above it the inner wall is what is met.
  EXPECT_NEAR(profile.radius[27], 1 / std::cos(radians(27)), 1e-14);
  EXPECT_NEAR(profile.radius[26], 1 / std::sin(radians(26)), 1e-14);
}

TEST(Profile, PointsLieOnTheOutlineAndOnTheRay) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Points2 polygon = overhanging_polygon(seed);
    const Vec2 centre(0.004, -0.007);
    const Profile profile = radial_profile(polygon, centre);
    const Eigen::Index n = polygon.rows();
    for (int i = 0; i < kProfileSize; ++i) {
      const size_t at = static_cast<size_t>(i);
      const Vec2 d(std::cos(radians(i)), std::sin(radians(i)));
      const Vec2 p = polygon.row(profile.edge[at]), q = polygon.row((profile.edge[at] + 1) % n);
      const Vec2 met = p + profile.fraction[at] * (q - p);
      EXPECT_LE((met - centre - profile.radius[i] * d).norm(), 1e-15);  // rounding
      // No edge crosses the ray farther out.
      for (Eigen::Index k = 0; k < n; ++k) {
        const Vec2 a = polygon.row(k).transpose() - centre;
        const Vec2 r = polygon.row((k + 1) % n) - polygon.row(k);
        const double determinant = d.x() * r.y() - d.y() * r.x();
        const double s = (a.x() * d.y() - a.y() * d.x()) / determinant;
        if (s >= 0 && s <= 1) {
          EXPECT_LE((a + s * r).dot(d), profile.radius[i] + 1e-14);
        }
      }
    }
  }
}

TEST(Profile, RefusesACentreOutside) {
  Points2 square(4, 2);
  square << 1, 1, -1, 1, -1, -1, 1, -1;
  EXPECT_NO_THROW(radial_profile(square, Vec2(0.999, 0)));
  EXPECT_THROW(radial_profile(square, Vec2(1.001, 0)), std::invalid_argument);
}

TEST(Profile, DerivativesMatchCentralDifferencesAndEachOther) {
  Random random(3);
  const Vec2 centre(0.003, 0.002);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Points2 polygon = overhanging_polygon(seed);
    const Profile profile = radial_profile(polygon, centre);
    Points2 direction(polygon.rows(), 2);
    for (double& component : direction.reshaped()) component = random.uniform(-1, 1);
    VecX weights(kProfileSize);
    for (double& weight : weights) weight = random.uniform(-1, 1);

    const VecX rate = push_forward(profile, polygon, centre, direction);
    const Points2 gradient = pull_back(profile, polygon, centre, weights);
    EXPECT_NEAR(weights.dot(rate), gradient.cwiseProduct(direction).sum(),
                1e-12 * weights.cwiseAbs().dot(rate.cwiseAbs()));  // rounding

    int compared = 0;
    const double step = 1e-8;
    const Profile ahead = radial_profile(polygon + step * direction, centre);
    const Profile behind = radial_profile(polygon - step * direction, centre);
    for (int i = 0; i < kProfileSize; ++i) {
      const size_t at = static_cast<size_t>(i);
      // Where the edge changes the radius jumps or has a kink.
      if (ahead.edge[at] != profile.edge[at] || behind.edge[at] != profile.edge[at]) continue;
      const double difference = (ahead.radius[i] - behind.radius[i]) / (2 * step);
      // Rounding 1e-17 / step; truncation step^2 / edge length^2 times the slope of the edge.
      EXPECT_NEAR(difference, rate[i], 1e-6 * (1 + rate[i] * rate[i])) << i;
      ++compared;
    }
    EXPECT_GE(compared, 350);

    // Moving the centre is moving the polygon the other way.
    const auto loss = [&](double shift) {
      return weights.dot(radial_profile(polygon, centre + Vec2(shift, 0)).radius);
    };
    const Profile right = radial_profile(polygon, centre + Vec2(step, 0));
    const Profile left = radial_profile(polygon, centre - Vec2(step, 0));
    if (right.edge == profile.edge && left.edge == profile.edge) {
      EXPECT_NEAR((loss(step) - loss(-step)) / (2 * step), -gradient.col(0).sum(),
                  1e-6 * gradient.cwiseAbs().sum());
    }
  }
}

TEST(Profile, DerivativeOnBothSidesOfACorner) {
  // The corner (1, 0) of a kite lies on the ray at 0 degrees. Moved up or down it leaves the ray to
  // the lower or the upper edge, whose slopes differ.
  const auto kite = [](double up) {
    Points2 polygon(4, 2);
    polygon << 1, up, 0, 1, -1, 0, 0, -0.5;
    return polygon;
  };
  for (double up : {-1e-3, 1e-3}) {
    Points2 velocity = Points2::Zero(4, 2);
    velocity(0, 1) = 1;
    const Profile profile = radial_profile(kite(up));
    EXPECT_EQ(profile.edge[0], up > 0 ? 3 : 0);
    const double step = 1e-6;
    const double difference =
        (radial_profile(kite(up + step)).radius[0] - radial_profile(kite(up - step)).radius[0]) /
        (2 * step);
    const double rate = push_forward(profile, kite(up), Vec2::Zero(), velocity)[0];
    EXPECT_NEAR(rate, difference, 1e-9);  // rounding 1e-16 / step
    EXPECT_EQ(rate > 0, up < 0);
  }
}

TEST(Harmonics, RecoverASeriesAndItsDerivatives) {
  Random random(1);
  const int count = 12;
  Harmonics exact{VecX::Zero(count + 1), VecX::Zero(count + 1)};
  for (int k = 0; k <= count; ++k) {
    exact.a[k] = random.uniform(-1, 1);
    exact.b[k] = k == 0 ? 0 : random.uniform(-1, 1);
  }
  VecX samples(30);
  for (int i = 0; i < 30; ++i) {
    const double alpha = 2 * std::numbers::pi * i / 30;
    samples[i] = exact.a[0];
    for (int k = 1; k <= count; ++k)
      samples[i] += exact.a[k] * std::cos(k * alpha) + exact.b[k] * std::sin(k * alpha);
    EXPECT_NEAR(exact(alpha), samples[i], 1e-13);  // rounding
  }
  const Harmonics series = harmonics(samples, count);
  EXPECT_LE((series.a - exact.a).norm() + (series.b - exact.b).norm(), 1e-13);  // rounding
  EXPECT_EQ(series.b[0], 0);
  const double alpha = 0.7, step = 1e-4;
  // Truncation (count step)^2 / 6 of the derivative.
  EXPECT_NEAR((series(alpha + step) - series(alpha - step)) / (2 * step), series.derivative(alpha),
              1e-5);
  EXPECT_NEAR((series.derivative(alpha + step) - series.derivative(alpha - step)) / (2 * step),
              series.second_derivative(alpha), 1e-4);
}

TEST(Harmonics, RefuseMoreThanTheSamplesHold) {
  EXPECT_NO_THROW(harmonics(VecX::Ones(9), 4));
  EXPECT_THROW(harmonics(VecX::Ones(8), 4), std::invalid_argument);
  EXPECT_THROW(harmonics(VecX::Ones(8), -1), std::invalid_argument);
}

VecX lobes(int count, double amplitude, double phase) {
  VecX radius(kProfileSize);
  for (int i = 0; i < kProfileSize; ++i)
    radius[i] = 0.12 + amplitude * std::cos(count * radians(i) - phase);
  return radius;
}

TEST(NodeCount, CountsLobesOfSufficientProminence) {
  for (double phase : {0.0, 1.0, 3.1}) {  // 0: a peak on the seam of the circle
    EXPECT_EQ(node_count(lobes(7, 10e-3, phase)), 7);
    // The prominence is twice the amplitude, less .4 % lost between whole degrees.
    EXPECT_EQ(node_count(lobes(7, 0.76e-3, phase)), 7);
    EXPECT_EQ(node_count(lobes(7, 0.74e-3, phase)), 0);
    EXPECT_EQ(node_count(lobes(1, 5e-3, phase)), 1);
  }
  EXPECT_EQ(node_count(VecX::Constant(kProfileSize, 0.15)), 0);
}

TEST(NodeCount, IgnoresWhatIsFinerThan30Harmonics) {
  EXPECT_EQ(node_count(lobes(30, 3e-3, 0.3)), 30);
  EXPECT_EQ(node_count(lobes(31, 3e-3, 0.3)), 0);
  EXPECT_EQ(node_count(lobes(5, 9e-3, 0.3) + lobes(45, 5e-3, 0)), 5);
}

TEST(NodeCount, ProminenceIsMeasuredFromTheHigherValley) {
  // Two peaks of 10 mm with a dent of `depth` between them: one node or two.
  const auto dented = [](double depth) {
    VecX radius(kProfileSize);
    for (int i = 0; i < kProfileSize; ++i) {
      const double alpha = radians(i);
      radius[i] = 0.1 + 5e-3 * std::cos(alpha) -
                  depth * std::exp(-std::pow(std::remainder(alpha, 2 * std::numbers::pi) / 0.2, 2));
    }
    return radius;
  };
  EXPECT_EQ(node_count(dented(1.2e-3)), 1);
  EXPECT_EQ(node_count(dented(3e-3)), 2);
}

/// Rows of a comma-separated table with # comments and a header line, by the first three columns.
std::map<std::string, std::vector<std::string>> read_table(const std::filesystem::path& file,
                                                           std::vector<std::string>& header) {
  std::ifstream stream(file);
  std::map<std::string, std::vector<std::string>> rows;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with('#')) continue;
    if (line.ends_with('\r')) line.pop_back();
    std::vector<std::string> fields;
    std::istringstream split(line);
    for (std::string field; std::getline(split, field, ',');) fields.push_back(field);
    if (header.empty())
      header = fields;
    else
      rows[fields.at(0) + '/' + fields.at(1) + '/' + fields.at(2)] = fields;
  }
  return rows;
}

TEST(NodeCount, ReproducesTheTableOfThePhotographs) {
  const char* data = std::getenv("DRAPE_DATA");
  if (data == nullptr) GTEST_SKIP() << "DRAPE_DATA, the folder of measured data, is not set";
  const std::filesystem::path features =
      std::filesystem::path(data) / "cusick_photos_silhouette_features.csv";
  const std::filesystem::path profiles =
      std::filesystem::path(data) / "cusick_photos_radial_profiles.csv";
  if (!std::filesystem::exists(features) || !std::filesystem::exists(profiles))
    GTEST_SKIP() << "no " << features << " or no " << profiles;

  std::vector<std::string> header, unused;
  const auto expected = read_table(features, header);
  const size_t column =
      static_cast<size_t>(std::find(header.begin(), header.end(), "nodes") - header.begin());
  int compared = 0, agree = 0;
  for (const auto& [key, fields] : read_table(profiles, unused)) {
    VecX radius(kProfileSize);
    for (int i = 0; i < kProfileSize; ++i)
      radius[i] = 1e-3 * std::stod(fields.at(static_cast<size_t>(i) + 3));
    ++compared;
    if (node_count(radius) == std::stoi(expected.at(key).at(column))) ++agree;
  }
  RecordProperty("agree", agree);
  EXPECT_EQ(compared, 489);
  // The radii are rounded to .01 mm, which puts one prominence, 1.503 mm, beyond the threshold.
  EXPECT_GE(agree, compared - 1) << agree << " of " << compared;
}

}  // namespace
}  // namespace drape
