// kind = "work_precision": error against CPU time of core's solver and of the methods of
// benchmarks/baselines, all on the same energies, from the same start and within the same budget.
//
// From the folded start every method falls into a basin of its own; its error is the distance to
// the minimum that core polishes its last state to. From the near start, the equilibrium of a
// fabric whose bending is ten percent stiffer, there is usually one basin for all. The error of a
// state is the root mean square distance of its free vertices; a drape coefficient's is in points.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/drape_protocol.h"
#include "core/durable_file.h"
#include "core/outline.h"
#include "experiments/compared_methods.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/study_fabrics.h"
#include "experiments/summary.h"
#include "experiments/work_precision_report.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kStarts[] = {"folded", "near"};
constexpr const char* kCharts[] = {"residual", "rms_mm", "drape_coefficient_error"};
constexpr double kStiffer = 1.1;       // bending whose equilibrium is the near start
constexpr double kPolished = 1e-10;    // residual, or the rounding floor
constexpr double kSameMinimum = 1e-5;  // vertices of one minimum are closer [m]

/// What all methods begin with: which start, on which fabric and mesh.
struct Case {
  int vertices, seed, fabric;
  const char* start;

  std::string item(const baselines::Method& method) const {
    return std::to_string(vertices) + "_" + std::to_string(seed) + "_" + std::to_string(fabric) +
           "_" + start + "_" + std::string(method.name);
  }
};

/// The start and the minimum that core finds from there.
struct Start {
  VecX x;
  Equilibrium minimum;
};

Start make_start(const Settings& settings, const Potential& potential, const std::string& name) {
  Start start;
  if (name == "near") {
    Fabric stiffer = potential.fabric();
    for (Parameter k : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh}) stiffer[k] *= kStiffer;
    Potential other = potential;
    other.set_fabric(stiffer);
    start.x = drape_by_lobes(other, settings.scene, settings.start.lobes, settings.start.phase).x;
  } else {
    start.x =
        folded_state(potential.mesh(), settings.scene, settings.start.lobes, settings.start.phase);
  }
  start.minimum = solve_equilibrium(potential, start.x, {.tolerance = kPolished});
  return start;
}

double rms_distance(const Discretization& discretization, const VecX& a, const VecX& b) {
  return std::sqrt(discretization.to_free(a - b).squaredNorm() /
                   discretization.free_vertex_count());
}

