// kind = "accuracy": error of the drape coefficient against mesh size and CPU time, on one branch.
//
// The reference of a fabric is followed from the coarsest mesh to the finest, each mesh started
// from the state on the one before (transfer.h). On every mesh the fabric is then draped twice:
// cold, by the start protocol, for the CPU time and the share of drapes that find the reference's
// branch; and from the reference's state, for the error of the mesh on that branch. Two drapes
// match if they have the same nodes and outlines less than 2 mm apart (rms); folds that slide
// around the disc together, which an isotropic fabric hardly resists, count as another branch, so
// errors of all pairs with the same nodes are given as well.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "core/durable_file.h"
#include "core/transfer.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/record_store.h"
#include "experiments/statistics.h"
#include "experiments/study_fabrics.h"
#include "experiments/summary.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLargestRms = 2e-3;  // of matching outlines [m]
constexpr const char* kSoftness[] = {"stiff", "medium", "soft"};

std::string item_name(int vertices, int seed, int fabric) {
  return std::to_string(vertices) + "_" + std::to_string(seed) + "_" + std::to_string(fabric);
}

/// Sizes of the meshes that lead to the reference, ascending.
std::vector<int> sizes_to_reference(const AccuracySettings& accuracy) {
  std::vector<int> sizes;
  for (const int vertices : accuracy.vertices)
    if (vertices < accuracy.reference_vertices) sizes.push_back(vertices);
  std::sort(sizes.begin(), sizes.end());
  sizes.push_back(accuracy.reference_vertices);
  return sizes;
}

Equilibrium drape_from(const Settings& settings, Potential& potential, const VecX& x) {
  return drape(settings, potential,
               [&](const Potential& of) {
                 return solve_equilibrium(of, x, equilibrium_options(settings));
               })
      .equilibrium;
}

/// The reference drape of one fabric, converged or not.
Record solve_reference(const Settings& settings,
                       const std::vector<std::shared_ptr<const Discretization>>& meshes,
                       const Fabric& fabric) {
  Equilibrium equilibrium;
  const Mesh* last = nullptr;
  for (const auto& discretization : meshes) {
    Potential potential = make_potential(discretization, fabric, settings);
    equilibrium = last == nullptr ? drape(settings, potential).equilibrium
                                  : drape_from(settings, potential,
                                               Transfer(*last, potential.mesh())(equilibrium.x));
    last = &potential.mesh();
    if (!equilibrium.converged() || discretization == meshes.back()) {
      if (discretization == meshes.back()) return make_record(settings, potential, equilibrium);
      break;
    }
  }
  return failed_record(settings, meshes.back()->mesh(), fabric,
                       std::string(name(equilibrium.status)));
}

/// A drape beside the reference's.
Json compare(const Settings& settings, const Potential& potential, const Equilibrium& equilibrium,
             const Record& reference) {
  Json item = {{"status", name(equilibrium.status)}, {"cpu_seconds", equilibrium.cpu_seconds}};
  if (!equilibrium.converged()) return item;
  const Observation seen =
      observe(settings.scene, potential.mesh(), equilibrium.x, observation_grid(settings));
  const VecX difference = seen.profile - reference.observation.profile;
  const double rms = std::sqrt(difference.squaredNorm() / static_cast<double>(difference.size()));
  item["drape_coefficient_percent"] = 100 * seen.drape_coefficient;
  item["drape_coefficient_error"] =
      100 * (seen.drape_coefficient - reference.observation.drape_coefficient);
  item["node_count"] = seen.node_count;
  item["outline_rms"] = rms;
  item["same_nodes"] = seen.node_count == reference.observation.node_count;
  item["matched"] = item["same_nodes"] && rms < kLargestRms;
  return item;
}

Json solve(const Settings& settings, Potential& potential, const Mesh& reference_mesh,
           const Record& reference) {
  Json item = Json::object();
  try {
    item["cold"] = compare(settings, potential, drape(settings, potential).equilibrium, reference);
    const VecX start = Transfer(reference_mesh, potential.mesh())(reference.positions);
    item["followed"] =
        compare(settings, potential, drape_from(settings, potential, start), reference);
  } catch (const std::exception& error) {  // an outline that cannot be traced
    for (const char* way : {"cold", "followed"})
      if (!item.contains(way)) item[way] = {{"status", error.what()}, {"cpu_seconds", nullptr}};
  }
  return item;
}

bool matched(const Json& drape) { return drape.value("matched", false); }
bool same_nodes(const Json& drape) { return drape.value("same_nodes", false); }

/// One size and softness: median absolute errors of matched drapes, shares, CPU.
Json account(const std::vector<Json>& items) {
  std::vector<double> followed_errors, same_nodes_errors, cold_errors, cpu, rms;
  double followed = 0, cold = 0;
  for (const Json& item : items) {
    cpu.push_back(number(item["cold"]["cpu_seconds"]));
    if (same_nodes(item["followed"]))
      same_nodes_errors.push_back(std::abs(number(item["followed"]["drape_coefficient_error"])));
    if (matched(item["followed"])) {
      ++followed;
      followed_errors.push_back(std::abs(number(item["followed"]["drape_coefficient_error"])));
      rms.push_back(1e3 * number(item["followed"]["outline_rms"]));
    }
    if (matched(item["cold"])) {
      ++cold;
      cold_errors.push_back(std::abs(number(item["cold"]["drape_coefficient_error"])));
    }
  }
  const auto drapes = static_cast<double>(items.size());
  return {{"drapes", items.size()},
          {"error_median", median(followed_errors)},
          {"error_95", percentile(followed_errors, 95)},
          {"outline_rms_mm_median", median(rms)},
          {"matched_share", followed / drapes},
          {"same_nodes_share", static_cast<double>(same_nodes_errors.size()) / drapes},
          {"same_nodes_error_median", median(same_nodes_errors)},
          {"cold_error_median", median(cold_errors)},
          {"cold_matched_share", cold / drapes},
          {"cold_cpu_seconds_median", median(cpu)}};
}

