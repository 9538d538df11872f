#include "core/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/cpu_clock.h"
#include "core/limited_memory.h"

namespace drape {
namespace {

constexpr double kArmijo = 1e-4;
constexpr double kWolfe = 0.8;            // of the slope at the start, uphill at the end
constexpr double kFirstBlend = 0.1;       // the smallest blend above zero
constexpr double kRoundingSlack = 1e-13;  // energy differences below this share of |E| are noise
constexpr double kLeastProgress = 1e-14;  // of |E|, over several steps: what rounding leaves of it
constexpr double kShortestStep = 1e-9;    // of a line search, over the direction

// When the preconditioner is refreshed: it costs as much as about fifteen iterations.
constexpr double kNear = 0.1;              // residual below which the true Hessian is tried
constexpr double kNearAfterRestart = 100;  // the same where a near-by solve lent its factor
constexpr int kLongestUse = 25;            // iterations with one factor, far from equilibrium
constexpr int kLongestUseNear = 60;        // and near it
constexpr int kShortestUseNear = 8;        // iterations after which its contraction is judged
constexpr double kIterationsWorth = 30;    // more iterations than these to go: refresh instead
constexpr int kHardSearches = 3;           // line searches with several backtracks

constexpr int kNoisePatience = 12;  // iterations below the noise of the energy without progress
constexpr int kMaxStalls = 3;       // refreshes in a row that did not help
constexpr int kMostWalls = 5;       // steps over jumps of the energy
constexpr double kOverWall = 0.3;   // of a step
constexpr int kMaxSaddles = 8;
constexpr int kCurvatureIterations = 40;
constexpr double kSaddleStep = 1e-3;  // first step off a saddle [m]

/// The state of one minimisation; each method is one part of an iteration.
class Minimisation {
 public:
  Minimisation(const Potential& potential, const VecX& x, const EquilibriumOptions& options,
               std::shared_ptr<const SparseFactor> nearby)
      : potential_(potential),
        discretization_(potential.discretization()),
        options_(options),
        preconditioner_(std::move(nearby)),
        started_near_(preconditioner_ != nullptr),
        memory_(3 * discretization_.free_vertex_count()),
        energy_scale_(potential.free_weight() * x.cwiseAbs().maxCoeff()) {
    result_.x = x;
  }

  Equilibrium run() {
    const double start = thread_cpu_seconds();
    minimise();
    result_.preconditioner = preconditioner_;
    result_.cpu_seconds = thread_cpu_seconds() - start;
    return std::move(result_);
  }

 private:
  void minimise() {
    evaluate();
    if (!std::isfinite(result_.energy) || !std::isfinite(result_.residual)) {
      result_.status = EquilibriumStatus::non_finite;
      return;
    }
    residual_at_refresh_ = result_.residual;
    for (int saddles = 0;;) {
      if (!descend()) return;
      if (!options_.certify) {
        result_.status = EquilibriumStatus::converged;
        return;
      }
      if (factor(0)) {
        result_.status = EquilibriumStatus::converged;
        result_.negative_eigenvalues = 0;
        result_.factor = preconditioner_;
        return;
      }
      // none counted where Cholesky's factorisation broke down is rounding: not known
      const int negative = negative_eigenvalues(hessian_);
      result_.negative_eigenvalues = negative > 0 ? negative : -1;
      if (++saddles > kMaxSaddles || !leave_saddle()) {
        result_.status = EquilibriumStatus::saddle;
        return;
      }
    }
  }

