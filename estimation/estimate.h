// Estimation of fabric parameters from pictures of its drapes: the maximum of the posterior, and
// the posterior about it.
//
// Each picture chooses the branch of its drape: the start is minimised under a guide that pulls the
// rim towards the observed outline, and the fit itself runs on guided drapes while the guides of
// all pictures are released together (kappa = 1, 0.1, 0.01, 0). Exact data have zero residual at
// the truth for every kappa, so the guide biases nothing; without it a fit from elsewhere ends on a
// neighbouring branch. Where a misfit above the noise remains, or the nodes observed are lost with
// the guide, fits from other first parameters are tried, then neighbours of the best drape
// (branch_search.h), then single vertices of the mesh (popping.h). Only a fit counts that ends with
// kappa = 0 on a certified minimum, with the nodes observed, and explains the outlines.
//
// Whether the support acts (core/contact.h) is decided once, at the guided start, and held from
// there on: the loss stays continuous. The last state says whether it would have decided otherwise.
// A picture that brings a start state keeps the support of its model.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/contact.h"
#include "estimation/drape_objective.h"
#include "estimation/minimise.h"
#include "estimation/posterior.h"

namespace drape {

struct EstimateOptions {
  std::vector<Parameter> parameters{Parameter::k_h, Parameter::k_bu, Parameter::k_bv,
                                    Parameter::k_bh};
  FitMethod method = FitMethod::levenberg_marquardt;
  MisfitOptions misfit;
  std::optional<Prior> prior;  ///< of the chosen parameters; none: flat within the bounds
  std::vector<double> guide{1, 0.1,
                            0.01};  ///< kappas before the unguided fit; empty: unguided only
  int guide_harmonics = 24;         ///< of the observed profile
  double bound_factor = 100;        ///< estimates stay within start / factor .. start * factor
  int max_iterations = 60;          ///< of each fit
  ContactMode contact = ContactMode::automatic;  ///< with a start state, the model's is held
  EquilibriumOptions equilibrium;                ///< of the first, guided solve
  /// Along the unguided fit: trials that lose the branch are given up at once, Ceres shortens them.
  ContinuationOptions continuation{.halvings = 0, .largest_leap = 0.7};
  int max_solves = 3000;  ///< forward solves of one fit a picture, over all stages
  // where a misfit remains, one after the other; 0: not tried
  int max_restarts = 8;  ///< fits from other first parameters
  int max_moves = 50;    ///< to neighbouring drapes (branch_search.h)
  int max_pops = 2000;   ///< of single vertices (popping.h)
};

enum class EstimateOutcome {
  succeeded,      ///< guide released, converged, certified minimum
  misfit,         ///< as succeeded, but an outline is missed by more than its noise
  not_converged,  ///< iterations or solves ran out, or the branch ends at the last state
  branch_lost,    ///< no drape with the nodes observed was left when the guide was released
  no_start,       ///< no guided drape was found for the first parameters
};
std::string_view name(EstimateOutcome outcome);
/// Outcomes from good (0) to bad; a misfit and a fit that has not converged are free drapes alike,
/// and what they miss says which is better.
int standing(EstimateOutcome outcome);

/// What became of one picture.
struct PictureEstimate {
  Equilibrium
      equilibrium;      ///< of the estimated fabric, under the guide of strength Estimate::kappa
  Placement placement;  ///< of the picture on this drape
  Contact contact;      ///< held over the fit; what is seen of it in the last state
  bool contact_doubtful = false;  ///< the last state would have decided otherwise
  VecX start_profile;             ///< of the first drape, in the picture's frame [m]
  double outline_rms = 0;         ///< of the profile's misfit [m]
};

struct Estimate {
  EstimateOutcome outcome = EstimateOutcome::no_start;
  Fabric start, fabric;
  double kappa = 0;  ///< of the last guide; 0 unless the branch was lost
  std::vector<PictureEstimate> pictures;
  Posterior posterior;  ///< NaN unless the guide is gone
  /// Minus the logarithm of the posterior, up to a constant; infinite unless the guide is gone.
  double cost = std::numeric_limits<double>::infinity();
  int iterations = 0;
  int forward_solves = 0;
  double cpu_seconds = 0;
  std::string message;
};

/// `start`: the first fabric; it also holds the values of the parameters that are not estimated.
/// Where all pictures bring a start state, the fit is unguided from there; otherwise see above.
/// Throws std::invalid_argument on bad input only.
Estimate estimate(const std::vector<Picture>& pictures, const Fabric& start,
                  const EstimateOptions& options);

}  // namespace drape