/// In points; NaN where the outline cannot be traced.
double coefficient(const Scene& scene, const Mesh& mesh, const VecX& x) {
  try {
    return 100 * drape_coefficient(scene, area(trace_outline(mesh, scene, x).points));
  } catch (const std::exception&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

Json run_method(const Settings& settings, const Potential& potential, const Start& start,
                double cpu_seconds, const baselines::Method& method) {
  const baselines::MethodRun run =
      baselines::run(method, potential, start.x,
                     {.cpu_seconds = cpu_seconds, .tolerance = settings.solver.tolerance});
  const Equilibrium minimum = solve_equilibrium(potential, run.end().x, {.tolerance = kPolished});
  const bool polished = minimum.converged();
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const double aim = polished ? coefficient(settings.scene, potential.mesh(), minimum.x) : unknown;
  Json trace = {{"cpu_seconds", Json::array()},
                {"residual", Json::array()},
                {"energy", Json::array()},
                {"rms_mm", Json::array()},
                {"drape_coefficient_error", Json::array()}};
  for (const baselines::Snapshot& state : run.trace) {
    trace["cpu_seconds"].push_back(state.cpu_seconds);
    trace["residual"].push_back(state.residual);
    trace["energy"].push_back(state.energy);
    trace["rms_mm"].push_back(
        polished ? 1e3 * rms_distance(potential.discretization(), state.x, minimum.x) : unknown);
    trace["drape_coefficient_error"].push_back(
        std::abs(coefficient(settings.scene, potential.mesh(), state.x) - aim));
  }
  return {{"outcome", name(run.outcome)},
          {"iterations", run.end().iterations},
          {"smallest_residual", run.smallest_residual},
          {"polished", name(minimum.status)},
          {"polished_energy", minimum.energy},
          {"polished_drape_coefficient_percent", aim},
          {"same_minimum_as_core", polished && start.minimum.converged() &&
                                       largest_distance(minimum.x, start.minimum.x) < kSameMinimum},
          {"trace", trace}};
}

/// All runs on one mesh that are not in the store yet.
void run_mesh(const Settings& settings, const JsonStore& store, const std::vector<Case>& cases,
              Progress& progress) {
  const WorkPrecisionSettings& study = settings.work_precision;
  const auto methods = compared_methods(study.methods);
  std::vector<Case> missing;
  for (const Case& c : cases)
    if (!std::ranges::all_of(methods, [&](const auto* m) { return store.has(c.item(*m)); }))
      missing.push_back(c);
  if (missing.empty()) return;
  Settings other = settings;
  other.mesh.seed = settings.mesh.seed + static_cast<std::uint64_t>(missing.front().seed - 1);
  const auto mesh = make_discretization(other, missing.front().vertices);
  for_each_item(static_cast<int>(missing.size()), settings.experiment.thread_count(), [&](int i) {
    const Case& c = missing[static_cast<size_t>(i)];
    const Potential potential = make_potential(mesh, study_fabric(c.fabric).fabric, settings);
    const Start start = make_start(settings, potential, c.start);
    for (const baselines::Method* method : methods) {
      if (interrupted()) return;
      if (store.has(c.item(*method))) continue;
      store.save(c.item(*method),
                 run_method(settings, potential, start,
                            budget_of_size(study.cpu_seconds, c.vertices), *method));
      progress.advance();
    }
  });
}

void print_panel(const Json& panel) {
  std::printf("\n%s start, %d vertices, %s fabric %d: CPU seconds to a residual of\n",
              panel["start"].get<std::string>().c_str(), panel["vertices"].get<int>(),
              panel["softness"].get<std::string>().c_str(), panel["fabric"].get<int>());
  std::printf("%-20s", "");
  for (const double tolerance : tolerances("residual")) std::printf(" %8.0e", tolerance);
  std::printf("   to mm:");
  for (const double tolerance : tolerances("rms_mm")) std::printf(" %8g", tolerance);
  std::printf("   smallest residual, outcomes\n");
  for (const auto& [method, row] : panel["methods"].items()) {
    std::printf("%-20s", method.c_str());
    for (const Json& at : row["time_to_residual"]) std::printf(" %8.3g", number(at["cpu_seconds"]));
    std::printf("         ");
    for (const Json& at : row["time_to_rms_mm"]) std::printf(" %8.3g", number(at["cpu_seconds"]));
    std::printf("   %8.1e, %s\n", number(row["smallest_residual_median"]),
                row["outcomes"].dump().c_str());
  }
}

}  // namespace

RunOutcome run_work_precision(const Settings& settings, OutputFolder& folder) {
  const WorkPrecisionSettings& study = settings.work_precision;
  const JsonStore store(folder, "runs");
  std::vector<std::vector<Case>> meshes;
  int total = 0, resumed = 0;
  for (const int vertices : study.vertices)
    for (int seed = 1; seed <= study.seeds; ++seed) {
      std::vector<Case>& cases = meshes.emplace_back();
      for (const char* start : kStarts)
        for (int fabric = 0; fabric < study.fabrics; ++fabric) {
          cases.push_back({vertices, seed, fabric, start});
          for (const baselines::Method* method : compared_methods(study.methods)) {
            ++total;
            resumed += store.has(cases.back().item(*method));
          }
        }
    }
  {
    Progress progress("work-precision", total, resumed);
    for (const std::vector<Case>& cases : meshes) {
      run_mesh(settings, store, cases, progress);
      if (interrupted()) return {"partial", {}};
    }
  }

  RunOutcome outcome;
  Json panels = Json::array(), not_cheapest = Json::array(), charts = Json::object();
  int core_runs = 0, core_converged = 0;
  for (const char* start : kStarts)
    for (const int vertices : study.vertices)
      for (int fabric = 0; fabric < study.fabrics; ++fabric) {
        const Json panel_name = {{"start", start},
                                 {"vertices", vertices},
                                 {"fabric", fabric},
                                 {"softness", study_fabric(fabric).softness}};
        Json panel = panel_name;
        panel["budget_cpu_seconds"] = budget_of_size(study.cpu_seconds, vertices);
        panel["seeds"] = study.seeds;
        Json curves = Json::object(), accounts = Json::object();
        for (const baselines::Method* method : compared_methods(study.methods)) {
          ComparedRuns compared{std::string(method->name), std::string(method->label), {}};
          for (int seed = 1; seed <= study.seeds; ++seed)
            compared.runs.push_back(store.load(Case{vertices, seed, fabric, start}.item(*method)));
          for (const char* chart : kCharts)
            curves[chart].push_back(
                error_curve(compared, chart, panel["budget_cpu_seconds"].get<double>()));
          accounts[compared.method] = account(compared);
          if (compared.method != "core") continue;
          for (const Json& run : compared.runs) core_converged += run["outcome"] == "converged";
          core_runs += study.seeds;
        }
        for (const char* chart : kCharts) {
          Json drawn = panel;
          drawn["curves"] = curves[chart];
          charts[chart].push_back(drawn);
        }
        panel["methods"] = accounts;
        panel["cheapest"] = cheapest(accounts);
        for (Json best : panel["cheapest"])
          if (best["core_over_cheapest"].get<double>() > 1) {
            best.update(panel_name);
            not_cheapest.push_back(best);
          }
        print_panel(panel);
        panels.push_back(panel);
      }
  outcome.summary = {{"runs", total}, {"core_not_cheapest", not_cheapest}, {"panels", panels}};
  outcome.status = core_converged == core_runs ? "ok" : "partial";
  std::fflush(stdout);  // the script prints as well
  for (const char* chart : kCharts) {
    const std::string file = std::string(chart) + ".json";
    write_text_durably(folder / file, summary_text({{"error", chart}, {"panels", charts[chart]}}));
    draw_figure("work_precision.py", folder / file, folder / chart);
  }
  return outcome;
}

}  // namespace drape
