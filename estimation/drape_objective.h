// The misfit between a drape and an observed outline, as a function of the unknowns of a fit.
//
// Unknowns u: the z of a ParameterSpace, then, for photographs, the centre of the observed outline
// in the drape's frame (2 values in millimetres). With residuals r over the 360 directions of the
// profile,
//
//   J(u) = 1/2 |r|^2,  r = (rho(alpha; centre) - rho_obs(alpha)) / noise * sqrt(61 / 360)
//          [+ 1/2 |(z - z_start) / prior_log_sd|^2]
//
// (61 independent values: a profile carries 30 harmonics). The coverage loss has the same scale:
// its pixels are weighted so that a uniform radial miss costs what it costs in the profile. Every
// drape is reached along its branch from the nearest drape known (continuation.h); where the branch
// is lost there is no value.
#pragma once

#include <optional>
#include <vector>

#include "core/coverage.h"
#include "core/outline.h"
#include "core/profile.h"
#include "core/scene.h"
#include "estimation/continuation.h"

namespace drape {

/// What was seen of one drape.
struct OutlineObservation {
  VecX profile;              ///< kProfileSize radii about the observation's origin [m]
  double noise = 5e-4;       ///< standard deviation of a radius [m]
  bool centre_known = true;  ///< whether that origin is the axis of the support
  PixelGrid grid;            ///< of `coverage`
  CoverageImage coverage;    ///< needed by the coverage loss only
};

enum class OutlineLoss { profile, coverage };

class DrapeObjective {
 public:
  DrapeObjective(Potential potential, const Scene& scene, ParameterSpace space,
                 OutlineObservation observation, OutlineLoss loss, double prior_log_sd,
                 int max_solves);

  int unknowns() const { return space_.size() + (observation_.centre_known ? 0 : 2); }
  int residuals() const { return kProfileSize + (has_prior() ? space_.size() : 0); }
  const ParameterSpace& space() const { return space_; }

  /// The only drape known from here on; clears what was known before. `potential` carries the guide
  /// under which it is in equilibrium. From here on branches are followed as `continuation` says.
  void start_from(const Potential& potential, BranchPoint point,
                  const ContinuationOptions& continuation);

  /// Residuals and, if wanted, their Jacobian (residuals x unknowns). False where the branch is
  /// lost.
  bool residuals_at(const VecX& u, VecX& r, MatX* jacobian);

  /// J and, by one adjoint solve, its gradient. False where the branch is lost.
  bool cost_at(const VecX& u, double& cost, VecX* gradient);

  /// The drape at u, nothing where the branch is lost or max_solves are spent. Valid until the next
  /// call.
  const BranchPoint* drape_at(const VecX& u);

  Vec2 centre_of(const VecX& u) const;
  /// Whether the last drape asked for that was not known yet was refused. A minimiser that shrinks
  /// its steps because of this has not converged.
  bool refused() const { return refused_; }
  const ContinuationCost& work() const { return work_; }

 private:
  bool has_prior() const { return prior_log_sd_ > 0; }
  double profile_weight() const;

  Potential potential_;
  Scene scene_;
  ParameterSpace space_;
  OutlineObservation observation_;
  OutlineLoss loss_;
  double prior_log_sd_;
  VecX prior_mean_;
  int max_solves_;
  ContinuationOptions continuation_;
  ContinuationCost work_;
  bool refused_ = false;
  std::vector<BranchPoint> known_;  // the last one was reached last
};

}  // namespace drape
