#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "estimation/picture.h"
#include "tests/support/derivative_check.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

OutlineObservation observation() {
  OutlineObservation seen;
  seen.profile = VecX::LinSpaced(kProfileSize, 0.10, 0.12);
  seen.centre_known = false;
  seen.weft_angle = 0.4;
  seen.weft_angle_sd = 0.3;
  seen.scale_log_sd = 0.01;
  return seen;
}

const VecX kNuisances = (VecX(4) << 2, -3, 0.1, -0.02).finished();

Points2 corners() {
  Points2 points(3, 2);
  points << 0.1, 0.02, -0.03, 0.12, -0.05, -0.09;
  return points;
}

TEST(Picture, NuisancesAreWhatIsNotKnown) {
  OutlineObservation seen = observation();
  EXPECT_EQ(seen.nuisances(), 4);
  EXPECT_EQ(nuisance_sd(seen), (VecX(4) << 5, 5, 0.3, 0.01).finished());
  EXPECT_EQ(nuisance_bounds(seen), (VecX(4) << 10, 10, 0.785, 0.04).finished());
  seen.centre_known = true;
  EXPECT_EQ(seen.nuisances(), 2);
  EXPECT_EQ(placement(seen, kNuisances.tail(2)).weft_angle, 0.5);
  seen.weft_angle_sd = 0;
  EXPECT_EQ(placement(seen, kNuisances.tail(1)).weft_angle, 0.4);
  EXPECT_EQ(placement(seen, kNuisances.tail(1)).log_scale, -0.02);
  seen.scale_log_sd = 0;
  EXPECT_EQ(seen.nuisances(), 0);
  EXPECT_EQ(OutlineObservation{}.independent_values(), 61);
}

TEST(Picture, ATurnedShiftedMagnifiedOutline) {
  Points2 drape(1, 2), seen(1, 2);
  drape << 0.102, 0.003;  // 10 cm along the weft from the origin at (2, 3) mm
  seen << 0, 0.05;        // the weft points upwards and every length appears halved
  EXPECT_LE((Placement{{0.002, 0.003}, M_PI / 2, std::log(2)}.seen(drape) - seen).norm(), 1e-16);
  EXPECT_EQ(Placement{}.seen(drape), drape);
  const Placement turned{{0.002, -0.003}, 0.7, 0.02};
  EXPECT_LE((turned.unseen(turned.seen(drape)) - drape).norm(), 1e-16);  // rounding
}

TEST(Picture, DerivativesOfThePlacement) {
  const OutlineObservation seen = observation();
  const Placement place = placement(seen, kNuisances);
  const Points2 points = place.seen(corners());
  MatX J(points.size(), 4);
  for (int k = 0; k < 4; ++k)
    J.col(k) = nuisance_velocity(seen, place, points, k).reshaped<Eigen::RowMajor>();
  const auto f = [&](const VecX& v) -> VecX {
    return placement(seen, v).seen(corners()).reshaped<Eigen::RowMajor>();
  };
  const DerivativeError error = check_jacobian(f, kNuisances, J, 1);
  EXPECT_LE(error.error, 1e-8) << error;  // rounding over the best step

  // the placement is affine in the corners: its rate is exact, and the transpose of pull_back
  Points2 velocity(3, 2), slope(3, 2);
  velocity << 0.3, -1, 2, 0.4, -0.7, 0.9;
  slope << 1, 2, -0.5, 0.1, 0.8, -1.1;
  EXPECT_LE((place.seen(corners() + velocity) - points - place.push_forward(velocity)).norm(),
            1e-15);
  EXPECT_NEAR(place.push_forward(velocity).cwiseProduct(slope).sum(),
              velocity.cwiseProduct(place.pull_back(slope)).sum(), 1e-15);
}

TEST(Picture, TheGuideLiesOnTheOutline) {
  // an outline of four harmonics at the most, as a picture shows it
  const Harmonics shape{(VecX(5) << 0.12, 0.001, 0.004, 0, 0.006).finished(),
                        (VecX(5) << 0, 0.002, -0.003, 0.001, 0.002).finished()};
  OutlineObservation seen = observation();
  for (int i = 0; i < kProfileSize; ++i) seen.profile[i] = shape(2 * M_PI * i / kProfileSize);
  const Placement place = placement(seen, kNuisances);
  const Guide guide = guide_towards(seen, kCusick, place, 6, 0.1);
  EXPECT_EQ(guide.kappa, 0.1);
  for (const double alpha : {0.0, 1.0, 2.5, 4.0}) {
    const Vec2 on_drape =
        guide.centre + guide.radius(alpha) * Vec2(std::cos(alpha), std::sin(alpha));
    const Vec2 in_picture = place.seen(Points2(on_drape.transpose())).row(0);
    const double direction = std::atan2(in_picture.y(), in_picture.x());
    EXPECT_NEAR(in_picture.norm(), shape(direction), 1e-15);
  }
}

TEST(Picture, BadObservationsAreRefused) {
  const auto refused = [](auto change) {
    OutlineObservation seen = observation();
    change(seen);
    EXPECT_THROW(validate(seen), std::invalid_argument);
  };
  EXPECT_NO_THROW(validate(observation()));
  refused([](auto& s) { s.profile.conservativeResize(kProfileSize - 1); });
  refused([](auto& s) { s.profile[7] = std::numeric_limits<double>::quiet_NaN(); });
  refused([](auto& s) { s.noise = 0; });
  refused([](auto& s) { s.noise_harmonics = 180; });
  refused([](auto& s) { s.noise_harmonics = -1; });
  refused([](auto& s) { s.weft_angle_sd = -0.1; });
  refused([](auto& s) { s.scale_log_sd = std::numeric_limits<double>::quiet_NaN(); });
}

}  // namespace
}  // namespace drape::test
