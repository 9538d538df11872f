// The part of gradient_precision.h about the limit point.
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "adjoint/adjoint.h"
#include "adjoint/fold.h"
#include "adjoint/loss.h"
#include "core/outline.h"
#include "experiments/gradient_precision.h"
#include "experiments/interrupt.h"
#include "experiments/extrapolation.h"
#include "experiments/model.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLargestStep = 0.05, kSmallestStep = 1.5e-3;  // of the search for a snap
constexpr double kCloseStep = 1e-9;    // smallest step on the way to the limit point
constexpr double kSnap = 1e-3;         // of a vertex [m]
constexpr double kTolerance = 1e-11;   // residual, or the rounding floor
constexpr double kOverDistance = 0.1;  // first step of the reference over the distance
constexpr double kLargestReferenceStep = 1e-3;
constexpr double kSteps[] = {1e-2, 1e-3, 1e-4, 1e-5};  // of the differences tried

class SnapStudy {
 public:
  SnapStudy(const Settings& settings, std::shared_ptr<const Discretization> discretization)
      : settings_(settings),
        path_(scaled_path(settings.fabric, {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh})),
        potential_(make_potential(std::move(discretization), settings.fabric, settings)) {
    options_.equilibrium.tolerance = kTolerance;
    options_.largest_step = kLargestStep;
    options_.smallest_step = kSmallestStep;
  }

  Json run(Progress& progress) {
    const ContactDrape first = drape(settings_, potential_);
    if (!first.equilibrium.converged()) return {{"status", name(first.equilibrium.status)}};
    BranchState state = make_branch_state(potential_, path_, 0, first.equilibrium);
    std::optional<BranchState> before = state, after;
    std::optional<Snap> snap;
    const SweepVisitor visitor{
        [&](const BranchState& at) {
          (snap ? after : before) = at;
          return !snap && !interrupted();
        },
        [&](const Snap& found) {
          if (found.fold.end == BranchEnd::limit_point && found.vertex_jump > kSnap) snap = found;
        }};
    sweep(potential_, path_, std::log(settings_.gradient_precision.snap_to), options_, state, cost_,
          visitor);
    if (!snap || !after) return {{"status", "no such snap was found"}};
    progress.advance();
    const double fold = snap->fold.s;
    Json result = {{"status", "found"},
                   {"factor", std::exp(fold)},
                   {"end", name(snap->fold.end)},
                   {"negative_eigenvalues_beyond", snap->fold.negative_eigenvalues},
                   {"vertex_jump", snap->vertex_jump},
                   {"energy_drop", snap->energy_drop},
                   {"last_natural_step_distance", fold - before->s}};
    options_.smallest_step = kCloseStep;
    std::vector<double> distances = settings_.gradient_precision.distances;
    std::sort(distances.begin(), distances.end());
    result["rows"] = Json::array();
    for (const double distance : distances)
      add(result["rows"], "after", *after, fold, distance, progress);
    std::reverse(distances.begin(), distances.end());
    for (const double distance : distances)
      add(result["rows"], "before", *before, fold, -distance, progress);
    try {
      Equilibrium at_fold;
      at_fold.x = snap->fold.x;
      at_fold.status = EquilibriumStatus::saddle;
      adjoint_gradient(potential_, at_fold, VecX::Zero(at_fold.x.size()));
    } catch (const std::exception& refusal) {
      result["adjoint_at_a_saddle"] = refusal.what();
    }
    return result;
  }

 private:
  void add(Json& rows, const char* side, BranchState& from, double fold, double offset,
           Progress& progress) {
    if (interrupted()) return;
    Json row = {{"side", side}, {"distance", std::abs(offset)}};
    try {
      if (follow_minima(potential_, path_, fold + offset, options_, from, cost_))
        measure(row, from, std::abs(offset));
      else
        row["status"] = "the branch was lost at a distance of " + std::to_string(from.s - fold);
    } catch (const std::exception& error) {
      row["status"] = error.what();
    }
    rows.push_back(row);
    progress.advance();
  }

  void measure(Json& row, const BranchState& at, double distance) {
    const Mesh& mesh = potential_.mesh();
    potential_.set_fabric(path_.fabric(at.s));
    const Outline outline = trace_outline(mesh, settings_.scene, at.equilibrium.x);
    const Loss loss = drape_coefficient_loss(outline, settings_.scene);
    const double adjoint = adjoint_gradient(potential_, at.equilibrium,
                                            pull_back(outline, at.equilibrium.x, loss.dL_dpoints))
                               .dot(path_.dp_ds(at.s));
    row["status"] = "converged";
    row["drape_coefficient_percent"] = 100 * loss.value;
    row["gradient"] = 100 * adjoint;
    row["largest_velocity"] = largest_distance(at.dx_ds, VecX::Zero(at.dx_ds.size()));
    row["smallest_eigenvalue"] = smallest_eigenvalue(at.equilibrium);
    row["residual"] = at.equilibrium.residual;
    // Romberg's extrapolation of central differences with three steps, the last of two orders
    const double h = std::min(kLargestReferenceStep, kOverDistance * distance);
    std::array<double, 3> d{};
    for (size_t i = 0; i < d.size(); ++i) d[i] = difference(at, h / static_cast<double>(1 << i));
    const double first = extrapolated(d[0], d[1], 2, 2), second = extrapolated(d[1], d[2], 2, 2),
                 reference = extrapolated(first, second, 2, 4);
    row["reference_uncertainty"] = std::abs(reference - second) / std::abs(reference);
    row["adjoint_error"] = std::abs(adjoint - reference) / std::abs(reference);
    row["differences"] = Json::array();
    for (const double step : kSteps)
      row["differences"].push_back(
          {{"step", step},
           {"error", std::abs(difference(at, step) - reference) / std::abs(reference)}});
  }

  /// Of the drape coefficient, re-solved from the prediction; NaN where there is no equilibrium.
  double difference(const BranchState& at, double step) {
    double value[2];
    for (int side : {0, 1}) {
      const double ds = side == 0 ? -step : step;
      potential_.set_fabric(path_.fabric(at.s + ds));
      const Equilibrium drape = solve_equilibrium(potential_, at.equilibrium.x + ds * at.dx_ds,
                                                  options_.equilibrium, at.equilibrium.factor);
      if (!drape.converged()) return std::numeric_limits<double>::quiet_NaN();
      value[side] = drape_coefficient(
          settings_.scene, area(trace_outline(potential_.mesh(), settings_.scene, drape.x).points));
    }
    return (value[1] - value[0]) / (2 * step);
  }

  const Settings& settings_;
  FabricPath path_;
  Potential potential_;
  BranchOptions options_;
  ContinuationCost cost_;
};

}  // namespace

Json gradient_at_snap(const Settings& settings,
                      std::shared_ptr<const Discretization> discretization, Progress& progress) {
  return SnapStudy(settings, std::move(discretization)).run(progress);
}

}  // namespace drape
