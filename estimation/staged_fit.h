// A fit in stages on one branch: laid along the observed outlines, then minimised under guides that
// grow weaker, then free. Each picture has its own guide and its own branch.
//
// A state of the fit (FitState) can be kept and taken up again, so that a search over several
// guided starts (estimate.cpp) may fall back on the best.
#pragma once

#include <vector>

#include "estimation/branch_search.h"
#include "estimation/estimate.h"
#include "estimation/popping.h"

namespace drape {

/// How far a fit has come.
struct FitState {
  VecX u;         ///< unknowns (drape_objective.h)
  Fabric fabric;  ///< of u
  double kappa = 0;
  std::vector<PictureEstimate> pictures;
  double cost = std::numeric_limits<double>::infinity();  ///< of a free fit
  std::string message;

  /// To be recognised by or gone back to: the factors of its drapes hold most of its memory.
  FitState without_factors() const;
};

/// A drape without a guide, of the fabric at hand.
enum class FreeDrape {
  lobes,    ///< by the protocol of that name, with the nodes of the picture where it has them
  outline,  ///< laid along the outline on the coarse mesh
  ramp,     ///< by the protocol of that name
};

/// A vertex of one picture's drape to be popped.
struct PicturePop {
  size_t picture;
  Pop pop;
};

class StagedFit {
 public:
  StagedFit(const std::vector<Picture>& pictures, const Fabric& start,
            const EstimateOptions& options);

  /// The drape of every picture under the guides of a start, at the unknowns at hand; false when
  /// one has none. What acts on each drape is decided here.
  bool lay_along(const GuidedStart& start);

  /// The same, and the guides let go while the unknowns stay.
  bool lay_and_release(const GuidedStart& start);

  /// The drapes at hand are pulled past the outlines, by `factor` times what is missed, and let go.
  bool overshoot(double factor);

  /// Drapes that owe nothing to those at hand but what acts on them.
  bool drape_freely(FreeDrape how);

  /// The vertices of the drapes at hand that may be popped, those near what is missed first.
  std::vector<PicturePop> promising_pops() const;
  /// The drapes at hand, free, with that vertex popped; false when there is none.
  bool pop(const PicturePop& which);

  /// The start states that the pictures bring.
  void take_start_states();

  /// The drapes at hand under guides of another strength (0: none); false when one has none near
  /// by.
  bool set_guides(double kappa);

  /// Minimises over the unknowns on the branches at hand. True where that has converged.
  bool minimise(double tolerance, int max_iterations);

  /// Residuals of the drapes at hand and, if wanted, their Jacobian over the unknowns; false where
  /// one is not known.
  bool residuals(VecX& r, MatX* jacobian = nullptr);

  const FitState& state() const { return state_; }
  /// Goes back to a state: its unknowns, its drapes, its guides' strength.
  void take_up(const FitState& state) { state_ = state; }
  /// Goes back to unknowns alone; the drapes are to be laid again.
  void set_unknowns(const VecX& u);
  /// The first unknowns, every logarithm moved by up to log(5): the `index`-th of points that
  /// spread evenly (Halton 1960).
  void scatter_unknowns(int index);
  /// Whether the drapes at hand are those of `state`: the same fabric and the same equilibria.
  bool is_at(const FitState& state) const;
  /// The same for the ends of two fits.
  bool is_near(const FitState& state) const;

  /// Largest rms miss of an outline over the standard deviation of its noise.
  double largest_miss() const;
  /// The same in length [m].
  double largest_rms() const;
  /// Whether every drape has as many nodes as its picture.
  bool same_nodes() const;
  VecX profile_of(size_t picture) const;

  /// Looks at the drapes at hand and measures their misfits.
  void examine();
  /// Laplace's posterior at the state at hand; NaN unless its drapes are free and stable. Where an
  /// outline is missed by more than its noise, what is missed is taken for the noise (the scale
  /// factor of Birge 1932), so that what the model cannot explain widens the intervals.
  Posterior posterior();

  int forward_solves() const { return solves_ + pops_ + objective_.solves(); }
  int pops() const { return pops_; }  ///< of these, after a pop
  int iterations() const { return iterations_; }
  /// Whether the forward solves allowed (EstimateOptions::max_solves) are spent, pops apart.
  bool spent() const {
    return forward_solves() - pops_ >= options_.max_solves * static_cast<int>(pictures());
  }

 private:
  const ParameterSpace& space() const { return objective_.space(); }
  size_t pictures() const { return potentials_.size(); }
  const Picture& picture(size_t i) const { return objective_.picture(i); }
  Guide guide_of(size_t i, double kappa) const;
  double rms_of(size_t i) const;
  bool lay_along(size_t i, const GuidedStart& start);
  Equilibrium drape_freely(size_t i, FreeDrape how) const;
  bool replace_drapes(std::vector<Equilibrium> drapes, double kappa);
  bool drapes_within(double distance, const FitState& of) const;
  ContinuationOptions continuation() const;
  void make_known(size_t i);
  bool keep_drapes(const VecX& u);

  EstimateOptions options_;
  Fabric start_;
  DrapeObjective objective_;
  std::vector<Potential> potentials_;  // with the last guides
  int guide_harmonics_;
  FitState state_;
  int solves_ = 0, pops_ = 0, iterations_ = 0;
};

}  // namespace drape
