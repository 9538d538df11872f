#include "core/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "core/cpu_clock.h"

namespace drape {
namespace {

constexpr double kArmijo = 1e-4;
constexpr double kFirstBlend = 0.1;       // the smallest blend above zero
constexpr double kRoundingSlack = 1e-13;  // energy differences below this share of |E| are noise
constexpr int kMaxBacktracks = 30;
constexpr int kStagnationLimit = 4;  // steps at the noise level without a smaller residual
constexpr int kMaxSaddles = 8;
constexpr int kCurvatureIterations = 40;
constexpr double kSaddleStep = 1e-3;  // first step off a saddle [m]

/// The state of one minimisation; each method is one part of an iteration.
class BlendedNewton {
 public:
  BlendedNewton(const Potential& potential, const VecX& x, const EquilibriumOptions& options)
      : potential_(potential),
        options_(options),
        factor_(std::make_shared<SparseFactor>(potential.discretization().symbolic_factor())),
        energy_scale_(potential.free_weight() * x.cwiseAbs().maxCoeff()) {
    result_.x = x;
  }

  Equilibrium run() {
    const double start = thread_cpu_seconds();
    minimise();
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
    for (int saddles = 0;;) {
      if (!descend()) return;
      if (!options_.certify) {
        result_.status = EquilibriumStatus::converged;
        return;
      }
      potential_.hessian(result_.x, 0, hessian_);
      ++result_.factorizations;
      if (factor_->factorize(hessian_)) {
        result_.status = EquilibriumStatus::converged;
        result_.negative_eigenvalues = 0;
        result_.factor = factor_;
        return;
      }
      result_.negative_eigenvalues = negative_eigenvalues(hessian_);
      if (++saddles > kMaxSaddles || !leave_saddle()) {
        result_.status = EquilibriumStatus::saddle;
        return;
      }
    }
  }

  /// Newton iterations until the residual is within tolerance; false sets the status of a failure.
  bool descend() {
    int stagnant = 0;
    while (result_.residual > options_.tolerance) {
      if (result_.newton_iterations >= options_.max_iterations) {
        result_.status = EquilibriumStatus::iteration_limit;
        return at_rounding_floor();
      }
      ++result_.newton_iterations;
      factor_blended_hessian();
      const double before = result_.residual;
      const bool moved = line_search(newton_direction());
      stagnant = moved && result_.residual < 0.5 * before ? 0 : stagnant + !decreased_;
      if (!moved || stagnant >= kStagnationLimit) {
        result_.status = EquilibriumStatus::stagnated;
        return at_rounding_floor();
      }
    }
    return true;
  }

  void evaluate() {
    result_.energy = potential_.energy(result_.x);
    gradient_ = potential_.gradient(result_.x);
    result_.residual = potential_.residual(gradient_);
  }

  void factor_blended_hessian() {
    for (;;) {
      potential_.hessian(result_.x, blend_, hessian_);
      ++result_.factorizations;
      if (factor_->factorize(hessian_)) break;
      if (blend_ >= 1) {
        // only a membrane without any tension and bending gets here: lift the diagonal by rounding
        hessian_.diagonal() += VecX::Constant(hessian_.rows(), 1e-8 * hessian_.diagonal().mean());
        ++result_.factorizations;
        if (factor_->factorize(hessian_)) break;
        throw std::runtime_error("equilibrium: the projected Hessian has no Cholesky factor");
      }
      blend_ = std::min(1.0, std::max(kFirstBlend, 2 * blend_ + kFirstBlend / 2));
    }
  }

  VecX newton_direction() const {
    const Discretization& d = potential_.discretization();
    VecX direction = d.to_full(factor_->solve(-d.to_free(gradient_)));
    const double move = largest_move(direction);
    if (move > options_.largest_move) direction *= options_.largest_move / move;
    return direction;
  }

  double largest_move(const VecX& direction) const {
    double move = 0;
    for (int v : potential_.discretization().free_vertices())
      move = std::max(move, position(direction, v).norm());
    return move;
  }

  /// Armijo backtracking on the energy; where energy differences drown in rounding, a step counts
  /// when it lowers the residual. The next blend is tried smaller.
  bool line_search(const VecX& direction) {
    const double slope = gradient_.dot(direction);
    const double noise = kRoundingSlack * std::max(std::abs(result_.energy), energy_scale_);
    const double before = result_.residual;
    decreased_ = false;
    double step = 1;
    for (int i = 0; i < kMaxBacktracks; ++i, step *= 0.5) {
      const VecX trial = result_.x + step * direction;
      const double energy = potential_.energy(trial);
      if (!std::isfinite(energy)) continue;
      const bool below_noise = std::abs(step * slope) < noise;
      if (!below_noise && energy > result_.energy + kArmijo * step * slope) continue;
      const VecX gradient = potential_.gradient(trial);
      const double residual = potential_.residual(gradient);
      if (below_noise && residual >= before) {
        if (step < 1.0 / 8) return false;
        continue;
      }
      decreased_ = residual < before || !below_noise;
      result_.x = trial;
      result_.energy = energy;
      gradient_ = gradient;
      result_.residual = residual;
      blend_ = blend_ / 2 < kFirstBlend / 2 ? 0 : blend_ / 2;
      return true;
    }
    return false;
  }

  /// Whether a stopped iteration is as good as rounding allows.
  bool at_rounding_floor() {
    result_.rounding_floor = potential_.rounding_floor(result_.x);
    return result_.residual <= result_.rounding_floor;
  }

  /// Direction v that minimises v^T H v / v^T P v, P = H(1): iterate v <- v - P^-1 H v, whose
  /// eigenvalues 1 - mu are largest for negative mu because H <= P.
  std::optional<VecX> negative_curvature_direction() {
    const SparseMatrix H = hessian_;
    potential_.hessian(result_.x, 1, hessian_);
    ++result_.factorizations;
    if (!factor_->factorize(hessian_)) return std::nullopt;
    VecX v(H.rows());
    for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = std::sin(1.0 + static_cast<double>(i));
    for (int i = 0; i < kCurvatureIterations; ++i) {
      v -= factor_->solve(H.selfadjointView<Eigen::Lower>() * v);
      v.normalize();
    }
    if (v.dot(H.selfadjointView<Eigen::Lower>() * v) >= 0) return std::nullopt;
    return v;
  }

  bool leave_saddle() {
    const std::optional<VecX> v = negative_curvature_direction();
    if (!v) return false;
    VecX direction = potential_.discretization().to_full(*v);
    direction *= kSaddleStep / largest_move(direction);
    for (double step = 1; step > 1e-4; step *= 0.5)
      for (double sign : {1.0, -1.0}) {
        const VecX trial = result_.x + sign * step * direction;
        if (!(potential_.energy(trial) < result_.energy)) continue;
        result_.x = trial;
        evaluate();
        blend_ = kFirstBlend;
        return true;
      }
    return false;
  }

  const Potential& potential_;
  EquilibriumOptions options_;
  Equilibrium result_;
  std::shared_ptr<SparseFactor> factor_;
  SparseMatrix hessian_;
  VecX gradient_;
  double blend_ = 0;
  double energy_scale_;     // [J]
  bool decreased_ = false;  // whether the last step lowered energy or residual
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
                              const EquilibriumOptions& options) {
  return BlendedNewton(potential, x, options).run();
}

double smallest_eigenvalue(const Equilibrium& equilibrium) {
  if (!equilibrium.factor) throw std::invalid_argument("smallest_eigenvalue: not converged");
  return smallest_eigenvalue(*equilibrium.factor);
}

}  // namespace drape
