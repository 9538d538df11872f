// Two pictures of one fabric, of specimens of different size, with all kinds of nuisances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/disc_mesh.h"
#include "core/drape_protocol.h"
#include "estimation/drape_objective.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

const ContinuationOptions kTight{.equilibrium = {.tolerance = 1e-12, .max_iterations = 80}};
const Scene kSmall{.specimen_radius = 0.12};

/// What would be seen of a disc with shallow folds.
OutlineObservation folded(int folds, double radius, double depth) {
  OutlineObservation seen;
  Points2 polygon(kProfileSize, 2);
  seen.profile.resize(kProfileSize);
  for (int i = 0; i < kProfileSize; ++i) {
    const double alpha = 2 * M_PI * i / kProfileSize;
    seen.profile[i] = radius + depth * std::cos(folds * alpha + 0.4);
    polygon.row(i) = seen.profile[i] * Vec2(std::cos(alpha), std::sin(alpha));
  }
  seen.grid = centred_grid(128, 0.32);
  seen.coverage = coverage(polygon, seen.grid);
  seen.outline = polygon;
  return seen;
}

/// Drapes of a stiff fabric and other outlines than theirs.
struct Case {
  Case()
      : space{{Parameter::k_h, Parameter::k_bu, Parameter::k_bh}, stiff_fabric()},
        z(space.encode(stiff_fabric())) {
    const auto small = std::make_shared<const Discretization>(
        make_disc_mesh(kSmall, {.vertices = 250, .seed = 2, .clamp_refinement = 1}),
        default_factor_backend());
    add({{disc(300), stiff_fabric(), {}, kCusick.gravity}, kCusick, folded(4, 0.12, 0.008)}, 4);
    add({{small, stiff_fabric(), {}, kSmall.gravity}, kSmall, folded(3, 0.112, 0.003)}, 3);
    pictures[0].seen.centre_known = false;
    pictures[0].seen.weft_angle = -0.3;
    pictures[0].seen.weft_angle_sd = 0.2;
    pictures[0].seen.scale_log_sd = 0.005;
    pictures[1].seen.noise = 1e-3;
    pictures[1].seen.noise_harmonics = 15;
    pictures[1].seen.camera.height = 0.7;
    pictures[1].seen.weft_angle = 0.5;
    pictures[1].seen.scale_log_sd = 0.01;
  }

  void add(const Picture& picture, int lobes) {
    pictures.push_back(picture);
    drapes.push_back(drape_by_lobes(picture.model, picture.scene, lobes, 0.1,
                                    {.tolerance = kTight.equilibrium.tolerance}));
  }

  DrapeObjective objective(const std::vector<Picture>& of, const std::optional<Prior>& prior,
                           const MisfitOptions& options = {}, int max_solves = 100000) const {
    DrapeObjective made(of, space, prior, options, max_solves);
    for (size_t i = 0; i < of.size(); ++i)
      made.start_from(i, of[i].model, make_branch_point(of[i].model, space, z, drapes[i]), kTight);
    return made;
  }

  /// Without nuisances.
  Picture plain() const {
    Picture picture = pictures[0];
    picture.seen = folded(4, 0.12, 0.008);
    return picture;
  }

  VecX own_profile() const {
    return radial_profile(trace_outline(disc(300)->mesh(), kCusick, drapes[0].x).points).radius;
  }

  /// A prior with correlations.
  Prior prior() const {
    Prior made = prior_about(space, stiff_fabric(), 0.5);
    made.covariance(0, 1) = made.covariance(1, 0) = 0.1;
    made.covariance(1, 2) = made.covariance(2, 1) = -0.15;
    return made;
  }

  /// Away from the priors' means.
  VecX unknowns(const DrapeObjective& objective) const {
    VecX u = VecX::Zero(objective.unknowns());
    u.head(3) = z + Eigen::Vector3d(0.03, -0.02, 0.04);
    if (u.size() > 3) u.tail(5) << 1.3, -0.7, 0.05, 0.003, -0.006;
    return u;
  }

