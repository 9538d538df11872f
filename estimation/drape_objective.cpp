#include "estimation/drape_objective.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "adjoint/adjoint.h"
#include "adjoint/loss.h"
#include "adjoint/sensitivity.h"

namespace drape {
namespace {

constexpr double kIndependentValues = 61;  // of a profile with 30 harmonics
constexpr double kCentreUnit = 1e-3;       // the centre's unknowns are in millimetres
constexpr size_t kKnownDrapes = 6;
constexpr double kPi = 3.14159265358979323846;

}  // namespace

DrapeObjective::DrapeObjective(Potential potential, const Scene& scene, ParameterSpace space,
                               OutlineObservation observation, OutlineLoss loss,
                               double prior_log_sd, int max_solves)
    : potential_(std::move(potential)),
      scene_(scene),
      space_(std::move(space)),
      observation_(std::move(observation)),
      loss_(loss),
      prior_log_sd_(prior_log_sd),
      prior_mean_(space_.encode(space_.reference)),
      max_solves_(max_solves) {
  if (loss_ == OutlineLoss::coverage && !observation_.centre_known)
    throw std::invalid_argument("coverage loss: the centre of the observation must be known");
  if (!(observation_.noise > 0)) throw std::invalid_argument("observation noise must be > 0 m");
}

void DrapeObjective::start_from(const Potential& potential, BranchPoint point,
                                const ContinuationOptions& continuation) {
  potential_ = potential;
  continuation_ = continuation;
  refused_ = false;
  known_.clear();
  known_.push_back(std::move(point));
}

Vec2 DrapeObjective::centre_of(const VecX& u) const {
  return observation_.centre_known ? Vec2(Vec2::Zero()) : Vec2(kCentreUnit * u.tail<2>());
}

double DrapeObjective::profile_weight() const {
  return kIndependentValues / (observation_.noise * observation_.noise);
}

const BranchPoint* DrapeObjective::drape_at(const VecX& u) {
  const VecX z = u.head(space_.size());
  const auto nearest =
      std::min_element(known_.begin(), known_.end(), [&](const auto& a, const auto& b) {
        return (a.z - z).squaredNorm() < (b.z - z).squaredNorm();
      });
  if (nearest->z == z) {
    std::rotate(nearest, nearest + 1, known_.end());
    return &known_.back();
  }
  std::optional<BranchPoint> reached;
  if (work_.solves < max_solves_)
    reached = follow_branch(potential_, space_, *nearest, z, continuation_, &work_);
  refused_ = !reached;
  if (refused_) return nullptr;
  if (known_.size() >= kKnownDrapes) known_.erase(known_.begin());
  known_.push_back(*std::move(reached));
  return &known_.back();
}

bool DrapeObjective::residuals_at(const VecX& u, VecX& r, MatX* jacobian) {
  const BranchPoint* drape = drape_at(u);
  if (drape == nullptr) return false;
  const VecX& x = drape->equilibrium.x;
  const Vec2 centre = centre_of(u);
  const Outline outline = trace_outline(potential_.mesh(), scene_, x);
  const Profile profile = radial_profile(outline.points, centre);
  const double scale = std::sqrt(profile_weight() / kProfileSize);

  r.resize(residuals());
  r.head(kProfileSize) = scale * (profile.radius - observation_.profile);
  if (has_prior()) r.tail(space_.size()) = (u.head(space_.size()) - prior_mean_) / prior_log_sd_;
  if (jacobian == nullptr) return true;

  jacobian->setZero(residuals(), unknowns());
  jacobian->topLeftCorner(kProfileSize, space_.size()) =
      scale * profile_sensitivities(outline, profile, centre, x, drape->dx_dz);
  if (!observation_.centre_known)
    for (int k = 0; k < 2; ++k) {
      // moving the centre is moving the outline the other way
      Points2 moved = Points2::Zero(outline.size(), 2);
      moved.col(k).setConstant(-kCentreUnit);
      jacobian->col(space_.size() + k).head(kProfileSize) =
          scale * push_forward(profile, outline.points, centre, moved);
    }
  if (has_prior())
    jacobian->bottomLeftCorner(space_.size(), space_.size())
        .diagonal()
        .setConstant(1 / prior_log_sd_);
  return true;
}

bool DrapeObjective::cost_at(const VecX& u, double& cost, VecX* gradient) {
  const BranchPoint* drape = drape_at(u);
  if (drape == nullptr) return false;
  const VecX& x = drape->equilibrium.x;
  const Outline outline = trace_outline(potential_.mesh(), scene_, x);
  // a radial miss d all round costs 1/2 d^2 in the profile and 1/2 d 2 pi r in the image
  const double scale = loss_ == OutlineLoss::profile ? profile_weight()
                                                     : profile_weight() * observation_.noise /
                                                           (2 * kPi * observation_.profile.mean());
  const Loss loss = loss_ == OutlineLoss::profile
                        ? profile_loss(outline, observation_.profile, centre_of(u))
                        : coverage_loss(outline, observation_.grid, observation_.coverage);
  cost = scale * loss.value;
  const VecX miss = (u.head(space_.size()) - prior_mean_) / (has_prior() ? prior_log_sd_ : 1);
  if (has_prior()) cost += 0.5 * miss.squaredNorm();
  if (gradient == nullptr) return true;

  potential_.set_fabric(space_.decode(drape->z));
  const ParameterVector dL_dp =
      adjoint_gradient(potential_, drape->equilibrium, pull_back(outline, x, loss.dL_dpoints));
  gradient->resize(unknowns());
  const VecX dp_dz = space_.derivative(drape->z);
  for (int i = 0; i < space_.size(); ++i)
    (*gradient)[i] =
        scale * dL_dp[static_cast<int>(space_.parameters[static_cast<size_t>(i)])] * dp_dz[i];
  if (has_prior()) gradient->head(space_.size()) += miss / prior_log_sd_;
  if (!observation_.centre_known)
    gradient->tail<2>() = -scale * kCentreUnit * loss.dL_dpoints.colwise().sum().transpose();
  return true;
}

}  // namespace drape
