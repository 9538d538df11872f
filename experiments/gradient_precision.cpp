#include "experiments/gradient_precision.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "adjoint/adjoint.h"
#include "adjoint/branch.h"
#include "adjoint/loss.h"
#include "adjoint/sensitivity.h"
#include "benchmarks/baselines/unrolled_dynamics.h"
#include "core/cpu_clock.h"
#include "core/outline.h"
#include "core/profile.h"
#include "experiments/extrapolation.h"
#include "experiments/interrupt.h"
#include "experiments/model.h"
#include "experiments/peak_memory.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kStiffer = 0.1;         // logarithm: bending of the start over the fabric's
constexpr double kPolished = 1e-11;      // residual, or the rounding floor
constexpr double kReferenceStep = 1e-3;  // of the differences that check the reference
constexpr int kRepeats = 3;              // of a measurement; the cheapest counts
constexpr double kLongEnough = 1;        // measured once from here on [s]

Equilibrium solved(const Potential& potential, const VecX& x, double tolerance,
                   std::shared_ptr<const SparseFactor> nearby = nullptr) {
  Equilibrium equilibrium =
      solve_equilibrium(potential, x, {.tolerance = tolerance}, std::move(nearby));
  if (!equilibrium.converged()) throw std::runtime_error(std::string(name(equilibrium.status)));
  return equilibrium;
}

struct SeenLoss {
  double value;
  VecX dL_dx;
};

SeenLoss loss_of(const GradientProblem& problem, const VecX& x) {
  const Outline outline = trace_outline(problem.potential.mesh(), problem.settings.scene, x);
  const Loss loss = profile_loss(outline, problem.observed);
  return {loss.value, pull_back(outline, x, loss.dL_dpoints)};
}

/// The parameters asked for, of a gradient in natural units, by their logarithms.
VecX by_log(const GradientProblem& problem, const ParameterVector& natural) {
  const auto& parameters = problem.settings.gradient_precision.parameters;
  VecX gradient(static_cast<Eigen::Index>(parameters.size()));
  for (size_t i = 0; i < parameters.size(); ++i)
    gradient[static_cast<Eigen::Index>(i)] =
        problem.potential.fabric()[parameters[i]] * natural[static_cast<int>(parameters[i])];
  return gradient;
}

VecX by_adjoint(const GradientProblem& problem, double tolerance) {
  const Equilibrium drape = solved(problem.potential, problem.start, tolerance);
  return by_log(problem,
                adjoint_gradient(problem.potential, drape, loss_of(problem, drape.x).dL_dx));
}

VecX by_sensitivities(const GradientProblem& problem, double tolerance) {
  const auto& parameters = problem.settings.gradient_precision.parameters;
  const Equilibrium drape = solved(problem.potential, problem.start, tolerance);
  const Outline outline = trace_outline(problem.potential.mesh(), problem.settings.scene, drape.x);
  const Profile profile = radial_profile(outline.points);
  const MatX drho_dp = profile_sensitivities(outline, profile, Vec2::Zero(), drape.x,
                                             sensitivities(problem.potential, drape, parameters));
  VecX gradient = drho_dp.transpose() * (profile.radius - problem.observed) / kProfileSize;
  for (size_t i = 0; i < parameters.size(); ++i)
    gradient[static_cast<Eigen::Index>(i)] *= problem.potential.fabric()[parameters[i]];
  return gradient;
}

VecX by_differences(const GradientProblem& problem, double step, double tolerance) {
  const auto& parameters = problem.settings.gradient_precision.parameters;
  const Equilibrium drape = solved(problem.potential, problem.start, tolerance);
  VecX gradient(static_cast<Eigen::Index>(parameters.size()));
  Potential other = problem.potential;
  for (size_t i = 0; i < parameters.size(); ++i) {
    const FabricPath path = scaled_path(problem.potential.fabric(), {parameters[i]});
    const auto loss_at = [&](double s) {
      other.set_fabric(path.fabric(s));
      return loss_of(problem, solved(other, drape.x, tolerance, drape.factor).x).value;
    };
    gradient[static_cast<Eigen::Index>(i)] = (loss_at(step) - loss_at(-step)) / (2 * step);
  }
  return gradient;
}

