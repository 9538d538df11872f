// kind = "ablation": what each ingredient of the model, the discretisation and the solver changes
// of drapes from stiff to soft, one at a time, and what it costs; and whether the rules of
// contact = "auto" and mesh.vertices = "auto" act where they have to.
//
// The fabrics are that of the settings with its bending stiffnesses scaled to drape coefficients
// asked for. What "change" and "followed" mean is said in ablation.h. The cost of an ingredient is
// the CPU time of the drape by the protocol with it changed, over that without.
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/coarse_level.h"
#include "core/durable_file.h"
#include "experiments/ablation.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/statistics.h"
#include "experiments/summary.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kContactRule = "contact_rule";
constexpr const char* kResolutionRule = "resolution_rule";
constexpr const char* kBending[] = {"k_bu", "k_bv", "k_bh"};

std::vector<const Ingredient*> chosen_ingredients(const AblationSettings& study) {
  std::vector<const Ingredient*> list;
  for (const AblatedIngredient i : study.ingredients)
    list.push_back(&ingredients()[static_cast<size_t>(i)]);
  if (list.empty())
    for (const Ingredient& i : ingredients()) list.push_back(&i);
  return list;
}

std::string item_name(int fabric, std::string_view what) {
  return std::to_string(fabric) + "_" + std::string(what);
}

/// The discretizations of the settings and of every ingredient, each built once.
class Meshes {
 public:
  Meshes(const Settings& settings, const std::vector<const Ingredient*>& list) {
    add(settings);
    for (const Ingredient* ingredient : list) {
      Settings changed = settings;
      ingredient->change(changed);
      add(changed);
    }
  }
  const std::shared_ptr<const Discretization>& of(const Settings& settings) const {
    return meshes_.at(key(settings.mesh));
  }

 private:
  using Key = std::tuple<int, std::uint64_t, double>;
  static Key key(const MeshSettings& mesh) {
    return {mesh.vertices.value(), mesh.seed, mesh.clamp_wing_factor};
  }
  void add(const Settings& settings) {
    auto& mesh = meshes_[key(settings.mesh)];
    if (!mesh) mesh = make_discretization(settings);
  }

  std::map<Key, std::shared_ptr<const Discretization>> meshes_;
};

/// One fabric with all that is not in the store yet.
class FabricStudy {
 public:
  FabricStudy(const Settings& settings, const JsonStore& store, int index)
      : settings_(settings), store_(store), index_(index) {}

  void run(const Meshes& meshes, const std::shared_ptr<const Discretization>& coarse,
           const std::vector<const Ingredient*>& list, Progress& progress) {
    const std::string fabric_item = item_name(index_, "fabric");
    Json about = {{"aim", settings_.ablation.drape_coefficients[static_cast<size_t>(index_)]}};
    try {
      if (store_.has(fabric_item))
        about = store_.load(fabric_item);
      else
        settings_.fabric = fabric_of_coefficient(settings_, coarse, number(about["aim"]));
      for (const char* k : kBending) {
        double& value = settings_.fabric[*parameter_from_name(k)];
        if (about.contains(k)) value = number(about[k]);
        about[k] = value;
      }
      const UnchangedDrape unchanged(settings_, meshes.of(settings_));
      about["status"] = "converged";
      about["drape_coefficient_percent"] = unchanged.seen.coefficient;
      about["node_count"] = unchanged.seen.nodes;
      about["cpu_seconds"] = unchanged.drape.equilibrium.cpu_seconds;
      about["contact"] = unchanged.drape.contact.acting();
      about["wings_past_threshold"] =
          unchanged.potential.wings_past_threshold(unchanged.drape.equilibrium.x);
      store_.save(fabric_item, about);
      keep(kContactRule, progress, [&] { return check_contact_rule(unchanged); });
      for (const Ingredient* ingredient : list)
        keep(ingredient->name, progress, [&] {
          Settings changed = settings_;
          ingredient->change(changed);
          return ablate(unchanged, *ingredient, meshes.of(changed));
        });
      if (settings_.ablation.largest_vertices > 0)
        keep(kResolutionRule, progress, [&] { return check_resolution_rule(settings_); });
    } catch (const std::exception& error) {
      about["status"] = error.what();
      store_.save(fabric_item, about);
    }
  }

 private:
  template <class Work>
  void keep(std::string_view what, Progress& progress, const Work& work) {
    const std::string item = item_name(index_, what);
    if (interrupted() || store_.has(item)) return;
    try {
      store_.save(item, work());
    } catch (const std::exception& error) {  // an outline that cannot be traced
      store_.save(item, {{"status", error.what()}, {"followed", false}});
    }
    progress.advance();
  }

  Settings settings_;
  const JsonStore& store_;
  const int index_;
};

/// One ingredient over all fabrics; only followed changes count.
Json account(const Ingredient& ingredient, const std::vector<Json>& cells) {
  std::vector<double> changes, rms, costs;
  int followed = 0, nodes = 0, snaps = 0;
  for (const Json& cell : cells) {
    if (cell.contains("cpu_ratio")) costs.push_back(number(cell["cpu_ratio"]));
    if (!cell.value("followed", false)) continue;
    ++followed;
    snaps += cell["snaps"].get<int>();
    nodes += cell["node_change"] != 0;
    changes.push_back(std::abs(number(cell["change"]) - cell.value("snap_change", 0.0)));
    rms.push_back(1e3 * number(cell["outline_rms"]));
  }
  return {{"name", ingredient.name},
          {"label", ingredient.label},
          {"fabrics", cells.size()},
          {"followed", followed},
          {"snaps", snaps},
          {"change_median", median(changes)},
          {"change_largest", percentile(changes, 100)},
          {"outline_rms_mm_median", median(rms)},
          {"node_changes", nodes},
          {"cpu_ratio_median", median(costs)}};
}

