// kind = "validation": strips, a plate and turned meshes against solutions that are not this code.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "core/durable_file.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/kinds.h"
#include "experiments/mesh_bias.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/statistics.h"
#include "experiments/summary.h"
#include "experiments/validation_cases.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kPi = std::numbers::pi;
constexpr double kLength = 0.1, kWidth = 0.02, kFineEdge = 0.0025;  // of strips [m]
constexpr double kSlenderness = 2;  // where only the mesh, the width or the direction varies

/// One comparison: its place in the tables, and how to get it.
struct Case {
  std::string name, study;
  double value;  ///< what the study varies
  std::function<Comparison()> solve;
};

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::vector<Case> all_cases(const Settings& settings) {
  const ValidationSettings& v = settings.validation;
  const Fabric fabric = settings.fabric;
  const double gravity = settings.scene.gravity;
  std::vector<Case> cases;
  const auto add = [&](const std::string& study, double value, std::uint64_t seed,
                       std::function<Comparison()> solve) {
    cases.push_back({study + "_" + number_text(value) + "_" + std::to_string(seed), study, value,
                     std::move(solve)});
  };
  for (int i = 1; i <= v.seeds; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    const StripMeshOptions fine{
        .length = kLength, .width = kWidth, .edge_length = kFineEdge, .seed = seed};
    const auto bend = [=](const StripMeshOptions& strip, double slenderness) {
      return [=] { return cantilever(strip, fabric, slenderness, gravity); };
    };
    for (const double slenderness : v.slenderness)
      add("slenderness", slenderness, seed, bend(fine, slenderness));
    for (const double degrees : {0.0, 45.0, 90.0}) {
      StripMeshOptions strip = fine;
      strip.angle = degrees * kPi / 180;
      add("bent_direction", degrees, seed, bend(strip, kSlenderness));
      add("hanging_direction", degrees, seed,
          [=] { return hanging_strip(strip, fabric, gravity); });
      add("hanging_far_stretched", degrees, seed,
          [=] { return hanging_strip(strip, fabric, 1000 * gravity); });
    }
    for (const double edge : v.edge_lengths) {
      StripMeshOptions strip = fine;
      strip.edge_length = edge;
      add("edge_length", edge, seed, bend(strip, kSlenderness));
    }
    for (const double width : v.widths) {
      StripMeshOptions strip = fine;
      strip.width = width;
      add("width", width, seed, bend(strip, kSlenderness));
    }
    for (const int vertices : v.plate_vertices)
      for (const double factor : {1, 2})
        add(factor == 1 ? "plate_single_clamp_weight" : "plate", vertices, seed, [=] {
          return annulus_sag({.vertices = vertices, .seed = seed, .clamp_wing_factor = factor});
        });
  }
  return cases;
}

Json to_json(const Comparison& c) {
  return {{"status", c.status},
          {"vertices", c.vertices},
          {"measured", c.measured},
          {"expected", c.expected},
          {"error", c.error()},
          {"rigidity_over_k", c.rigidity_over_k},
          {"mean_rigidity_over_k", c.mean_rigidity_over_k},
          {"radial_energy_ratio", c.radial_energy_ratio},
          {"worst_place", c.worst_place},
          {"residual", c.residual},
          {"drape_cpu_seconds", c.cpu_seconds}};
}

/// One study: for every value the mean over the meshes, and all their errors.
Json table(const std::vector<Json>& items) {
  std::map<double, std::vector<const Json*>> rows;
  for (const Json& item : items)
    if (item["status"] == "converged") rows[number(item["value"])].push_back(&item);
  Json list = Json::array();
  for (const auto& [value, row] : rows) {
    std::vector<double> errors, bulk, mean_rigidity, radial, vertices, expected;
    for (const Json* item : row) {
      errors.push_back(number((*item)["error"]));
      bulk.push_back(number((*item)["rigidity_over_k"]));
      mean_rigidity.push_back(number((*item)["mean_rigidity_over_k"]));
      radial.push_back(number((*item)["radial_energy_ratio"]));
      vertices.push_back(number((*item)["vertices"]));
      expected.push_back(number((*item)["expected"]));
    }
    list.push_back({{"value", value},
                    {"vertices", mean(vertices)},
                    {"expected", mean(expected)},
                    {"mean_error", mean(errors)},
                    {"errors", errors},
                    {"rigidity_over_k", mean(bulk)},
                    {"mean_rigidity_over_k", mean(mean_rigidity)},
                    {"radial_energy_ratio", mean(radial)}});
  }
  return list;
}