  /// Iterations until the residual is within tolerance; false sets the status of a failure.
  bool descend() {
    while (result_.residual > options_.tolerance) {
      if (result_.newton_iterations >= options_.max_iterations) {
        result_.status = EquilibriumStatus::iteration_limit;
        return at_rounding_floor();
      }
      ++result_.newton_iterations;
      if (refresh_is_due() && !refresh()) {
        result_.status = EquilibriumStatus::stagnated;
        return at_rounding_floor();
      }
      if (line_search(direction())) {
        ++use_;
        if (options_.go_on && !options_.go_on(result_.x, gradient_)) {
          result_.status = EquilibriumStatus::iteration_limit;
          return at_rounding_floor();
        }
        if (noisy_steps_ <= kNoisePatience) continue;
      }
      take_back_to_best();
      if (at_rounding_floor()) return true;
      if (stalled() && !pass_wall()) {
        result_.status = EquilibriumStatus::stagnated;
        return false;
      }
      if (use_ == 0) near_blend_ = 1;
      noisy_steps_ = 0;
      factor_is_old_ = true;
    }
    return true;
  }

  void evaluate() {
    result_.energy = potential_.energy_and_gradient(result_.x, gradient_);
    result_.residual = potential_.residual(gradient_);
    best_residual_ = result_.residual;
    best_x_ = result_.x;
  }

  bool near() const { return result_.residual < (started_near_ ? kNearAfterRestart : kNear); }

  /// Whether a new factor is worth its price.
  bool refresh_is_due() const {
    if (!preconditioner_ || factor_is_old_) return true;
    if (hard_searches_ >= kHardSearches) return true;
    // where the true Hessian is not positive definite yet, the end is further than it looks
    if (!near() || near_blend_ > 0) return use_ >= kLongestUse;
    if (use_ >= kLongestUseNear) return true;
    if (use_ < kShortestUseNear) return false;
    const double rate = std::log(result_.residual / residual_at_refresh_) / use_;
    const double to_go = std::log(options_.tolerance / result_.residual);
    return rate >= 0 || to_go / rate > kIterationsWorth;
  }

  /// A factor of the blended Hessian at x, its blend as small as wanted and possible; false if
  /// there is none at all.
  bool refresh() {
    double blend = near() ? near_blend_ : 1;
    while (!factor(blend)) {
      if (blend >= 1) {
        if (!lift()) return false;
        break;
      }
      blend = std::min(1.0, std::max(kFirstBlend, 2 * blend + kFirstBlend / 2));
    }
    if (near()) near_blend_ = blend / 2 < kFirstBlend / 2 ? 0 : blend / 2;
    blend_ = blend;
    memory_.clear();
    factor_is_old_ = false;
    use_ = hard_searches_ = 0;
    residual_at_refresh_ = result_.residual;
    return true;
  }

  /// Factorises H(blend) at x; where that works the factor becomes the preconditioner.
  bool factor(double blend) {
    potential_.hessian(result_.x, blend, hessian_);
    return factor_hessian();
  }

  bool factor_hessian() {
    // a factor that is still held outside, or came from there, stays as it is
    if (!own_factor_ || own_factor_.use_count() > (preconditioner_ == own_factor_ ? 2 : 1))
      own_factor_ = std::make_shared<SparseFactor>(discretization_.symbolic_factor());
    if (preconditioner_ == own_factor_) preconditioner_ = nullptr;
    ++result_.factorizations;
    if (!own_factor_->factorize(hessian_)) return false;
    preconditioner_ = own_factor_;
    return true;
  }

  /// Only stiffnesses many orders of magnitude apart get here: lift the diagonal from rounding
  /// size upwards until there is a factor.
  bool lift() {
    const double scale = hessian_.diagonal().maxCoeff();
    for (double share = 1e-14; share < 1; share *= 100) {
      hessian_.diagonal() += VecX::Constant(hessian_.rows(), share * scale);
      if (factor_hessian()) return true;
    }
    return false;
  }

  /// -H g in the free order, no vertex further than largest_move.
  VecX direction() {
    free_gradient_ = discretization_.to_free(gradient_);
    VecX d = -free_gradient_;
    memory_.apply(d, [this](VecX& q) { preconditioner_->solve_in_place(q); });
    const double move = largest_move(d);
    if (move > options_.largest_move) d *= options_.largest_move / move;
    return d;
  }