  ParameterSpace space;
  VecX z;
  std::vector<Picture> pictures;
  std::vector<Equilibrium> drapes;
};

const Case& stiff() {
  static const Case c;
  return c;
}

VecX residuals(DrapeObjective& objective, const VecX& u) {
  VecX r;
  if (!objective.residuals_at(u, r, nullptr)) throw std::runtime_error("branch lost");
  return r;
}

double cost(DrapeObjective& objective, const VecX& u) {
  double value;
  if (!objective.cost_at(u, value, nullptr)) throw std::runtime_error("branch lost");
  return value;
}

/// Central differences of f at the best of some steps, each column relative to its largest entry: a
/// corner of the outline that passes from one edge to the next bends f, so no single step is best.
template <typename Function>
double error_against_differences(const Function& f, const VecX& u, const MatX& J) {
  double worst = 0;
  for (Eigen::Index j = 0; j < u.size(); ++j) {
    double best = 1;
    for (const double h : {1e-3, 3e-4, 1e-4, 3e-5, 1e-5}) {
      const VecX step = h * VecX::Unit(u.size(), j);
      const VecX difference = (f(u + step) - f(u - step)) / (2 * h);
      best = std::min(best, (difference - J.col(j)).norm() / J.col(j).norm());
    }
    worst = std::max(worst, best);
  }
  return worst;
}

const std::vector<MisfitOptions> kLosses{{},
                                         {.huber = 2},
                                         {.loss = OutlineLoss::coverage},
                                         {.loss = OutlineLoss::signed_distance},
                                         {.loss = OutlineLoss::signed_distance, .huber = 2}};

/// Of derivatives against differences: rounding of re-solved equilibria over the step, but in the
/// coverage the curvature jumps where the outline enters a pixel.
double difference_tolerance(const MisfitOptions& options) {
  return options.loss == OutlineLoss::coverage ? 1e-4 : 1e-6;
}

TEST(DrapeObjective, UnknownsAreThoseOfTheFabricThenOfEachPicture) {
  DrapeObjective one = stiff().objective({stiff().plain()}, std::nullopt);
  EXPECT_EQ(one.unknowns(), 3);
  EXPECT_EQ(one.residuals(), kProfileSize);
  DrapeObjective both = stiff().objective(stiff().pictures, stiff().prior());
  EXPECT_EQ(both.unknowns(), 3 + 4 + 1);
  EXPECT_EQ(both.residuals(), 2 * kProfileSize + 8);
  const VecX u = stiff().unknowns(both);
  EXPECT_EQ(both.placement_at(0, u).centre, 1e-3 * Vec2(1.3, -0.7));
  EXPECT_EQ(both.placement_at(0, u).weft_angle, -0.3 + 0.05);
  EXPECT_EQ(both.placement_at(0, u).log_scale, 0.003);
  EXPECT_EQ(both.placement_at(1, u).centre, Vec2::Zero());
  EXPECT_EQ(both.placement_at(1, u).weft_angle, 0.5);
  EXPECT_EQ(both.placement_at(1, u).log_scale, -0.006);
  EXPECT_EQ(both.bounds().tail(5), (VecX(5) << 10, 10, 0.785, 0.02, 0.04).finished());
}

TEST(DrapeObjective, PriorsAreMahalanobisDistances) {
  DrapeObjective both = stiff().objective(stiff().pictures, stiff().prior());
  const VecX u = stiff().unknowns(both);
  const VecX prior = residuals(both, u).tail(8);
  const VecX miss = u.head(3) - stiff().z;
  // rounding of z, of which the miss is a small part
  EXPECT_NEAR(prior.head(3).squaredNorm(), miss.dot(stiff().prior().covariance.inverse() * miss),
              1e-12);
  EXPECT_LE((prior.tail(5) - (VecX(5) << 1.3 / 5, -0.7 / 5, 0.25, 0.6, -0.6).finished()).norm(),
            1e-14);
}

