#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>

#include "core/guide.h"
#include "tests/support/derivative_check.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

Guide guide() {
  VecX radius(kProfileSize);
  for (int i = 0; i < kProfileSize; ++i) {
    const double alpha = 2 * M_PI * i / kProfileSize;
    radius[i] = 0.12 + 0.01 * std::cos(5 * alpha + 0.3) - 0.004 * std::sin(2 * alpha);
  }
  return {harmonics(radius, 10), Vec2(4e-3, -3e-3), 1};
}

TEST(Guide, MissIsTheDistanceAlongTheRay) {
  const Guide g = guide();
  for (const double alpha : {-3.0, -1.0, 0.0, 0.5, 2.0, 3.1}) {
    const double r_obs = 0.12 + 0.01 * std::cos(5 * alpha + 0.3) - 0.004 * std::sin(2 * alpha);
    const Vec2 ray(std::cos(alpha), std::sin(alpha));
    EXPECT_NEAR(guide_miss(g, g.centre + r_obs * ray).value, 0, 1e-15);
    EXPECT_NEAR(guide_miss(g, g.centre + (r_obs + 2e-3) * ray).value, 2e-3, 1e-15);
  }
}

TEST(Guide, DerivativesAgainstDifferences) {
  const Guide g = guide();
  Random random(1);
  for (int i = 0; i < 10; ++i) {
    const double alpha = random.uniform(-3.1, 3.1);
    const Vec2 p = random.uniform(0.08, 0.15) * Vec2(std::cos(alpha), std::sin(alpha));
    const GuideMiss miss = guide_miss(g, p);
    DerivativeError check = check_gradient(
        [&](const VecX& q) { return guide_miss(g, Vec2(q)).value; }, p, miss.gradient, 1e-2);
    EXPECT_LE(check.error, 1e-8) << check;
    check = check_jacobian([&](const VecX& q) -> VecX { return guide_miss(g, Vec2(q)).gradient; },
                           p, miss.hessian, 1e-2);
    EXPECT_LE(check.error, 1e-8) << check;
  }
}

TEST(Guide, SharesOfTheRimSumToOne) {
  const Mesh mesh = make_disc_mesh(kCusick, {.vertices = 300});
  const Rim rim = rim_of(mesh);
  EXPECT_EQ(rim.vertices, mesh.boundary);
  EXPECT_NEAR(std::accumulate(rim.share.begin(), rim.share.end(), 0.0), 1, 1e-14);
  for (const double share : rim.share)  // equidistant vertices on the circle
    EXPECT_NEAR(share, 1.0 / static_cast<double>(rim.vertices.size()), 1e-14);
}

TEST(Guide, OneMillimetreAllRoundPullsWithTheWeightOfTheFreeCloth) {
  const auto d = disc(300);
  Potential E(d, medium_fabric(), {}, 9.81);
  const VecX flat = flat_state(d->mesh());
  const VecX without = E.gradient(flat);
  // a circle 1 mm inside of the rim
  Guide circle{harmonics(VecX::Constant(kProfileSize, kCusick.specimen_radius - 1e-3), 3),
               Vec2::Zero(), 1};
  E.set_guide(circle);
  const auto pull = [&] {
    const VecX force = E.gradient(flat) - without;
    double sum = 0;
    for (const int v : d->mesh().boundary) sum += position(force, v).norm();
    return sum;
  };
  EXPECT_NEAR(pull(), E.free_weight(), 1e-9 * E.free_weight());
  circle.kappa = 0.25;
  E.set_guide(circle);
  EXPECT_NEAR(pull(), 0.25 * E.free_weight(), 1e-9 * E.free_weight());
  circle.kappa = 0;
  E.set_guide(circle);
  EXPECT_EQ(E.gradient(flat), without);
}

}  // namespace
}  // namespace drape::test
