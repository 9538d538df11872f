#include "benchmarks/baselines/course.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/cpu_clock.h"
#include "core/sparse_factor.h"

namespace drape::baselines {
namespace {

constexpr double kFirstRecord = 5e-4;   // [s]
constexpr double kSpacing = 1.15;       // of the times of recorded states
constexpr double kLargest = 10;         // of a state, over the start
constexpr double kLargestFloor = 1e-3;  // of rounding; above it a triangle or wing has collapsed
constexpr double kProgress = 0.5;       // residual that counts as progress, over that of half time

}  // namespace

std::string_view name(Outcome outcome) {
  switch (outcome) {
    case Outcome::converged:
      return "converged";
    case Outcome::saddle:
      return "saddle";
    case Outcome::stalled:
      return "stalled";
    case Outcome::diverged:
      return "diverged";
    case Outcome::out_of_budget:
      return "out_of_budget";
  }
  return "unknown";
}

Course::Course(const Potential& potential, const Budget& budget, const VecX& x)
    : potential_(potential),
      budget_(budget),
      size_(x.cwiseAbs().maxCoeff()),
      start_(thread_cpu_seconds()),
      next_record_(kFirstRecord) {
  run_.smallest_residual = std::numeric_limits<double>::infinity();
  record(x);
}

double Course::spent() const { return thread_cpu_seconds() - start_ - paused_; }

void Course::record(const VecX& x) {
  const double now = spent();
  VecX gradient;
  const double energy = potential_.energy_and_gradient(x, gradient);
  residual_ = potential_.residual(gradient);
  diverged_ = !x.allFinite() || !std::isfinite(energy) || !std::isfinite(residual_) ||
              x.cwiseAbs().maxCoeff() > kLargest * size_;
  if (!diverged_) {
    run_.smallest_residual = std::min(run_.smallest_residual, residual_);
    run_.trace.push_back({iterations_ == 0 ? 0 : now, residual_, energy, iterations_, x});
  }
  paused_ += spent() - now;
}

bool Course::go_on(const VecX& x, const VecX* gradient) {
  ++iterations_;
  if (gradient != nullptr) {
    residual_ = potential_.residual(*gradient);
    run_.smallest_residual = std::min(run_.smallest_residual, residual_);
  }
  const double now = spent();
  if (now >= next_record_ || !std::isfinite(residual_)) {
    record(x);
    while (next_record_ <= now) next_record_ *= kSpacing;
  }
  exhausted_ = now >= budget_.cpu_seconds || iterations_ >= budget_.max_iterations;
  return !exhausted_ && !diverged_ && !within_tolerance();
}

MethodRun Course::finish(const VecX& x) {
  if (!diverged_) record(x);
  if (run_.trace.empty()) run_.trace.push_back({0, residual_, 0, 0, x});  // a start that is bad
  run_.outcome = judge(x);
  return std::move(run_);
}

Outcome Course::judge(const VecX& x) const {
  if (diverged_) return Outcome::diverged;
  if (within_tolerance() || residual_ <= std::min(potential_.rounding_floor(x), kLargestFloor)) {
    SparseMatrix H;
    potential_.hessian(x, 0, H);
    SparseFactor factor(potential_.discretization().symbolic_factor());
    return factor.factorize(H) ? Outcome::converged : Outcome::saddle;
  }
  if (!exhausted_) return Outcome::stalled;
  double first = std::numeric_limits<double>::infinity(), second = first;
  for (const Snapshot& state : run_.trace) {
    double& smallest = state.cpu_seconds < run_.end().cpu_seconds / 2 ? first : second;
    smallest = std::min(smallest, state.residual);
  }
  return second < kProgress * first ? Outcome::out_of_budget : Outcome::stalled;
}

}  // namespace drape::baselines