TEST(DrapeObjective, OneUniformMillimetre) {
  for (const double miss : {0.0, 1e-3})
    for (const int harmonic_count : {30, 15}) {
      Picture off = stiff().plain();
      off.seen.profile = stiff().own_profile().array() + miss;
      off.seen.noise_harmonics = harmonic_count;
      DrapeObjective objective = stiff().objective({off}, std::nullopt);
      // 61 or 31 independent radii, each off by 1 mm = 2 standard deviations
      const double expected = miss > 0 ? 0.5 * (2 * harmonic_count + 1) * 4 : 0;
      EXPECT_NEAR(cost(objective, stiff().z), expected, 1e-9);
      // beyond one deviation Huber's loss is linear: 1/2 (2 * 2 - 1) instead of 1/2 2^2
      DrapeObjective robust = stiff().objective({off}, std::nullopt, {.huber = 1});
      EXPECT_NEAR(cost(robust, stiff().z), expected * 3 / 4, 1e-9);
    }
}

TEST(DrapeObjective, JacobianAgainstDifferences) {
  for (const MisfitOptions& options : kLosses) {
    DrapeObjective objective = stiff().objective(stiff().pictures, stiff().prior(), options);
    const VecX u = stiff().unknowns(objective);
    VecX r;
    MatX J;
    ASSERT_TRUE(objective.residuals_at(u, r, &J));
    EXPECT_EQ(J.rows(), objective.residuals());
    EXPECT_EQ(J.cols(), objective.unknowns());
    const auto f = [&](const VecX& v) { return residuals(objective, v); };
    EXPECT_LE(error_against_differences(f, u, J), difference_tolerance(options))
        << static_cast<int>(options.loss) << " " << options.huber;
  }
}

TEST(DrapeObjective, AdjointGradientIsThatOfTheResiduals) {
  for (const MisfitOptions& options : kLosses)
    for (const bool with_prior : {false, true}) {
      DrapeObjective objective = stiff().objective(
          stiff().pictures, with_prior ? std::optional(stiff().prior()) : std::nullopt, options);
      const VecX u = stiff().unknowns(objective);
      VecX r, gradient;
      MatX J;
      double value;
      ASSERT_TRUE(objective.residuals_at(u, r, &J));
      ASSERT_TRUE(objective.cost_at(u, value, &gradient));
      EXPECT_NEAR(value, 0.5 * r.squaredNorm(), 1e-12 * value);  // rounding of the sums
      // two routes through one factor: rounding times its condition
      EXPECT_LE((gradient - J.transpose() * r).cwiseAbs().maxCoeff(),
                1e-8 * gradient.cwiseAbs().maxCoeff())
          << static_cast<int>(options.loss) << options.huber << with_prior;
    }
}

TEST(DrapeObjective, GradientAgainstDifferences) {
  for (const MisfitOptions& options : kLosses) {
    DrapeObjective objective = stiff().objective(stiff().pictures, stiff().prior(), options);
    const VecX u = stiff().unknowns(objective);
    double value;
    VecX gradient;
    ASSERT_TRUE(objective.cost_at(u, value, &gradient));
    const auto f = [&](const VecX& v) -> VecX { return VecX::Constant(1, cost(objective, v)); };
    EXPECT_LE(error_against_differences(f, u, gradient.transpose()), difference_tolerance(options))
        << static_cast<int>(options.loss) << " " << options.huber;
  }
}