void print_row(const std::string& softness, const std::string& vertices, const Json& row) {
  std::printf("%-8s %9s %11.3f %9.3f %8.2f %8.0f%% %11.3f %8.0f%% %11.3f %8.0f%% %9.2f\n",
              softness.c_str(), vertices.c_str(), number(row["error_median"]),
              number(row["error_95"]), number(row["outline_rms_mm_median"]),
              100 * number(row["matched_share"]), number(row["same_nodes_error_median"]),
              100 * number(row["same_nodes_share"]), number(row["cold_error_median"]),
              100 * number(row["cold_matched_share"]), number(row["cold_cpu_seconds_median"]));
}

}  // namespace

RunOutcome run_accuracy(const Settings& settings, OutputFolder& folder) {
  const AccuracySettings& accuracy = settings.accuracy;
  const int fabrics = accuracy.fabrics, threads = settings.experiment.thread_count();

  const std::vector<int> sizes = sizes_to_reference(accuracy);
  const auto reference = make_discretization(settings, sizes.back());
  const RecordStore references(folder.path(), records_header(settings, reference->mesh()), fabrics);
  if (references.finished() < fabrics) {
    std::vector<std::shared_ptr<const Discretization>> meshes;
    for (size_t i = 0; i + 1 < sizes.size(); ++i)
      meshes.push_back(make_discretization(settings, sizes[i]));
    meshes.push_back(reference);
    Progress progress("references", fabrics, references.finished());
    for_each_item(fabrics, threads, [&](int i) {
      if (references.has(i)) return;
      Record record = solve_reference(settings, meshes, study_fabric(i).fabric);
      record.id = record.name = study_fabric(i).softness + " " + std::to_string(i);
      references.save(i, record);
      progress.advance();
    });
    if (interrupted()) return {"partial", {}};
  }
  references.consolidate();
  const std::vector<Record> records = references.load_all();

  const JsonStore store(folder, "drapes");
  int resumed = 0;
  std::vector<std::pair<int, int>> meshes;
  for (const int vertices : accuracy.vertices)
    for (int seed = 1; seed <= accuracy.seeds; ++seed) {
      meshes.emplace_back(vertices, seed);
      for (int i = 0; i < fabrics; ++i) resumed += store.has(item_name(vertices, seed, i));
    }
  {
    Progress progress("accuracy", static_cast<int>(meshes.size()) * fabrics, resumed);
    for (const auto& [vertices, seed] : meshes) {
      bool complete = true;
      for (int i = 0; i < fabrics; ++i) complete &= store.has(item_name(vertices, seed, i));
      if (complete) continue;
      Settings other = settings;  // no mesh of the study is one of those that led to the reference
      other.mesh.seed = settings.mesh.seed + static_cast<std::uint64_t>(seed);
      const auto discretization = make_discretization(other, vertices);
      for_each_item(fabrics, threads, [&, vertices = vertices, seed = seed](int i) {
        const std::string item_file = item_name(vertices, seed, i);
        if (store.has(item_file)) return;
        Potential potential = make_potential(discretization, study_fabric(i).fabric, settings);
        const Record& record = records[static_cast<size_t>(i)];
        const Json nothing = {{"status", "no reference"}, {"cpu_seconds", nullptr}};
        Json item = converged(record) ? solve(settings, potential, reference->mesh(), record)
                                      : Json{{"cold", nothing}, {"followed", nothing}};
        item["softness"] = study_fabric(i).softness;
        store.save(item_file, item);
        progress.advance();
      });
      if (interrupted()) return {"partial", {}};
    }
  }

  RunOutcome outcome;
  Json& summary = outcome.summary;
  summary["fabrics"] = fabrics;
  summary["reference_vertices"] = reference->mesh().vertex_count();
  int solves = 0, good = 0;
  Json reference_rows = Json::array();
  for (const Record& record : records)
    reference_rows.push_back(
        {{"name", record.name},
         {"status", record.stats.status},
         {"drape_coefficient_percent", 100 * record.observation.drape_coefficient},
         {"node_count", record.observation.node_count}});
  summary["references"] = reference_rows;
  std::printf("%-8s %9s %11s %9s %8s %9s %11s %9s %11s %9s %9s\n", "fabrics", "vertices",
              "DC error", "95 %", "rms mm", "matched", "same nodes", "share", "cold error",
              "matched", "CPU s");
  for (const char* softness : kSoftness) {
    for (const int vertices : accuracy.vertices) {
      std::vector<Json> items;
      for (int seed = 1; seed <= accuracy.seeds; ++seed)
        for (int i = 0; i < fabrics; ++i)
          if (study_fabric(i).softness == softness)
            items.push_back(store.load(item_name(vertices, seed, i)));
      if (items.empty()) continue;
      for (const Json& item : items)
        for (const char* way : {"cold", "followed"}) {
          ++solves;
          good += item[way]["status"] == "converged";
        }
      const Json row = account(items);
      summary["per_softness"][softness][std::to_string(vertices)] = row;
      print_row(softness, std::to_string(vertices), row);
    }
  }
  summary["solves"] = solves;
  summary["converged"] = good;
  outcome.status = good == solves ? "ok" : good > 0 ? "partial" : "failed";
  write_text_durably(folder / "accuracy.json", summary_text(outcome.summary));
  draw_figure("accuracy.py", folder / "accuracy.json", folder / "accuracy");
  return outcome;
}

}  // namespace drape
