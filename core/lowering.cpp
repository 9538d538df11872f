#include "core/lowering.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/drape_protocol.h"

namespace drape {
namespace {

constexpr double kStepTolerance = 1e-3;  // residual on the plate
// from the prediction, over the specimen's radius: wrinkles of a few millimetres form and vanish at
// the line of contact all the time, what halves a step is a snap of the drape
constexpr double kLargestDeviation = 1.0 / 30;
constexpr int kHalvings = 6;

/// The plate on its way down; each method is one part of a step.
class Lowering {
 public:
  Lowering(const Potential& potential, const LoweringOptions& lowering,
           const EquilibriumOptions& options)
      : potential_(potential), options_(options), largest_step_(lowering.largest_step) {
    potential_.set_guide(std::nullopt);
    result_.x = noisy_flat_state(potential.mesh(), lowering.seed);
  }

  Equilibrium run() {
    if (lower_until_free()) {
      potential_.set_plate(std::nullopt);
      result_ = solve(result_.x, options_.tolerance);
    }
    result_.set_work_of(work_);
    result_.protocol = "lowering";
    return std::move(result_);
  }

 private:
  /// False when a solve failed; result_ is the last one then.
  bool lower_until_free() {
    const double radius = potential_.mesh().rest_uv.rowwise().norm().maxCoeff();
    double step = largest_step_;
    VecX velocity = VecX::Zero(result_.x.size());  // dx over a metre of plate
    while (touches()) {
      potential_.set_plate(Plate{.height = height_ - step});
      const VecX predicted = result_.x + step * velocity;
      Equilibrium next = solve(predicted, std::max(kStepTolerance, options_.tolerance));
      const bool solved = next.converged() || next.status == EquilibriumStatus::saddle;
      const double deviation = largest_distance(next.x, predicted);
      const bool left = !solved || deviation > kLargestDeviation * radius;
      if (left && step > std::ldexp(largest_step_, -kHalvings)) {
        step /= 2;
        continue;
      }
      if (!solved) {
        result_ = std::move(next);
        return false;
      }
      // the way a snap went says nothing about what follows
      velocity = left ? VecX(VecX::Zero(velocity.size())) : VecX((next.x - result_.x) / step);
      result_ = std::move(next);
      height_ -= step;
      step = std::min(2 * step, largest_step_);
    }
    return true;
  }

  bool touches() const {
    return std::ranges::any_of(potential_.discretization().free_vertices(),
                               [&](int v) { return result_.x[3 * v + 2] < height_; });
  }

  Equilibrium solve(const VecX& x, double tolerance) {
    EquilibriumOptions step = options_;
    step.tolerance = tolerance;
    step.max_iterations = options_.max_iterations - work_.newton_iterations;
    Equilibrium equilibrium = solve_equilibrium(potential_, x, step);
    work_.add_work_of(equilibrium);
    return equilibrium;
  }

  Potential potential_;
  EquilibriumOptions options_;
  double largest_step_;
  Equilibrium result_;
  double height_ = 2 * kStartNoise;  // all of the flat start touches
  Equilibrium work_;                 // of all solves
};

}  // namespace

Equilibrium drape_by_lowering(const Potential& potential, const LoweringOptions& lowering,
                              const EquilibriumOptions& options) {
  if (!(lowering.largest_step > 0))
    throw std::invalid_argument(
        "lowering: largest_step = " + std::to_string(lowering.largest_step) + " m: must be > 0");
  return Lowering(potential, lowering, options).run();
}

}  // namespace drape
