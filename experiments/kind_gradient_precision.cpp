// kind = "gradient_precision": what a gradient of an outline costs and how wrong it is, by adjoint,
// forward sensitivities, central differences and differentiation of unrolled dynamics; and the
// gradient near a limit point (gradient_precision.h). One thread: memory is the process's.
#include <cstdio>
#include <string>

#include "core/durable_file.h"
#include "experiments/figure.h"
#include "experiments/gradient_precision.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/summary.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

void print_gradients(const Json& rows) {
  std::printf("%-14s %10s %10s %10s %10s %10s\n", "method", "series", "setting", "error", "CPU s",
              "MB");
  for (const Json& row : rows)
    if (row["status"] == "converged")
      std::printf("%-14s %10g %10s %10.2e %10.3f %10.1f\n",
                  row["method"].get<std::string>().c_str(), number(row["series"]),
                  row["setting"].get<std::string>().c_str(), number(row["error"]),
                  number(row["cpu_seconds"]), 1e-6 * number(row["memory_bytes"]));
    else
      std::printf("%-14s %10g %10s %s\n", row["method"].get<std::string>().c_str(),
                  number(row["series"]), row["setting"].get<std::string>().c_str(),
                  row["status"].get<std::string>().c_str());
}

void print_snap(const Json& snap) {
  std::printf("\nsnap: %s\n", snap["status"].get<std::string>().c_str());
  if (snap["status"] != "found") return;
  std::printf("%s at %.6f times the stiffness, a vertex jumps by %.2f mm\n",
              snap["end"].get<std::string>().c_str(), number(snap["factor"]),
              1e3 * number(snap["vertex_jump"]));
  std::printf("%-7s %9s %12s %12s %12s %12s %12s\n", "side", "distance", "dDC/ds", "dx/ds mm",
              "eigenvalue", "adjoint err", "uncertainty");
  for (const Json& row : snap["rows"])
    if (row["status"] == "converged")
      std::printf("%-7s %9.0e %12.5g %12.5g %12.3e %12.2e %12.2e\n",
                  row["side"].get<std::string>().c_str(), number(row["distance"]),
                  number(row["gradient"]), 1e3 * number(row["largest_velocity"]),
                  number(row["smallest_eigenvalue"]), number(row["adjoint_error"]),
                  number(row["reference_uncertainty"]));
    else
      std::printf("%-7s %9.0e %s\n", row["side"].get<std::string>().c_str(),
                  number(row["distance"]), row["status"].get<std::string>().c_str());
}

}  // namespace

RunOutcome run_gradient_precision(const Settings& settings, OutputFolder& folder) {
  const GradientPrecisionSettings& study = settings.gradient_precision;
  const JsonStore store(folder, "parts");
  const auto discretization = make_discretization(settings);
  if (!store.has("gradients")) {
    Progress progress("gradients", gradient_measurements(study));
    const GradientProblem problem(settings, discretization);
    const Json rows = measure_gradients(problem, progress);
    if (interrupted()) return {"partial", {}};
    store.save("gradients", {{"reference_disagreement", problem.reference_disagreement},
                             {"vertices", discretization->mesh().vertex_count()},
                             {"parameters", study.parameters.size()},
                             {"rows", rows}});
  }
  if (!store.has("snap")) {
    Progress progress("snap", 1 + 2 * static_cast<int>(study.distances.size()));
    const Json snap = gradient_at_snap(settings, discretization, progress);
    if (interrupted()) return {"partial", {}};
    store.save("snap", snap);
  }
  RunOutcome outcome;
  Json& summary = outcome.summary;
  summary["gradients"] = store.load("gradients");
  summary["snap"] = store.load("snap");
  print_gradients(summary["gradients"]["rows"]);
  print_snap(summary["snap"]);
  std::fflush(stdout);  // the scripts print as well
  const bool found = summary["snap"]["status"] == "found";
  outcome.status = found ? "ok" : "partial";
  const auto draw = [&](const char* part, const char* script) {
    const std::string file = std::string(part) + ".json";
    write_text_durably(folder / file, summary_text(summary[part]));
    draw_figure(script, folder / file, folder / part);
  };
  draw("gradients", "gradient_precision.py");
  if (found) draw("snap", "snap_gradient.py");
  return outcome;
}

}  // namespace drape