TEST(DrapeObjective, AMissOfOneDeviationCostsTheSameInAllLosses) {
  // the drape's own outline, larger all round by one standard deviation of a radius
  Picture larger = stiff().plain();
  larger.seen.noise = 2e-3;
  const VecX profile = stiff().own_profile();
  const double factor = 1 + larger.seen.noise / profile.mean();
  const Points2 own = trace_outline(larger.model.mesh(), kCusick, stiff().drapes[0].x).points;
  larger.seen.profile = factor * profile;
  larger.seen.grid = centred_grid(1024, 0.34);
  larger.seen.coverage = coverage(factor * own, larger.seen.grid);
  larger.seen.outline = factor * own;
  const auto cost_in = [&](OutlineLoss loss) {
    DrapeObjective objective = stiff().objective({larger}, std::nullopt, {.loss = loss});
    return cost(objective, stiff().z);
  };
  // partly covered pixels of 0.33 mm on both sides of a band of 2 mm: a third of a pixel in all
  EXPECT_NEAR(cost_in(OutlineLoss::coverage) / cost_in(OutlineLoss::profile), 1, 0.1);
  // distances along the normal are shorter than along the radius, by the slope of shallow folds
  EXPECT_NEAR(cost_in(OutlineLoss::signed_distance) / cost_in(OutlineLoss::profile), 1, 0.1);
}

TEST(DrapeObjective, SpentSolvesAreRefused) {
  DrapeObjective objective = stiff().objective(stiff().pictures, std::nullopt, {}, 3);
  const VecX near = stiff().unknowns(objective);
  VecX start = near;
  start.head(3) = stiff().z;
  VecX r, gradient;
  double value;
  EXPECT_TRUE(objective.residuals_at(start, r, nullptr));  // known, nothing to solve
  EXPECT_EQ(objective.solves(), 0);
  EXPECT_TRUE(objective.residuals_at(near, r, nullptr));
  EXPECT_EQ(objective.solves(), 2);  // one a picture
  const VecX other = near.array() + 0.01;
  EXPECT_FALSE(objective.residuals_at(other, r, nullptr));  // the first picture has the third
  EXPECT_TRUE(objective.refused());
  EXPECT_EQ(objective.drape_at(1, other), nullptr);
  EXPECT_NE(objective.drape_at(0, other), nullptr);
  EXPECT_FALSE(objective.cost_at(other, value, &gradient));
  const VecX next_by = near.array() + 1e-4;
  EXPECT_FALSE(objective.residuals_at(next_by, r, nullptr));
  EXPECT_FALSE(objective.at_edge());                      // not a branch that ends
  EXPECT_TRUE(objective.residuals_at(near, r, nullptr));  // still known
  EXPECT_EQ(objective.solves(), 3);
}

TEST(DrapeObjective, StartFromForgetsTheOtherDrapes) {
  DrapeObjective objective = stiff().objective({stiff().plain()}, std::nullopt);
  const VecX near = stiff().unknowns(objective);
  ASSERT_NE(objective.drape_at(0, near), nullptr);
  const int before = objective.solves();
  objective.start_from(
      0, stiff().plain().model,
      make_branch_point(stiff().plain().model, stiff().space, stiff().z, stiff().drapes[0]),
      kTight);
  ASSERT_NE(objective.drape_at(0, near), nullptr);
  EXPECT_GT(objective.solves(), before);
}

TEST(DrapeObjective, RefusesBadInput) {
  const auto make = [](const std::vector<Picture>& pictures,
                       const std::optional<Prior>& prior = std::nullopt) {
    DrapeObjective(pictures, stiff().space, prior, {}, 1);
  };
  EXPECT_NO_THROW(make(stiff().pictures, stiff().prior()));
  EXPECT_THROW(make({}), std::invalid_argument);
  Picture picture = stiff().plain();
  picture.seen.noise = 0;
  EXPECT_THROW(make({stiff().plain(), picture}), std::invalid_argument);
  picture.seen.noise = 1e-3;
  picture.seen.camera.height = 0;
  EXPECT_THROW(make({picture}), std::invalid_argument);
  picture = stiff().plain();
  picture.seen.coverage.resize(0, 0);
  picture.seen.outline.resize(0, 2);
  for (const OutlineLoss loss : {OutlineLoss::coverage, OutlineLoss::signed_distance})
    EXPECT_THROW(DrapeObjective({picture}, stiff().space, std::nullopt, {.loss = loss}, 1),
                 std::invalid_argument);
  Prior prior = stiff().prior();
  prior.covariance(2, 2) = 0;
  EXPECT_THROW(make(stiff().pictures, prior), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
