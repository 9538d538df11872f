// Ways to fit one picture that a study compares: all minimise the same objective from the same
// drape, and differ in what they know of its derivatives.
//
//   levenberg_marquardt              residuals with the sensitivities' Jacobian
//   bfgs                             the adjoint's gradient
//   levenberg_marquardt_differences  forward differences of the residuals
//   bfgs_differences                 central differences of the cost
//   bobyqa                           Powell 2009: quadratic models of the cost
//   nelder_mead                      Nelder and Mead 1965, simplices
//
// Every new fabric's drape is reached along the branch of the start (continuation.h), whoever asks.
// The drapes of differences are cheaper than that: from the drape in the middle, with its factor,
// without a certificate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "estimation/drape_objective.h"
#include "experiments/settings.h"

namespace drape {

struct FitMethodInfo {
  ComparedFit method;
  std::string name, label;  ///< as in a config, for people
};

/// The methods chosen; all of them if none is.
std::vector<FitMethodInfo> compared_fits(const std::vector<ComparedFit>& chosen);

/// The best fit up to here.
struct FitMoment {
  double cpu_seconds;
  int forward_solves;
  double cost;
  VecX z;
};

struct TracedFit {
  bool converged = false;  ///< by a tolerance of the method, within the budget
  std::string message;
  std::vector<FitMoment> moments;  ///< every improvement of the cost, the start first
};

struct TracedFitOptions {
  double cpu_seconds = 20;
  double sufficient_cost = 1e-9;  ///< costs below it are exact
  double bound_factor = 100;      ///< parameters stay within start / factor .. start * factor
  double tolerance = 1e-8;        ///< of the forward solves
  ContinuationOptions continuation{};
};

/// Fits the parameters of `space`, whose reference is the first fabric. The picture brings its
/// start state and has no nuisances, and no threshold control is fitted, else
/// std::invalid_argument.
TracedFit traced_fit(ComparedFit method, const Picture& picture, const ParameterSpace& space,
                     const TracedFitOptions& options);

/// The objective of a fit with derivatives by differences in place of its own.
class DifferencedObjective final : public FitObjective {
 public:
  /// `exact` is that of this one picture, without prior.
  DifferencedObjective(DrapeObjective& exact, double tolerance);

  int unknowns() const override { return exact_.unknowns(); }
  int residuals() const override { return exact_.residuals(); }
  bool residuals_at(const VecX& u, VecX& r, MatX* jacobian) override;
  bool cost_at(const VecX& u, double& cost, VecX* gradient) override;
  bool refused() const override { return exact_.refused(); }
  bool at_edge() const override { return exact_.at_edge(); }
  /// Beyond those of the exact objective.
  int solves() const { return solves_; }

 private:
  bool near_by(const VecX& u, int k, double step, VecX& r);

  DrapeObjective& exact_;
  PictureMisfit misfit_;
  Potential potential_;
  double tolerance_;
  int solves_ = 0;
};

}  // namespace drape
