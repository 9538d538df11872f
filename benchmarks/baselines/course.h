// The course of one minimisation: what it has spent, what it has reached, and when it is over.
//
// Every method gets the same budget of CPU time of its thread. The clock stands still while states
// are recorded and judged, so that a method pays for its own evaluations only. Nothing but the
// budget, convergence or a state that is not finite ends a method from outside.
#pragma once

#include <string_view>
#include <vector>

#include "core/potential.h"

namespace drape::baselines {

struct Budget {
  double cpu_seconds = 10;
  int max_iterations = 1'000'000'000;
  double tolerance = 1e-8;  ///< on the relative residual (see Potential::residual)
  double time_step = 0;     ///< of methods that have one [s]; 0: the method's own choice
};

enum class Outcome {
  converged,      ///< residual within tolerance or rounding floor, true Hessian positive definite
  saddle,         ///< such a residual, but a Hessian that is not
  stalled,        ///< no further step, or hardly any progress in the second half of the budget
  diverged,       ///< a state that is not finite or more than ten times as large as the start
  out_of_budget,  ///< still on its way
};
std::string_view name(Outcome outcome);

/// A state on the way.
struct Snapshot {
  double cpu_seconds, residual, energy;  ///< 0 s at the start
  int iterations;
  VecX x;  ///< 3n [m]
};

struct MethodRun {
  Outcome outcome = Outcome::out_of_budget;
  std::vector<Snapshot> trace;  ///< the start, states at geometrically spaced times, the end
  double smallest_residual = 0;

  const Snapshot& end() const { return trace.back(); }
};

class Course {
 public:
  /// x: the start (3n); it is recorded.
  Course(const Potential& potential, const Budget& budget, const VecX& x);

  /// The time step asked for, or else `own` [s].
  double time_step(double own) const { return budget_.time_step > 0 ? budget_.time_step : own; }
  bool own_time_step() const { return budget_.time_step <= 0; }
  double tolerance() const { return budget_.tolerance; }

  /// An iteration ended at x (3n); with the gradient there (3n) convergence is noticed at once,
  /// without it at the next recorded state. False: the method is to stop.
  bool go_on(const VecX& x) { return go_on(x, nullptr); }
  bool go_on(const VecX& x, const VecX& gradient) { return go_on(x, &gradient); }

  /// The residual last seen is within tolerance.
  bool within_tolerance() const { return residual_ <= budget_.tolerance; }

  /// The verdict on the state that the method ended with.
  MethodRun finish(const VecX& x);

 private:
  bool go_on(const VecX& x, const VecX* gradient);
  void record(const VecX& x);
  double spent() const;
  Outcome judge(const VecX& x) const;

  const Potential& potential_;
  Budget budget_;
  double size_;  // of the start [m]
  double paused_ = 0, start_, next_record_;
  double residual_ = 0;
  int iterations_ = 0;
  bool diverged_ = false, exhausted_ = false;
  MethodRun run_;
};

}  // namespace drape::baselines
