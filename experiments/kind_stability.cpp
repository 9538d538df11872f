// kind = "stability": the atlas of where every method converges and where it fails.
//
// A map for every method over mesh size, membrane-to-bending ratio and density with the time step
// that the method chooses itself; over ratio and time step, at the middle density, for those that
// have one; and the hard cases (hard_cases.h) on the smallest mesh. Every cell is one run from the
// folded start with the same CPU time; its index does not depend on stability.only, by which it can
// be run again. A paragraph a method says where it converged, what became of the other cells, and
// why methods of its kind fail there.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/drape_protocol.h"
#include "core/durable_file.h"
#include "experiments/compared_methods.h"
#include "experiments/figure.h"
#include "experiments/hard_cases.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/stability_report.h"
#include "experiments/summary.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

struct Cell {
  int index;
  const baselines::Method* method;
  std::string problem;  ///< "map" or a hard case
  int vertices;
  double ratio = 0, density = 0;  ///< of the map
  double time_step = 0;           ///< 0: the method's own
};

std::vector<Cell> all_cells(const StabilitySettings& study) {
  std::vector<Cell> cells;
  const auto add = [&](Cell cell) {
    cell.index = static_cast<int>(cells.size());
    cells.push_back(cell);
  };
  const double density = study.areal_density[study.areal_density.size() / 2];
  // all methods have their places, whichever are chosen: an index means the same in every run
  for (const baselines::Method& method : baselines::methods()) {
    for (const int vertices : study.vertices)
      for (const double ratio : study.membrane_to_bending) {
        for (const double rho : study.areal_density) add({0, &method, "map", vertices, ratio, rho});
        if (!method.has_time_step) continue;
        for (const double step : study.time_steps)
          add({0, &method, "map", vertices, ratio, density, step});
      }
    const int smallest = *std::min_element(study.vertices.begin(), study.vertices.end());
    for (const std::string& problem : hard_cases()) add({0, &method, problem, smallest});
  }
  return cells;
}

std::vector<Cell> chosen_cells(const StabilitySettings& study) {
  const auto methods = compared_methods(study.methods);
  std::vector<Cell> cells = all_cells(study);
  std::erase_if(cells, [&](const Cell& cell) {
    return std::ranges::count(methods, cell.method) == 0 ||
           (!study.only.empty() && std::ranges::count(study.only, cell.index) == 0);
  });
  return cells;
}

Problem make_problem(const Settings& settings, const Cell& cell,
                     std::shared_ptr<const Discretization> mesh) {
  if (cell.problem != "map") return hard_case(cell.problem, settings, cell.vertices);
  const VecX start =
      folded_state(mesh->mesh(), settings.scene, settings.start.lobes, settings.start.phase);
  return {make_potential(mesh, make_fabric(settings.scene, cell.ratio, cell.density), settings),
          start};
}

Json run_cell(const Settings& settings, const Cell& cell,
              std::shared_ptr<const Discretization> mesh) {
  Json item = {{"index", cell.index},
               {"method", cell.method->name},
               {"case", cell.problem},
               {"vertices", cell.vertices},
               {"membrane_to_bending", cell.ratio},
               {"areal_density", cell.density},
               {"time_step", cell.time_step}};
  try {
    const Problem problem = make_problem(settings, cell, std::move(mesh));
    const baselines::MethodRun run = baselines::run(
        *cell.method, problem.potential, problem.start,
        {.cpu_seconds = budget_of_size(settings.stability.cpu_seconds, cell.vertices),
         .tolerance = settings.solver.tolerance,
         .time_step = cell.time_step});
    item["outcome"] = name(run.outcome);
    item["residual"] = run.end().residual;
    item["smallest_residual"] = run.smallest_residual;
    item["cpu_seconds"] = run.end().cpu_seconds;
    item["iterations"] = run.end().iterations;
  } catch (const std::exception& error) {
    item["outcome"] = "not_run";
    item["reason"] = error.what();
  }
  return item;
}

}  // namespace

RunOutcome run_stability(const Settings& settings, OutputFolder& folder) {
  const StabilitySettings& study = settings.stability;
  const std::vector<Cell> cells = chosen_cells(study);
  const auto count = static_cast<int>(cells.size());
  const JsonStore store(folder, "cells");
  int resumed = 0;
  for (const Cell& cell : cells) resumed += store.has(std::to_string(cell.index));
  if (resumed < count) {
    std::map<int, std::shared_ptr<const Discretization>> meshes;
    for (const int vertices : study.vertices)
      meshes[vertices] = make_discretization(settings, vertices);
    Progress progress("stability", count, resumed);
    for_each_item(count, settings.experiment.thread_count(), [&](int i) {
      const Cell& cell = cells[static_cast<size_t>(i)];
      if (store.has(std::to_string(cell.index))) return;
      store.save(std::to_string(cell.index), run_cell(settings, cell, meshes.at(cell.vertices)));
      progress.advance();
    });
    if (interrupted()) return {"partial", {}};
  }

  std::vector<Json> done;
  for (const Cell& cell : cells) done.push_back(store.load(std::to_string(cell.index)));
  RunOutcome outcome;
  Json& summary = outcome.summary;
  summary["cells"] = count;
  summary["cpu_seconds_at_1000_vertices"] = study.cpu_seconds;
  summary["methods"] = account_of_methods(done);
  Json failures = Json::array();
  bool core_converged = true;
  for (const Json& cell : done) {
    if (cell["outcome"] == "converged") continue;
    if (cell["method"] == "core") core_converged = false;
    Json failure = cell;
    failure["replay"] = "drape run " + (folder / "config.toml").string() +
                        " --out REPLAY --set stability.only=[" +
                        std::to_string(cell["index"].get<int>()) + "]";
    failures.push_back(failure);
  }
  summary["failures"] = failures;
  outcome.status = core_converged ? "ok" : "partial";
  for (const Json& account : summary["methods"]) std::printf("%s\n", paragraph(account).c_str());
  std::fflush(stdout);  // the script prints as well
  Json atlas = {
      {"cpu_seconds", study.cpu_seconds}, {"methods", summary["methods"]}, {"cells", done}};
  write_text_durably(folder / "atlas.json", summary_text(atlas));
  draw_figure("stability.py", folder / "atlas.json", folder / "atlas");
  draw_figure("stability_methods.py", folder / "atlas.json", folder / "methods");
  return outcome;
}

}  // namespace drape
