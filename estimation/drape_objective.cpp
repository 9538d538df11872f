#include "estimation/drape_objective.h"

#include <Eigen/Cholesky>
#include <limits>
#include <stdexcept>
#include <utility>

namespace drape {
namespace {

constexpr double kSmallStep = 2e-3;  // of the logarithm of a parameter

}  // namespace

DrapeObjective::DrapeObjective(std::vector<Picture> pictures, ParameterSpace space,
                               const std::optional<Prior>& prior, const MisfitOptions& options,
                               int max_solves)
    : space_(std::move(space)), max_solves_(max_solves) {
  if (pictures.empty()) throw std::invalid_argument("no picture of the fabric is given");
  const int p = space_.size();
  unknowns_ = p;
  for (Picture& picture : pictures) {
    misfits_.emplace_back(std::move(picture), options);
    first_nuisance_.push_back(unknowns_);
    unknowns_ += misfits_.back().nuisances();
  }

  const int rows_of_z = prior ? p : 0;
  prior_weight_.setZero(rows_of_z + unknowns_ - p, unknowns_);
  prior_mean_.setZero(unknowns_);
  if (prior) {
    validate(*prior, p);
    prior_mean_.head(p) = prior->mean;
    prior_weight_.topLeftCorner(p, p) =
        prior->covariance.llt().matrixL().solve(MatX::Identity(p, p));
  }
  for (size_t i = 0; i < misfits_.size(); ++i) {
    const VecX sd = nuisance_sd(picture(i).seen);
    for (Eigen::Index k = 0; k < sd.size(); ++k) {
      const Eigen::Index column = first_nuisance_[i] + k;
      prior_weight_(rows_of_z + column - p, column) = 1 / sd[k];
    }
  }
}

int DrapeObjective::residuals() const {
  return picture_residuals() + static_cast<int>(prior_weight_.rows());
}

int DrapeObjective::picture_residuals() const {
  int count = 0;
  for (const PictureMisfit& misfit : misfits_) count += misfit.residual_count();
  return count;
}

void DrapeObjective::start_from(size_t i, const Potential& potential, BranchPoint point,
                                const ContinuationOptions& continuation) {
  refused_ = at_edge_ = false;
  misfits_[i].start_from(potential, std::move(point), continuation);
}

VecX DrapeObjective::nuisances_of(size_t i, const VecX& u) const {
  return u.segment(first_nuisance_[i], misfits_[i].nuisances());
}

Placement DrapeObjective::placement_at(size_t i, const VecX& u) const {
  return placement(picture(i).seen, nuisances_of(i, u));
}

VecX DrapeObjective::bounds() const {
  VecX bounds = VecX::Constant(unknowns_, std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < misfits_.size(); ++i)
    bounds.segment(first_nuisance_[i], misfits_[i].nuisances()) = nuisance_bounds(picture(i).seen);
  return bounds;
}

int DrapeObjective::solves() const {
  int solves = 0;
  for (const PictureMisfit& misfit : misfits_) solves += misfit.work().solves;
  return solves;
}

const BranchPoint* DrapeObjective::drape_at(size_t i, const VecX& u) {
  const int before = misfits_[i].work().solves;
  const VecX z = u.head(space_.size());
  const double step = misfits_[i].distance_from_known(z);
  const BranchPoint* drape = misfits_[i].drape_at(space_, z, solves() < max_solves_);
  const bool solved = misfits_[i].work().solves > before;
  if (drape == nullptr || solved) refused_ = drape == nullptr;
  if (drape == nullptr && solved && step < kSmallStep) at_edge_ = true;
  return drape;
}

bool DrapeObjective::residuals_at(const VecX& u, VecX& r, MatX* jacobian) {
  const int p = space_.size();
  r.resize(residuals());
  if (jacobian != nullptr) jacobian->setZero(residuals(), unknowns());
  Eigen::Index row = 0;
  for (size_t i = 0; i < misfits_.size(); ++i) {
    const BranchPoint* drape = drape_at(i, u);
    if (drape == nullptr) return false;
    VecX own;
    MatX own_jacobian;
    misfits_[i].residuals(*drape, nuisances_of(i, u), own,
                          jacobian != nullptr ? &own_jacobian : nullptr);
    r.segment(row, own.size()) = own;
    if (jacobian != nullptr) {
      const int nuisances = misfits_[i].nuisances();
      jacobian->block(row, 0, own.size(), p) = own_jacobian.leftCols(p);
      jacobian->block(row, first_nuisance_[i], own.size(), nuisances) =
          own_jacobian.rightCols(nuisances);
    }
    row += own.size();
  }
  r.tail(prior_weight_.rows()) = prior_weight_ * (u - prior_mean_);
  if (jacobian != nullptr) jacobian->bottomRows(prior_weight_.rows()) = prior_weight_;
  return true;
}

bool DrapeObjective::cost_at(const VecX& u, double& cost, VecX* gradient) {
  const int p = space_.size();
  const VecX miss = prior_weight_ * (u - prior_mean_);
  double sum = 0.5 * miss.squaredNorm();
  VecX slope = prior_weight_.transpose() * miss;
  for (size_t i = 0; i < misfits_.size(); ++i) {
    const BranchPoint* drape = drape_at(i, u);
    if (drape == nullptr) return false;
    VecX own;
    sum +=
        misfits_[i].cost(space_, *drape, nuisances_of(i, u), gradient != nullptr ? &own : nullptr);
    if (gradient == nullptr) continue;
    slope.head(p) += own.head(p);
    slope.segment(first_nuisance_[i], misfits_[i].nuisances()) += own.tail(misfits_[i].nuisances());
  }
  cost = sum;
  if (gradient != nullptr) *gradient = slope;
  return true;
}

}  // namespace drape
