#include "estimation/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/cpu_clock.h"
#include "estimation/staged_fit.h"

namespace drape {
namespace {

constexpr double kStageTolerance = 1e-3;  // relative cost change that ends a guided fit
constexpr int kStageIterations = 15;      // on a wrong branch a guided fit creeps on
constexpr double kFinalTolerance =
    1e-6;                                // of the free fit, far below what noise leaves of the cost
constexpr int kNeighbourIterations = 8;  // on the right branch they reach the noise
constexpr double kWorthFitting = 2;      // miss of a neighbour over that of the best
constexpr double kBetter = 0.9;
constexpr double kFarFrom = 2;  // explained, of the noise; below, what is missed may be the model's
constexpr double kPopsMove = 1e-3;  // rms of an outline, at most [m]

/// What became of a fit from one start.
struct Attempt {
  EstimateOutcome outcome = EstimateOutcome::no_start;
  double miss = std::numeric_limits<double>::infinity();  ///< over the noise
  FitState state;

  bool free() const { return outcome <= EstimateOutcome::not_converged; }
};

class Estimation {
 public:
  Estimation(const std::vector<Picture>& pictures, const Fabric& start,
             const EstimateOptions& options)
      : options_(options), fit_(pictures, start, options) {
    result_.start = start;
  }

  Estimate run(bool guided) {
    const double start_time = thread_cpu_seconds();
    const Attempt best = guided ? search() : unguided();
    result_.outcome = best.outcome;
    if (best.outcome != EstimateOutcome::no_start) {
      fit_.take_up(best.state);
      fit_.examine();
      result_.posterior = fit_.posterior();
    }
    const FitState& state = fit_.state();
    result_.fabric = state.fabric;
    result_.kappa = state.kappa;
    result_.pictures = state.pictures;
    result_.cost = state.cost;
    result_.message = state.message;
    result_.iterations = fit_.iterations();
    result_.forward_solves = fit_.forward_solves();
    result_.cpu_seconds = thread_cpu_seconds() - start_time;
    return std::move(result_);
  }

 private:
  Attempt unguided() {
    fit_.take_start_states();
    return released(std::nullopt);
  }

  /// Each step is tried where those before it have not explained the outlines.
  Attempt search() {
    const VecX unknowns = fit_.state().u;
    Attempt best = with_moves(guided());
    if (!is_explained(best)) best = with_restarts(std::move(best));
    if (!is_explained(best)) best = with_pops(std::move(best));
    if (best.outcome == EstimateOutcome::no_start) fit_.set_unknowns(unknowns);
    return best;
  }

  static bool is_explained(const Attempt& attempt) {
    return attempt.free() && explains_well(attempt.miss);
  }

  static bool is_better(const Attempt& one, const Attempt& than) {
    return drape::is_better(one.outcome, one.miss, than.outcome, than.miss);
  }

  /// Fits from one guided start after the other, until a free one has the nodes observed or
  /// explains the outlines, be it that its branch ends before its minimum. Each takes up the
  /// unknowns that explained them best under the first guide.
  Attempt guided() {
    Attempt best;
    VecX u = fit_.state().u;
    double guided_miss = std::numeric_limits<double>::infinity();
    for (const GuidedStart& start : guided_starts(options_.guide, options_.guide_harmonics)) {
      fit_.set_unknowns(u);
      if (!fit_.lay_along(start)) continue;
      Attempt now = guided_attempt(guided_miss, u);
      const bool ends = now.free() && (fit_.same_nodes() || explains(now.miss));
      if (is_better(now, best)) best = std::move(now);
      if (ends) break;
    }
    return best;
  }

  /// Where the outlines are far from explained: the same from other first unknowns, each laid once;
  /// then moves from the best of them, if it is better than the one that there was.
  Attempt with_restarts(Attempt best) {
    bool better = false;
    for (int i = 1; i <= options_.max_restarts && !fit_.spent(); ++i) {
      if (best.free() && best.miss < kFarFrom) break;
      fit_.scatter_unknowns(i);
      if (!fit_.lay_along(guided_starts(options_.guide, options_.guide_harmonics).front()))
        continue;
      double guided_miss = std::numeric_limits<double>::infinity();
      VecX u;
      Attempt now = guided_attempt(guided_miss, u);
      if (!is_better(now, best)) continue;
      best = std::move(now);
      better = true;
    }
    return better ? with_moves(std::move(best)) : best;
  }

  /// Moves from the best drape to better ones, until none is found. To a branch that was lost any
  /// free drape with the nodes observed is better.
  Attempt with_moves(Attempt best) {
    if (best.outcome == EstimateOutcome::no_start || is_explained(best)) return best;
    const Attempt first = best;
    if (!best.free()) best.miss = std::numeric_limits<double>::infinity();
    return move(best) ? released_from(best) : first;
  }

  /// Pops vertices of the best free drape, and moves on from what that leads to.
  Attempt with_pops(Attempt best) {
    if (!best.free()) return best;
    bool better = false;
    for (int left = options_.max_pops; left > 0 && !explains_well(best.miss);) {
      fit_.take_up(best.state);
      if (fit_.largest_rms() > kPopsMove) break;
      const int before = fit_.pops();
      if (!pop_through(fit_, left)) break;
      left -= fit_.pops() - before;
      best.state = fit_.state();
      best.miss = fit_.largest_miss();
      better = true;
      if (!move(best)) break;
    }
    return better ? released_from(best) : best;
  }

