#include "adjoint/fold.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/indefinite_factor.h"

namespace drape {
namespace {

constexpr double kLength = 1e-2;            // the movement that weighs as much as unit s [m]
constexpr int kMaxSteps = 60;               // along the curve
constexpr int kMaxCorrections = 8;          // Newton iterations of a step
constexpr int kGoodCorrections = 4;         // up to here the next step may be longer
constexpr double kLargestDeviation = 0.35;  // of a step from its prediction, over its way
constexpr int kHalvings = 8;                // of the first step, then the curve counts as lost
constexpr int kRefinements = 3;             // secant steps to a limit point
constexpr double kRegularSteps = 8;         // smallest natural steps after which a branch goes on
constexpr double kBeyond = 0.25;            // smallest natural steps from a fold to the next state
constexpr double kPush = 1e-5;              // off the end of a branch, along the curve [m]
constexpr double kSmallestSnap = 1e-4;      // of a vertex; anything less is no snap [m]

/// A point of the solution curve g(x, s) = 0, over the unknowns in free order.
struct CurvePoint {
  VecX x;  // 3n
  double s = 0;
  VecX tangent_x;  // free
  double tangent_s = 0;
  int negative_eigenvalues = 0;
};

/// Pseudo-arclength steps along the solution curve; sigma, its length, is measured by
/// |dx|^2 / (unknowns/3 kLength^2) + ds^2.
class SolutionCurve {
 public:
  SolutionCurve(Potential& potential, const FabricPath& path, double tolerance,
                ContinuationCost& cost)
      : potential_(potential),
        path_(path),
        tolerance_(tolerance),
        cost_(cost),
        weight_(3 / (static_cast<double>(3 * potential.discretization().free_vertex_count()) *
                     kLength * kLength)) {}

  CurvePoint start(const BranchState& at, double direction) {
    tolerance_ = std::max({tolerance_, 2 * potential_.rounding_floor(at.equilibrium.x)});
    CurvePoint point{at.equilibrium.x, at.s,
                     direction * potential_.discretization().to_free(at.dx_ds), direction, 0};
    normalise(point);
    return point;
  }

  /// The point at distance sigma along the tangent; nothing when Newton's method finds none.
  std::optional<CurvePoint> step(const CurvePoint& from, double sigma, int& corrections) {
    const Discretization& d = potential_.discretization();
    CurvePoint to{from.x + sigma * d.to_full(from.tangent_x), from.s + sigma * from.tangent_s,
                  from.tangent_x, from.tangent_s, 0};
    double miss = 0;  // t.(y - y_predicted)
    for (corrections = 0; corrections <= kMaxCorrections; ++corrections) {
      potential_.set_fabric(path_.fabric(to.s));
      const VecX g = potential_.gradient(to.x);
      const double residual = potential_.residual(g);
      if (!std::isfinite(residual)) return std::nullopt;
      potential_.hessian(to.x, 0, hessian_);
      ++cost_.factorizations;
      if (!factor_.factorize(hessian_)) return std::nullopt;
      const VecX b = factor_.solve(d.to_free(gradient_ds(potential_, path_, to.s, to.x)));
      if (residual <= tolerance_) {
        to.negative_eigenvalues = factor_.negative_eigenvalues();
        turn_along(to, b);
        return to;
      }
      const VecX a = factor_.solve(d.to_free(g));
      const double ds = (weight_ * from.tangent_x.dot(a) - miss) /
                        (from.tangent_s - weight_ * from.tangent_x.dot(b));
      const VecX dx = -a - ds * b;
      ++cost_.newton_iterations;
      miss += weight_ * from.tangent_x.dot(dx) + from.tangent_s * ds;
      to.x += d.to_full(dx);
      to.s += ds;
      const double wandered = std::sqrt(weight_ * dx.squaredNorm() + ds * ds);
      if (!(wandered < 2 * std::abs(sigma))) return std::nullopt;
    }
    return std::nullopt;
  }

  /// Whether a step left its prediction by too much of its way.
  bool curved(const CurvePoint& from, const CurvePoint& to, double sigma) const {
    const VecX predicted = from.x + sigma * potential_.discretization().to_full(from.tangent_x);
    return largest_distance(to.x, predicted) > kLargestDeviation * sigma * largest_move(from);
  }

  /// Largest movement of a vertex along a tangent over unit sigma [m].
  double largest_move(const CurvePoint& point) const {
    const VecX full = potential_.discretization().to_full(point.tangent_x);
    return largest_distance(full, VecX::Zero(full.size()));
  }

 private:
  /// The tangent at a point from b = H^-1 dg/ds, on the same way as the tangent it has.
  void turn_along(CurvePoint& point, const VecX& b) const {
    const double along = point.tangent_s - weight_ * point.tangent_x.dot(b);
    point.tangent_x = -b;
    point.tangent_s = 1;
    normalise(point);
    if (along >= 0) return;
    point.tangent_x = -point.tangent_x;
    point.tangent_s = -point.tangent_s;
  }

  void normalise(CurvePoint& point) const {
    const double length =
        std::sqrt(weight_ * point.tangent_x.squaredNorm() + point.tangent_s * point.tangent_s);
    point.tangent_x /= length;
    point.tangent_s /= length;
  }