/// How often a rule acts and how often it has to.
Json agreement(const std::vector<std::pair<bool, bool>>& acts_and_needed) {
  int both = 0, neither = 0, needless = 0, missed = 0;
  for (const auto& [acts, needed] : acts_and_needed)
    ++(acts ? (needed ? both : needless) : (needed ? missed : neither));
  return {{"checked", acts_and_needed.size()},
          {"acts_where_needed", both},
          {"idle_where_not_needed", neither},
          {"acts_needlessly", needless},
          {"idle_where_needed", missed}};
}

void print_table(const Json& rows) {
  std::printf("%-26s %9s %6s %11s %9s %8s %6s %9s\n", "ingredient", "followed", "snaps",
              "|DC| median", "largest", "rms mm", "nodes", "CPU ratio");
  for (const Json& row : rows)
    std::printf("%-26s %4d of %2d %6d %11.3f %9.3f %8.3f %6d %9.2f\n",
                row["name"].get<std::string>().c_str(), row["followed"].get<int>(),
                row["fabrics"].get<int>(), row["snaps"].get<int>(), number(row["change_median"]),
                number(row["change_largest"]), number(row["outline_rms_mm_median"]),
                row["node_changes"].get<int>(), number(row["cpu_ratio_median"]));
}

}  // namespace

RunOutcome run_ablation(const Settings& settings, OutputFolder& folder) {
  const AblationSettings& study = settings.ablation;
  const std::vector<const Ingredient*> list = chosen_ingredients(study);
  const int fabrics = static_cast<int>(study.drape_coefficients.size());
  const JsonStore store(folder, "cells");
  std::vector<std::string> names{kContactRule};
  for (const Ingredient* ingredient : list) names.emplace_back(ingredient->name);
  if (study.largest_vertices > 0) names.emplace_back(kResolutionRule);
  const int total = fabrics * static_cast<int>(names.size());
  int resumed = 0;
  for (int i = 0; i < fabrics; ++i)
    for (const std::string& name : names) resumed += store.has(item_name(i, name));
  if (resumed < total) {
    const Meshes meshes(settings, list);
    const auto coarse = make_discretization(settings, kCoarseVertices);
    Progress progress("ablation", total, resumed);
    for_each_item(fabrics, settings.experiment.thread_count(), [&](int i) {
      FabricStudy(settings, store, i).run(meshes, coarse, list, progress);
    });
    if (interrupted()) return {"partial", {}};
  }

  Json abouts = Json::array(), rows = Json::array(), cells = Json::array();
  Json contact = Json::array(), resolution = Json::array();
  std::vector<std::pair<bool, bool>> contact_rule, resolution_rule;
  std::vector<int> draped;
  for (int i = 0; i < fabrics; ++i) {
    abouts.push_back(store.load(item_name(i, "fabric")));
    if (abouts.back()["status"] != "converged") continue;
    draped.push_back(i);
    contact.push_back(store.load(item_name(i, kContactRule)));
    if (contact.back().contains("needed"))
      contact_rule.emplace_back(contact.back()["acts"].get<bool>(),
                                contact.back()["needed"].get<bool>());
    if (study.largest_vertices <= 0) continue;
    resolution.push_back(store.load(item_name(i, kResolutionRule)));
    // the rule acts, refining or saying what limits it, unless it says that it is within tolerance
    if (resolution.back().value("same_branch", false))
      resolution_rule.emplace_back(resolution.back()["status"] != "within_tolerance",
                                   number(resolution.back()["error"]) > settings.mesh.tolerance);
  }
  for (const Ingredient* ingredient : list) {
    std::vector<Json> row;
    for (const int i : draped) {
      Json cell = store.load(item_name(i, ingredient->name));
      cell["ingredient"] = ingredient->name;
      cell["fabric"] = i;
      row.push_back(cell);
      cells.push_back(std::move(cell));
    }
    rows.push_back(account(*ingredient, row));
  }
  RunOutcome outcome;
  Json& summary = outcome.summary;
  summary["vertices"] = settings.mesh.vertices.value();
  summary["tolerance_points"] = settings.mesh.tolerance;
  summary["outline_tolerance_mm"] = 1e3 * study.outline_tolerance;
  summary["fabrics"] = abouts;
  summary["ingredients"] = rows;
  summary["contact_rule"] = agreement(contact_rule);
  summary["contact_rule"]["cells"] = contact;
  summary["resolution_rule"] = agreement(resolution_rule);
  summary["resolution_rule"]["cells"] = resolution;
  outcome.status = static_cast<int>(draped.size()) == fabrics ? "ok"
                   : draped.empty()                           ? "failed"
                                                              : "partial";
  print_table(rows);
  std::fflush(stdout);  // the script prints as well
  Json drawn = summary;
  drawn["cells"] = cells;
  write_text_durably(folder / "ablation.json", summary_text(drawn));
  summary["cells"] = cells;
  draw_figure("ablation.py", folder / "ablation.json", folder / "ablation");
  return outcome;
}

}  // namespace drape
