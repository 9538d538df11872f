// Estimation of fabric parameters from the outline of one drape.
//
// The observation chooses the branch: the start is minimised under a guide that pulls the rim
// towards the observed outline, and the fit itself runs on guided drapes while the guide is
// released (kappa = 1, 0.1, 0.01, 0). Exact data have zero residual at the truth for every kappa,
// so the guide biases nothing; without it a fit from elsewhere ends on a neighbouring branch. Where
// a misfit above the noise remains, other guided starts are tried (branch_search.h). Only a fit
// counts that ends with kappa = 0 on a certified minimum, with the nodes observed, and explains the
// outline.
//
// Whether the support acts (core/contact.h) is decided once, at the guided start, and held from
// there on: the loss stays continuous. The last state says whether it would have decided otherwise.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/contact.h"
#include "estimation/minimise.h"

namespace drape {

struct EstimateOptions {
  std::vector<Parameter> parameters{Parameter::k_h, Parameter::k_bu, Parameter::k_bv,
                                    Parameter::k_bh};
  FitMethod method = FitMethod::levenberg_marquardt;
  OutlineLoss loss = OutlineLoss::profile;
  std::vector<double> guide{1, 0.1,
                            0.01};  ///< kappas before the unguided fit; empty: unguided only
  int guide_harmonics = 24;         ///< of the observed profile
  double bound_factor = 100;        ///< estimates stay within start / factor .. start * factor
  double prior_log_sd = 0;          ///< of ln p about the start; 0: no prior
  int max_iterations = 60;          ///< of each fit
  ContactMode contact = ContactMode::automatic;  ///< with a start state, the model's is held
  EquilibriumOptions equilibrium;                ///< of the first, guided solve
  /// Along the unguided fit: trials that lose the branch are cheap to give up, Ceres shortens them.
  ContinuationOptions continuation{.halvings = 2, .largest_leap = 0.7};
  int max_solves = 400;  ///< forward solves of one fit, over all stages
};

enum class EstimateOutcome {
  succeeded,      ///< guide released, converged, certified minimum
  no_start,       ///< no guided drape was found for the first parameters
  branch_lost,    ///< releasing the guide left the branch: the state is guided still
  misfit,         ///< as succeeded, but the outline is missed by more than its noise
  not_converged,  ///< iterations or solves ran out, or the last steps all left the branch
};
std::string_view name(EstimateOutcome outcome);

struct Estimate {
  EstimateOutcome outcome = EstimateOutcome::no_start;
  Fabric start, fabric;
  Equilibrium equilibrium;        ///< of `fabric`, under the guide `kappa`
  double kappa = 0;               ///< of the last guide; 0 unless the branch was lost
  Vec2 centre = Vec2::Zero();     ///< of the observation in the drape's frame [m]
  Contact contact;                ///< held over the fit; what is seen of it in the last state
  bool contact_doubtful = false;  ///< the last state would have decided otherwise
  VecX start_profile;             ///< of the first drape [m]
  VecX log_sd;                    ///< Gauss-Newton standard deviations of the unknowns
  double outline_rms = 0;         ///< of the profile's misfit [m]
  int iterations = 0;
  int forward_solves = 0;
  double cpu_seconds = 0;
  std::string message;
};

/// `model` gives mesh, bending reading and gravity. With `start_state`, an equilibrium of `start`
/// without guide, the fit is unguided from there; otherwise see above. Throws std::invalid_argument
/// on bad input only.
Estimate estimate(const Potential& model, const Scene& scene, const OutlineObservation& observation,
                  const Fabric& start, const EstimateOptions& options,
                  const std::optional<Equilibrium>& start_state = std::nullopt);

}  // namespace drape
