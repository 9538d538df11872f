// The misfit between the drapes of one specimen and its picture, as a function of the fabric's
// unknowns z (see ParameterSpace) and of the picture's nuisances v.
//
//   J = 1/2 |r|^2,  r_i = psi((rho_i - rho_obs,i) / noise) sqrt(N / 360)
//
// over the 360 directions of the profile, N the independent values among them; psi is the identity
// or, for outlines with outliers, makes r^2 Huber's loss. The coverage loss has the same scale: its
// pixels are weighted so that a uniform radial miss costs what it costs in the profile; there is a
// residual a pixel. In the signed-distance loss the distances of 360 points of the observed
// outline, at equal steps of its length, from the drape's (signed_distance.h) take the place of the
// radii. Every drape is reached along its branch from the nearest drape known (continuation.h).
#pragma once

#include <vector>

#include "core/outline.h"
#include "estimation/continuation.h"
#include "estimation/picture.h"

namespace drape {

enum class OutlineLoss { profile, coverage, signed_distance };

struct MisfitOptions {
  OutlineLoss loss = OutlineLoss::profile;
  /// Misses of a radius or distance beyond this many standard deviations count linearly; 0: none.
  double huber = 0;
};

class PictureMisfit {
 public:
  /// Throws std::invalid_argument for a bad observation.
  PictureMisfit(Picture picture, const MisfitOptions& options);

  const Picture& picture() const { return picture_; }
  int nuisances() const { return nuisances_; }
  int residual_count() const;

  /// The only drape known from here on; clears what was known before. `potential` carries the guide
  /// under which it is in equilibrium. From here on branches are followed as `continuation` says.
  void start_from(const Potential& potential, BranchPoint point,
                  const ContinuationOptions& continuation);

  /// Largest change of an unknown from the nearest drape that is known to z.
  double distance_from_known(const VecX& z) const;

  /// The drape at z; nothing where the branch is lost, or where it is not known and `may_solve` is
  /// false. Valid until the next call.
  const BranchPoint* drape_at(const ParameterSpace& space, const VecX& z, bool may_solve);

  /// The residuals of a drape (residual_count) and, if wanted, their Jacobian over (z, v).
  void residuals(const BranchPoint& drape, const VecX& v, VecX& r, MatX* jacobian) const;

  /// J of a drape and, if wanted, its gradient over (z, v) by one adjoint solve.
  double cost(const ParameterSpace& space, const BranchPoint& drape, const VecX& v, VecX* gradient);

  const ContinuationCost& work() const { return work_; }

 private:
  struct Residuals;
  Residuals residuals_of(const Points2& seen) const;

  Picture picture_;
  MisfitOptions options_;
  Points2 observed_;  // points of the signed-distance loss
  int nuisances_;
  Potential potential_;
  ContinuationOptions continuation_;
  ContinuationCost work_;
  std::vector<BranchPoint> known_;  // the last one was reached last
};

}  // namespace drape