  Potential& potential_;
  const FabricPath& path_;
  double tolerance_;
  ContinuationCost& cost_;
  double weight_;
  IndefiniteFactor factor_;
  SparseMatrix hessian_;
};

Fold fold_at(const Potential& potential, const SolutionCurve& curve, const CurvePoint& point,
             BranchEnd end, int negative_eigenvalues) {
  return {end, point.s, point.x,
          potential.discretization().to_full(point.tangent_x) / curve.largest_move(point),
          negative_eigenvalues};
}

/// The limit point between `before` and the point sigma further on, where ds/dsigma has changed
/// sign.
CurvePoint limit_point(SolutionCurve& curve, CurvePoint before, const CurvePoint& after,
                       double sigma) {
  CurvePoint best = std::abs(before.tangent_s) < std::abs(after.tangent_s) ? before : after;
  double low = 0, high = sigma, at_low = before.tangent_s, at_high = after.tangent_s;
  for (int i = 0; i < kRefinements; ++i) {
    const double middle = low + (high - low) * at_low / (at_low - at_high);
    int corrections = 0;
    const auto point = curve.step(before, middle, corrections);
    if (!point) break;
    if (std::abs(point->tangent_s) < std::abs(best.tangent_s)) best = *point;
    (point->tangent_s * at_low > 0 ? low : high) = middle;
    (point->tangent_s * at_low > 0 ? at_low : at_high) = point->tangent_s;
  }
  return best;
}

}  // namespace

std::string_view name(BranchEnd end) {
  switch (end) {
    case BranchEnd::limit_point:
      return "limit_point";
    case BranchEnd::bifurcation:
      return "bifurcation";
    case BranchEnd::regular:
      return "regular";
    case BranchEnd::unresolved:
      return "unresolved";
  }
  return "unknown";
}

Fold trace_fold(Potential& potential, const FabricPath& path, const BranchState& last,
                double direction, const BranchOptions& options, ContinuationCost& cost) {
  potential.set_fabric(path.fabric(last.s));
  SolutionCurve curve(potential, path, options.equilibrium.tolerance, cost);
  CurvePoint point = curve.start(last, direction);
  double sigma = options.smallest_step / std::abs(point.tangent_s);
  const double smallest = std::ldexp(sigma, -kHalvings);
  for (int i = 0; i < kMaxSteps; ++i) {
    int corrections = 0;
    const auto next = curve.step(point, sigma, corrections);
    const int negative = next ? next->negative_eigenvalues : 0;
    const bool turned = next && next->tangent_s * direction < 0;
    // a step over a fold must show both signs of it, else it went over more than one
    const bool mixed = turned != (negative > 0);
    if ((!next || mixed || curve.curved(point, *next, sigma)) && sigma > smallest) {
      sigma /= 2;
      continue;
    }
    if (!next) break;
    if (turned)
      return fold_at(potential, curve, limit_point(curve, point, *next, sigma),
                     negative > 0 ? BranchEnd::limit_point : BranchEnd::unresolved, negative);
    if (negative > 0) return fold_at(potential, curve, *next, BranchEnd::bifurcation, negative);
    point = *next;
    if (direction * (point.s - last.s) > kRegularSteps * options.smallest_step)
      return fold_at(potential, curve, point, BranchEnd::regular, 0);
    if (corrections <= kGoodCorrections) sigma *= 1.5;
  }
  return fold_at(potential, curve, point, BranchEnd::unresolved, point.negative_eigenvalues);
}

bool sweep(Potential& potential, const FabricPath& path, double s1, const BranchOptions& options,
           BranchState& state, ContinuationCost& cost, const SweepVisitor& visitor) {
  const double direction = s1 >= state.s ? 1 : -1;
  bool stopped = false;
  const auto visit = [&](const BranchState& at) {
    if (visitor.point && !visitor.point(at)) stopped = true;
    return !stopped;
  };
  while (!follow_minima(potential, path, s1, options, state, cost, visit)) {
    if (stopped) return false;
    Fold fold = trace_fold(potential, path, state, direction, options, cost);
    const bool goes_on = fold.end == BranchEnd::regular;
    const double beyond = fold.s + (goes_on ? 0 : direction * kBeyond * options.smallest_step);
    const double s = direction * (beyond - s1) > 0 ? s1 : beyond;
    potential.set_fabric(path.fabric(s));
    const VecX left = goes_on ? fold.x : VecX(fold.x + kPush * fold.onward);
    Equilibrium fallen = solve_equilibrium(potential, left, options.equilibrium);
    ++cost.solves;
    cost.newton_iterations += fallen.newton_iterations;
    cost.factorizations += fallen.factorizations;
    if (!fallen.converged()) return false;
    fallen.protocol = state.equilibrium.protocol;
    const double jump = largest_distance(fallen.x, fold.x);
    if (jump > kSmallestSnap && visitor.snap)
      visitor.snap({fold, s, fallen.x, jump, potential.energy(fold.x) - fallen.energy});
    state = make_branch_state(potential, path, s, std::move(fallen));
    if (!visit(state)) return false;
  }
  return true;
}

}  // namespace drape