/// Slope of log(median |error|) over log(size), where size is an edge length or the -1/2 power of a
/// number of vertices; NaN for fewer than two sizes.
double order(const Json& rows, bool by_vertices) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const Json& row : rows) {
    std::vector<double> errors = row["errors"];
    for (double& error : errors) error = std::abs(error);
    const double x = std::log(number(row["value"])) * (by_vertices ? -0.5 : 1);
    const double y = std::log(median(errors));
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return n < 2 ? NAN : (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void print_table(const std::string& study, const Json& rows) {
  std::printf("%-26s %9s %9s %11s %9s %9s\n", study.c_str(), "value", "vertices", "mean error",
              "B/k bulk", "B/k mean");
  for (const Json& row : rows)
    std::printf("%-26s %9g %9.0f %10.3f%% %9.3f %9.3f\n", "", number(row["value"]),
                number(row["vertices"]), 100 * number(row["mean_error"]),
                number(row["rigidity_over_k"]), number(row["mean_rigidity_over_k"]));
}

void print_bias(const Json& bias) {
  std::printf("%-34s %6s %6s %6s %6s %7s %7s  %s\n", "mesh bias: fabric, vertices, start", "DC %",
              "sd", "turns", "seeds", "fabric", "mesh", "nodes");
  for (const auto& [group, row] : bias.items())
    std::printf("%-34s %6.2f %6.2f %6.2f %6.2f %7.2f %7.2f  %s\n", group.c_str(),
                number(row["mean"]), number(row["sd"]), number(row["sd_over_rotations"]),
                number(row["sd_over_seeds"]), number(row["coherence_with_fabric"]),
                number(row["coherence_with_mesh"]), row["nodes"].dump().c_str());
}

double worst_mean_error(const Json& rows) {
  double worst = 0;
  for (const Json& row : rows) worst = std::max(worst, std::abs(number(row["mean_error"])));
  return worst;
}

}  // namespace

RunOutcome run_validation(const Settings& settings, OutputFolder& folder) {
  const std::vector<Case> cases = all_cases(settings);
  const auto count = static_cast<int>(cases.size());
  const JsonStore store(folder, "cases");
  {
    int resumed = 0;
    for (const Case& c : cases) resumed += store.has(c.name);
    Progress progress("validation", count, resumed);
    for_each_item(count, settings.experiment.thread_count(), [&](int i) {
      const Case& c = cases[static_cast<size_t>(i)];
      if (store.has(c.name)) return;
      Json item = to_json(c.solve());
      item["study"] = c.study;
      item["value"] = c.value;
      store.save(c.name, item);
      progress.advance();
    });
  }
  if (interrupted()) return {"partial", {}};
  const std::vector<Json> drapes = drape_turned_meshes(settings, folder);
  if (interrupted()) return {"partial", {}};

  int total = 0, converged_count = 0;
  std::vector<std::string> studies;
  std::map<std::string, std::vector<Json>> items;
  for (const Case& c : cases) {
    const Json item = store.load(c.name);
    if (items[c.study].empty()) studies.push_back(c.study);
    items[c.study].push_back(item);
    ++total;
    converged_count += item["status"] == "converged";
  }
  for (const Json& drape : drapes) {
    ++total;
    converged_count += drape["status"] == "converged";
  }

  RunOutcome outcome;
  outcome.status = converged_count == total ? "ok" : converged_count > 0 ? "partial" : "failed";
  Json& summary = outcome.summary;
  summary["solves"] = total;
  summary["converged"] = converged_count;
  Json tables = Json::object();
  for (const std::string& study : studies) {
    tables[study] = table(items[study]);
    print_table(study, tables[study]);
  }
  summary["cantilever_worst_mean_error"] = worst_mean_error(tables["slenderness"]);
  summary["cantilever_order"] = order(tables["edge_length"], false);
  summary["hanging_worst_mean_error"] = std::max(worst_mean_error(tables["hanging_direction"]),
                                                 worst_mean_error(tables["hanging_far_stretched"]));
  summary["plate_order"] = order(tables["plate"], true);
  summary["plate_order_single_clamp_weight"] = order(tables["plate_single_clamp_weight"], true);
  summary["studies"] = tables;
  summary["mesh_bias"] = mesh_bias_table(drapes);
  if (!drapes.empty()) print_bias(summary["mesh_bias"]);
  std::printf("orders: cantilever %.2f, plate %.2f (clamp wings of single weight %.2f)\n",
              number(summary["cantilever_order"]), number(summary["plate_order"]),
              number(summary["plate_order_single_clamp_weight"]));
  write_text_durably(folder / "validation.json", summary_text(outcome.summary));
  draw_figure("validation.py", folder / "validation.json", folder / "validation");
  return outcome;
}

}  // namespace drape