  static double largest_move(const VecX& d) {
    return d.reshaped(3, d.size() / 3).colwise().norm().maxCoeff();
  }

  /// Armijo backtracking on the energy; where energy differences drown in rounding, on the mean of
  /// the slopes at both ends of the step (the approximate Wolfe condition of Hager and Zhang, SIAM
  /// J. Optim. 16, 2005).
  bool line_search(const VecX& d) {
    const double slope = free_gradient_.dot(d);
    if (!(slope < 0)) return false;
    const double noise = kRoundingSlack * std::max(std::abs(result_.energy), energy_scale_);
    const VecX full = discretization_.to_full(d);
    int backtracks = 0;
    for (double step = 1; step > kShortestStep; ++backtracks) {
      trial_ = result_.x + step * full;
      const double energy = potential_.energy_and_gradient(trial_, trial_gradient_);
      const double residual = potential_.residual(trial_gradient_);
      if (!std::isfinite(energy) || !std::isfinite(residual)) {
        step /= 4;
        continue;
      }
      const bool below_noise = -step * slope < noise;
      if (below_noise ? discretization_.to_free(trial_gradient_).dot(d) <= -kWolfe * slope
                      : energy <= result_.energy + kArmijo * step * slope) {
        hard_searches_ += backtracks >= 2;
        memory_.push(step * d, discretization_.to_free(trial_gradient_) - free_gradient_);
        accept(energy, residual, below_noise);
        return true;
      }
      if (below_noise && backtracks > 3) return false;
      // the minimum of the parabola through energy, slope and the energy tried
      const double parabola = -slope * step * step / (2 * (energy - result_.energy - slope * step));
      step = std::clamp(parabola, step / 10, step / 2);
    }
    return false;
  }

  void accept(double energy, double residual, bool below_noise) {
    result_.x.swap(trial_);
    gradient_.swap(trial_gradient_);
    result_.energy = energy;
    result_.residual = residual;
    if (!below_noise || residual < 0.9 * best_residual_) {
      noisy_steps_ = 0;
      best_residual_ = residual;
      best_x_ = result_.x;
    } else {
      ++noisy_steps_;
    }
  }

  /// To the state with the smallest residual, unless it is above its floor and this one has less
  /// energy: in a curved valley that is nearly flat the residual grows before it falls.
  void take_back_to_best() {
    if (best_residual_ >= result_.residual) return;
    const VecX x = result_.x;
    const double energy = result_.energy;
    result_.x = best_x_;
    evaluate();
    if (energy >= result_.energy || at_rounding_floor()) return;
    result_.x = x;
    evaluate();
  }

  /// Whether nothing helps: no step with a projected Hessian of this very state, or none of the
  /// last refreshes has lowered energy or residual.
  bool stalled() {
    if (use_ == 0 && blend_ >= 1) return true;
    const bool better =
        result_.residual < 0.5 * residual_at_stall_ ||
        result_.energy < energy_at_stall_ - kLeastProgress * std::abs(result_.energy);
    stalls_ = better ? 0 : stalls_ + 1;
    residual_at_stall_ = result_.residual;
    energy_at_stall_ = result_.energy;
    return stalls_ > kMaxStalls;
  }

  /// Where the energy jumps up (the literal law) a step over the wall, beyond which the way down
  /// may go on; false, and back before the lowest wall, after several of them.
  bool pass_wall() {
    if (result_.energy < wall_energy_) {
      wall_energy_ = result_.energy;
      wall_x_ = result_.x;
    }
    if (walls_++ < kMostWalls) {
      result_.x += kOverWall * discretization_.to_full(direction());
      evaluate();
      stalls_ = 0;
      if (std::isfinite(result_.energy) && std::isfinite(result_.residual)) return true;
    }
    result_.x = wall_x_;
    evaluate();
    return false;
  }