VecX by_unrolling(const GradientProblem& problem, double time_step, int steps) {
  baselines::UnrolledDynamics motion(problem.potential, problem.start, time_step);
  while (motion.steps() < steps)
    if (!motion.advance()) throw std::runtime_error("a time step was not solved");
  return by_log(problem, motion.gradient(loss_of(problem, motion.state()).dL_dx));
}

double error_of(const VecX& gradient, const VecX& reference) {
  return (gradient - reference).cwiseAbs().maxCoeff() / reference.cwiseAbs().maxCoeff();
}

std::string text(const char* format, double a, double b = 0) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

Json measured(const GradientProblem& problem, const char* method, const std::string& setting,
              double series, const std::function<VecX()>& gradient) {
  Json item = {{"method", method}, {"setting", setting}, {"series", series}};
  try {
    VecX found;
    double least = std::numeric_limits<double>::infinity(), memory = 0;
    for (int i = 0; i < kRepeats; ++i) {
      const double begin = thread_cpu_seconds();
      double spent = 0;
      memory = std::max(memory, peak_memory_growth([&] {
                          found = gradient();
                          spent = thread_cpu_seconds() - begin;
                        }));
      least = std::min(least, spent);
      if (spent > kLongEnough) break;
    }
    item["error"] = error_of(found, problem.reference);
    item["cpu_seconds"] = least;
    item["memory_bytes"] = memory;
    item["status"] = "converged";
  } catch (const std::exception& error) {
    item["status"] = error.what();
  }
  return item;
}

}  // namespace

GradientProblem::GradientProblem(const Settings& settings_,
                                 std::shared_ptr<const Discretization> discretization)
    : settings(settings_),
      potential(make_potential(std::move(discretization), settings_.fabric, settings_)) {
  const FabricPath path =
      scaled_path(settings.fabric, {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh});
  Potential stiffer = potential;
  stiffer.set_fabric(path.fabric(kStiffer));
  const ContactDrape first = drape(settings, stiffer);
  if (!first.equilibrium.converged())
    throw std::runtime_error("no drape to start from: " +
                             std::string(name(first.equilibrium.status)));
  potential.set_support(stiffer.support());
  start = first.equilibrium.x;
  observed = radial_profile(trace_outline(potential.mesh(), settings.scene, start).points).radius;
  reference = by_adjoint(*this, kPolished);
  const VecX coarse = by_differences(*this, kReferenceStep, kPolished),
             fine = by_differences(*this, kReferenceStep / 2, kPolished);
  reference_disagreement = error_of(extrapolated(coarse, fine, 2, 2), reference);
}

int gradient_measurements(const GradientPrecisionSettings& study) {
  return static_cast<int>(2 * study.tolerances.size() +
                          study.steps.size() * study.difference_tolerances.size() +
                          study.time_steps.size() * study.unrolled_steps.size());
}

Json measure_gradients(const GradientProblem& problem, Progress& progress) {
  const GradientPrecisionSettings& study = problem.settings.gradient_precision;
  Json rows = Json::array();
  const auto add = [&](const char* method, const std::string& setting, double series,
                       const std::function<VecX()>& gradient) {
    if (interrupted()) return;
    rows.push_back(measured(problem, method, setting, series, gradient));
    progress.advance();
  };
  for (const double tolerance : study.tolerances)
    add("adjoint", text("%.0e", tolerance), 0, [&] { return by_adjoint(problem, tolerance); });
  for (const double tolerance : study.tolerances)
    add("sensitivities", text("%.0e", tolerance), 0,
        [&] { return by_sensitivities(problem, tolerance); });
  for (const double tolerance : study.difference_tolerances)
    for (const double step : study.steps)
      add("differences", text("%.0e", step), tolerance,
          [&] { return by_differences(problem, step, tolerance); });
  for (const double time_step : study.time_steps)
    for (const int steps : study.unrolled_steps)
      add("unrolled", text("%.0f", steps), time_step,
          [&] { return by_unrolling(problem, time_step, steps); });
  return rows;
}

}  // namespace drape
