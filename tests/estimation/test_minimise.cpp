// Minimisers on an objective whose values end at an edge, as a branch of drapes ends at a fold.
#include "estimation/minimise.h"

#include <gtest/gtest.h>

namespace drape {
namespace {

/// r = u - target, which has a value up to the edge only.
class Cliff final : public FitObjective {
 public:
  Cliff(double target, double edge) : target_(target), edge_(edge) {}
  int unknowns() const override { return 1; }
  int residuals() const override { return 1; }
  bool residuals_at(const VecX& u, VecX& r, MatX* jacobian) override {
    ++evaluations;
    refused_ = u[0] > edge_;
    if (refused_) {
      at_edge_ = at_edge_ || u[0] - last_ < 2e-3;
      return false;
    }
    last_ = u[0];
    r = VecX::Constant(1, u[0] - target_);
    if (jacobian != nullptr) jacobian->setOnes(1, 1);
    return true;
  }
  bool cost_at(const VecX& u, double& cost, VecX* gradient) override {
    VecX r;
    if (!residuals_at(u, r, nullptr)) return false;
    cost = 0.5 * r.squaredNorm();
    if (gradient != nullptr) *gradient = r;
    return true;
  }
  bool refused() const override { return refused_; }
  bool at_edge() const override { return at_edge_; }

  int evaluations = 0;

 private:
  double target_, edge_, last_ = 0;
  bool refused_ = false, at_edge_ = false;
};

/// A curved valley (Rosenbrock 1960) with a value next to the last one only, as drapes are followed
/// along a branch; its end is far below what the curvature at its start promises.
class Leash final : public FitObjective {
 public:
  explicit Leash(double length) : length_(length) {}
  int unknowns() const override { return 2; }
  int residuals() const override { return 2; }
  bool residuals_at(const VecX& u, VecX& r, MatX* jacobian) override {
    refused_ = (u - last_).norm() > length_;
    if (refused_) return false;
    last_ = u;
    r = Vec2(10 * (u[1] - u[0] * u[0]), 1 - u[0]);
    if (jacobian != nullptr) *jacobian = (MatX(2, 2) << -20 * u[0], 10, -1, 0).finished();
    return true;
  }
  bool cost_at(const VecX& u, double& cost, VecX* gradient) override {
    VecX r;
    MatX J;
    if (!residuals_at(u, r, &J)) return false;
    cost = 0.5 * r.squaredNorm();
    if (gradient != nullptr) *gradient = J.transpose() * r;
    return true;
  }
  bool refused() const override { return refused_; }
  bool at_edge() const override { return false; }

 private:
  double length_;
  VecX last_ = Vec2(-1.2, 1);
  bool refused_ = false;
};

MinimiseOptions within(double bound, FitMethod method = FitMethod::levenberg_marquardt,
                       int unknowns = 1) {
  MinimiseOptions options;
  options.method = method;
  options.lower = VecX::Constant(unknowns, -bound);
  options.upper = VecX::Constant(unknowns, bound);
  return options;
}

TEST(Minimise, FindsAMinimumInside) {
  for (const FitMethod method : {FitMethod::levenberg_marquardt, FitMethod::bfgs}) {
    Cliff objective(0.3, 10);
    const Minimum minimum = minimise(objective, VecX::Zero(1), within(20, method));
    EXPECT_TRUE(minimum.converged) << minimum.message;
    EXPECT_NEAR(minimum.u[0], 0.3, 5e-3);  // the cost that suffices is 1e-5
  }
}

TEST(Minimise, FindsAMinimumThatIsFollowedInSmallSteps) {
  for (const FitMethod method : {FitMethod::levenberg_marquardt, FitMethod::bfgs}) {
    for (const double length : {0.1, 0.3}) {
      SCOPED_TRACE(length);
      Leash objective(length);
      const Minimum minimum = minimise(objective, Vec2(-1.2, 1), within(20, method, 2));
      EXPECT_TRUE(minimum.converged) << minimum.message;
      EXPECT_LE(minimum.cost, 1e-5);
      EXPECT_NEAR(minimum.u[0], 1, 5e-3);  // the cost that suffices is 1e-5
      EXPECT_NEAR(minimum.initial_cost, 12.1, 1e-12);
    }
  }
}

TEST(Minimise, EndsAtAnEdgeAndSaysSo) {
  for (const FitMethod method : {FitMethod::levenberg_marquardt, FitMethod::bfgs}) {
    Cliff objective(1, 0.6);
    const Minimum minimum = minimise(objective, VecX::Zero(1), within(20, method));
    EXPECT_FALSE(minimum.converged);
    EXPECT_TRUE(objective.at_edge());
    EXPECT_NEAR(minimum.u[0], 0.6, 4e-3);  // two small steps
    EXPECT_NE(minimum.message.find("a branch of drapes ends"), std::string::npos)
        << minimum.message;
    EXPECT_LT(objective.evaluations, 60);  // a dozen halvings a step
  }
}

}  // namespace
}  // namespace drape
