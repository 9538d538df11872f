#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/contour.h"
#include "core/outline.h"
#include "core/signed_distance.h"

namespace drape {
namespace {

/// A disc whose right half is cut by a slot that widens behind its mouth: not star-shaped.
Points2 hooked() {
  Points2 polygon(44, 2);
  for (int k = 0; k < 40; ++k) {
    const double alpha = 0.3 + (2 * std::numbers::pi - 0.6) * k / 39;
    polygon.row(k) << 0.1 * std::cos(alpha), 0.1 * std::sin(alpha);
  }
  polygon.bottomRows(4) << 0.03, -0.029, 0.03, -0.06, -0.02, -0.06, -0.02, 0.029;
  return polygon;
}

TEST(Contour, FollowsAnOutlineThatIsNotStarShaped) {
  const PixelGrid grid = centred_grid(256, 0.3);
  const Points2 line = contour(coverage(hooked(), grid), grid);
  EXPECT_NEAR(area(line) / area(hooked()), 1, 2e-3);
  // within a pixel even at the corners, which are cut
  const VecX there = signed_distances(hooked(), line).distance.cwiseAbs();
  const VecX back = signed_distances(line, equally_spaced(hooked(), 400)).distance.cwiseAbs();
  EXPECT_LE(std::max(there.maxCoeff(), back.maxCoeff()), grid.pixel_size);
  EXPECT_LE(back.mean(), 0.1 * grid.pixel_size);
}

TEST(Contour, LiesWithinATenthOfAPixelOfAStraightEdge) {
  Points2 square(4, 2);
  square << -0.5, -0.5, 0.63, -0.5, 0.63, 0.41, -0.5, 0.41;
  const PixelGrid grid = centred_grid(32, 2);
  const Points2 line = contour(coverage(square, grid), grid);
  EXPECT_NEAR(line.col(0).maxCoeff(), 0.63, 0.1 * grid.pixel_size);
  EXPECT_NEAR(line.col(1).maxCoeff(), 0.41, 0.1 * grid.pixel_size);
}

TEST(Contour, KeepsTheLargestPieceAndClosesAtTheBorder) {
  const PixelGrid grid{6, 8, 1, Vec2::Zero()};
  CoverageImage image = CoverageImage::Zero(6, 8);
  image.block(0, 0, 3, 3).setOnes();  // in the upper left corner of the image
  image(5, 7) = 1;
  const Points2 line = contour(image, grid);
  EXPECT_NEAR(area(line), 9 - 0.5, 1e-12);  // four corners cut by an eighth each
  EXPECT_EQ(line.col(0).minCoeff(), 0);
  EXPECT_EQ(line.col(1).maxCoeff(), 6);
}

TEST(Contour, JoinsDiagonalPixelsWhereTheirMiddleIsCovered) {
  const PixelGrid grid{4, 4, 1, Vec2::Zero()};
  CoverageImage image = CoverageImage::Zero(4, 4);
  image(1, 1) = image(2, 2) = 0.9;  // one half is crossed at 4/9 of the way to the next centre
  EXPECT_NEAR(area(contour(image, grid)), 2 * std::pow(4.0 / 9, 2), 1e-12);  // one diamond
  image(1, 1) = image(2, 2) = 1;
  EXPECT_NEAR(area(contour(image, grid)), 2 * 0.5 + 0.5, 1e-12);  // two, and what joins them
}

TEST(Contour, RefusesAnEmptyImage) {
  EXPECT_THROW(contour(CoverageImage::Zero(4, 4), PixelGrid{4, 4, 1, Vec2::Zero()}),
               std::invalid_argument);
}

}  // namespace
}  // namespace drape
