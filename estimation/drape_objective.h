// The negative logarithm of the posterior of a fabric given pictures of its drapes, but for a
// constant, as a function of the unknowns of a fit.
//
// Unknowns u: the z of a ParameterSpace, then the nuisances of each picture. With r the residuals
// of all pictures (picture_misfit.h),
//
//   J(u) = 1/2 |r|^2 + 1/2 (z - m)^T C^-1 (z - m) + 1/2 sum over nuisances (v / sd)^2
//
// Where the branch of a picture is lost there is no value.
#pragma once

#include <optional>
#include <vector>

#include "estimation/fit_objective.h"
#include "estimation/picture_misfit.h"
#include "estimation/prior.h"

namespace drape {

class DrapeObjective final : public FitObjective {
 public:
  /// max_solves: of all pictures together. Throws std::invalid_argument without a picture, or for a
  /// bad observation or prior.
  DrapeObjective(std::vector<Picture> pictures, ParameterSpace space,
                 const std::optional<Prior>& prior, const MisfitOptions& options, int max_solves);

  int unknowns() const override { return unknowns_; }
  /// Those of the pictures, then those of the priors.
  int residuals() const override;
  /// Those of the pictures, which come before those of the priors.
  int picture_residuals() const;
  const ParameterSpace& space() const { return space_; }
  size_t pictures() const { return misfits_.size(); }
  const Picture& picture(size_t i) const { return misfits_[i].picture(); }

  /// See PictureMisfit::start_from, of picture i.
  void start_from(size_t i, const Potential& potential, BranchPoint point,
                  const ContinuationOptions& continuation);

  /// Residuals and, if wanted, their Jacobian (residuals x unknowns). False where a branch is lost
  /// or max_solves are spent.
  bool residuals_at(const VecX& u, VecX& r, MatX* jacobian) override;

  /// J and, by one adjoint solve a picture, its gradient. False likewise.
  bool cost_at(const VecX& u, double& cost, VecX* gradient) override;

  /// The drape of picture i at u; nothing where its branch is lost or max_solves are spent. Valid
  /// until the next call.
  const BranchPoint* drape_at(size_t i, const VecX& u);

  Placement placement_at(size_t i, const VecX& u) const;
  /// The nuisances' part of the largest allowed |u|; unbounded for z.
  VecX bounds() const;
  /// Whether the last drape asked for that was not known yet was refused.
  bool refused() const override { return refused_; }
  /// Whether a branch was lost next to a drape that is known: it folds back there.
  bool at_edge() const override { return at_edge_; }
  int solves() const;

 private:
  VecX nuisances_of(size_t i, const VecX& u) const;

  ParameterSpace space_;
  std::vector<PictureMisfit> misfits_;
  std::vector<int> first_nuisance_;  // in u, of each picture
  int unknowns_;
  // priors: rows of W (u - m), W the inverse of the covariance's factor
  MatX prior_weight_;
  VecX prior_mean_;
  int max_solves_;
  bool refused_ = false, at_edge_ = false;
};

}  // namespace drape