  Attempt released_from(const Attempt& best) {
    fit_.take_up(best.state);
    return released(std::nullopt);
  }

  /// Whether a move has led to a better drape, which `best` is then.
  bool move(Attempt& best) {
    const std::vector<Move> moves = neighbour_moves(options_.guide_harmonics);
    std::vector<FitState> known{best.state};
    size_t since_better = 0;
    bool found = false;
    for (int tried = 0; tried < options_.max_moves && since_better < moves.size(); ++tried) {
      if (explains_well(best.miss) || fit_.spent()) break;
      ++since_better;
      const size_t which = static_cast<size_t>(tried) % moves.size();
      fit_.take_up(best.state);
      if (!moves[which](fit_) || !fit_.same_nodes()) continue;
      if (std::any_of(known.begin(), known.end(),
                      [&](const FitState& state) { return fit_.is_at(state); }))
        continue;
      known.push_back(fit_.state().without_factors());
      if (fit_.largest_miss() > kWorthFitting * best.miss) continue;
      fit_.minimise(kStageTolerance, kNeighbourIterations);
      const double miss = fit_.largest_miss();
      if (miss > kBetter * best.miss || !fit_.same_nodes()) continue;
      best.state = fit_.state();
      best.miss = miss;
      known = {best.state};
      since_better = 0;
      found = true;
    }
    return found;
  }

  /// From the guided start at hand to a free fit. One that explains the outlines no better than
  /// `guided_miss` under the first guide is not worth releasing; else `u` and `guided_miss` are
  /// its.
  Attempt guided_attempt(double& guided_miss, VecX& u) {
    std::optional<FitState> guided;  // the last guided state with the nodes observed
    for (size_t i = 0; i < options_.guide.size(); ++i) {
      if (!fit_.set_guides(options_.guide[i])) return lost();
      fit_.minimise(kStageTolerance, kStageIterations);
      if (i == 0) {
        const double miss = fit_.largest_miss();
        if (!(miss < guided_miss)) return lost();
        guided_miss = miss;
        u = fit_.state().u;
      }
      if (fit_.same_nodes()) guided = fit_.state();
    }
    return released(guided);
  }

  Attempt unseen_nodes(FitState guided) const {
    guided.message = "the free drapes have other nodes than the pictures";
    return {EstimateOutcome::branch_lost, fit_.largest_miss(), std::move(guided)};
  }

  Attempt lost() const { return {EstimateOutcome::branch_lost, fit_.largest_miss(), fit_.state()}; }

  /// The free fit. One with other nodes than observed has left the branch, be it at its start: the
  /// last guided state that had them is what is kept of it, where there is one.
  Attempt released(const std::optional<FitState>& guided) {
    if (!fit_.set_guides(0)) return lost();
    if (guided && !fit_.same_nodes()) return unseen_nodes(*guided);
    const bool converged = fit_.minimise(kFinalTolerance, options_.max_iterations);
    if (guided && !fit_.same_nodes()) return unseen_nodes(*guided);
    const double miss = fit_.largest_miss();
    FitState state = fit_.state();
    if (!converged) return {EstimateOutcome::not_converged, miss, std::move(state)};
    if (explains(miss)) return {EstimateOutcome::succeeded, miss, std::move(state)};
    state.message = "an outline is missed by " + std::to_string(miss) + " times its noise (rms)";
    return {EstimateOutcome::misfit, miss, std::move(state)};
  }

  EstimateOptions options_;
  StagedFit fit_;
  Estimate result_;
};

}  // namespace

std::string_view name(EstimateOutcome outcome) {
  switch (outcome) {
    case EstimateOutcome::succeeded:
      return "succeeded";
    case EstimateOutcome::misfit:
      return "misfit";
    case EstimateOutcome::not_converged:
      return "not_converged";
    case EstimateOutcome::branch_lost:
      return "branch_lost";
    case EstimateOutcome::no_start:
      return "no_start";
  }
  return "unknown";
}

int standing(EstimateOutcome outcome) {
  switch (outcome) {
    case EstimateOutcome::succeeded:
      return 0;
    case EstimateOutcome::misfit:
    case EstimateOutcome::not_converged:
      return 1;
    case EstimateOutcome::branch_lost:
      return 2;
    case EstimateOutcome::no_start:
      return 3;
  }
  return 4;
}

Estimate estimate(const std::vector<Picture>& pictures, const Fabric& start,
                  const EstimateOptions& options) {
  if (pictures.empty()) throw std::invalid_argument("estimate: no picture of the fabric is given");
  if (options.parameters.empty())
    throw std::invalid_argument("estimate: no parameters to estimate");
  for (const Picture& picture : pictures) {
    if (picture.start_state.has_value() != pictures.front().start_state.has_value())
      throw std::invalid_argument("estimate: some pictures have a start state and some have not");
    if (picture.start_state && !picture.start_state->converged())
      throw std::invalid_argument("estimate: the start state is not a converged equilibrium");
  }
  return Estimation(pictures, start, options).run(!pictures.front().start_state);
}

}  // namespace drape