  /// Whether the residual is as small as rounding allows.
  bool at_rounding_floor() {
    result_.rounding_floor = potential_.rounding_floor(result_.x);
    return result_.residual <= result_.rounding_floor;
  }

  /// Direction v that minimises v^T H v / v^T P v, P = H(1): iterate v <- v - P^-1 H v, whose
  /// eigenvalues 1 - mu are largest for negative mu because H <= P.
  std::optional<VecX> negative_curvature_direction() {
    const SparseMatrix H = hessian_;
    if (!factor(1)) return std::nullopt;
    VecX v(H.rows());
    for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = std::sin(1.0 + static_cast<double>(i));
    for (int i = 0; i < kCurvatureIterations; ++i) {
      VecX w = H.selfadjointView<Eigen::Lower>() * v;
      preconditioner_->solve_in_place(w);
      v -= w;
      v.normalize();
    }
    if (v.dot(H.selfadjointView<Eigen::Lower>() * v) >= 0) return std::nullopt;
    return v;
  }

  bool leave_saddle() {
    const std::optional<VecX> v = negative_curvature_direction();
    if (!v) return false;
    const VecX direction = discretization_.to_full(*v) * (kSaddleStep / largest_move(*v));
    for (double step = 1; step > 1e-4; step *= 0.5)
      for (double sign : {1.0, -1.0}) {
        const VecX trial = result_.x + sign * step * direction;
        if (!(potential_.energy(trial) < result_.energy)) continue;
        result_.x = trial;
        evaluate();
        result_.negative_eigenvalues = -1;
        factor_is_old_ = true;
        return true;
      }
    return false;
  }

  const Potential& potential_;
  const Discretization& discretization_;
  EquilibriumOptions options_;
  Equilibrium result_;
  SparseMatrix hessian_;
  std::shared_ptr<SparseFactor> own_factor_;
  std::shared_ptr<const SparseFactor> preconditioner_;  // own_factor_ or one of a near-by solve
  bool started_near_;
  LimitedMemory memory_;
  VecX gradient_, free_gradient_, trial_, trial_gradient_, best_x_;
  double energy_scale_;         // [J]
  double blend_ = 0;            // of the preconditioner
  double near_blend_ = 0;       // to be tried next near equilibrium
  bool factor_is_old_ = false;  // it is to be refreshed before the next step
  int use_ = 0;                 // iterations with this preconditioner
  int hard_searches_ = 0;       // of these, those that needed several backtracks
  double residual_at_refresh_ = std::numeric_limits<double>::infinity();
  double residual_at_stall_ = std::numeric_limits<double>::infinity();
  double energy_at_stall_ = std::numeric_limits<double>::infinity();  // [J]
  int stalls_ = 0;
  int walls_ = 0;                                                 // passed so far
  VecX wall_x_;                                                   // the lowest of them
  double wall_energy_ = std::numeric_limits<double>::infinity();  // [J]
  double best_residual_ = std::numeric_limits<double>::infinity();
  int noisy_steps_ = 0;  // since the residual last fell, while the energy says nothing
};

}  // namespace

std::string_view name(EquilibriumStatus status) {
  switch (status) {
    case EquilibriumStatus::converged:
      return "converged";
    case EquilibriumStatus::saddle:
      return "saddle";
    case EquilibriumStatus::stagnated:
      return "stagnated";
    case EquilibriumStatus::iteration_limit:
      return "iteration_limit";
    case EquilibriumStatus::non_finite:
      return "non_finite";
  }
  return "unknown";
}

Equilibrium solve_equilibrium(const Potential& potential, const VecX& x,
                              const EquilibriumOptions& options,
                              std::shared_ptr<const SparseFactor> nearby) {
  return Minimisation(potential, x, options, std::move(nearby)).run();
}

double smallest_eigenvalue(const Equilibrium& equilibrium) {
  if (!equilibrium.factor) throw std::invalid_argument("smallest_eigenvalue: not converged");
  return smallest_eigenvalue(*equilibrium.factor);
}

}  // namespace drape
