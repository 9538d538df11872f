#include "experiments/ablation_report.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "experiments/statistics.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

/// One ingredient over all fabrics; only followed changes count.
Json account(const Ingredient& ingredient, const std::vector<Json>& cells) {
  std::vector<double> changes, rms, misses, costs;
  int followed = 0, nodes = 0, snaps = 0;
  for (const Json& cell : cells) {
    if (cell.contains("cpu_ratio")) costs.push_back(number(cell["cpu_ratio"]));
    if (!cell.value("followed", false)) continue;
    ++followed;
    snaps += cell["snaps"].get<int>();
    nodes += cell["node_change"] != 0;
    changes.push_back(std::abs(number(cell["change"]) - cell.value("snap_change", 0.0)));
    rms.push_back(1e3 * number(cell["outline_rms"]));
    if (cell.contains("miss_change")) misses.push_back(1e3 * number(cell["miss_change"]));
  }
  Json row = {{"name", ingredient.name},
              {"label", ingredient.label},
              {"drapes", cells.size()},
              {"followed", followed},
              {"snaps", snaps},
              {"change_median", median(changes)},
              {"change_largest", percentile(changes, 100)},
              {"outline_rms_mm_median", median(rms)},
              {"node_changes", nodes},
              {"cpu_ratio_median", median(costs)}};
  if (!misses.empty()) row["miss_change_mm_median"] = median(misses);
  return row;
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

}  // namespace

std::string item_name(const AblationSubject& subject, std::string_view what) {
  return subject.name + "_" + std::string(what);
}

bool checks_resolution(const Settings& settings, const AblationSubject& subject) {
  return settings.ablation.largest_vertices > 0 && !subject.capture;
}

Json ablation_report(const Settings& settings, const JsonStore& store,
                     const std::vector<AblationSubject>& subjects,
                     const std::vector<const Ingredient*>& list) {
  Json abouts = Json::array(), rows = Json::array(), cells = Json::array();
  Json contact = Json::array(), resolution = Json::array();
  std::vector<std::pair<bool, bool>> contact_rule, resolution_rule;
  std::map<const Ingredient*, std::vector<Json>> of_ingredient;
  for (const AblationSubject& subject : subjects) {
    Json about = store.load(item_name(subject, kFabricItem));
    const bool draped = about["status"] == "converged";
    about["name"] = subject.name;
    about.erase("outline_mm");
    abouts.push_back(std::move(about));
    if (!draped) continue;
    contact.push_back(store.load(item_name(subject, kContactRule)));
    if (contact.back().contains("needed"))
      contact_rule.emplace_back(contact.back()["acts"].get<bool>(),
                                contact.back()["needed"].get<bool>());
    for (const Ingredient* ingredient : list) {
      Json cell = store.load(item_name(subject, ingredient->name));
      cell["ingredient"] = ingredient->name;
      cell["fabric"] = subject.name;
      of_ingredient[ingredient].push_back(cell);
      cells.push_back(std::move(cell));
    }
    if (!checks_resolution(settings, subject)) continue;
    resolution.push_back(store.load(item_name(subject, kResolutionRule)));
    // the rule acts, refining or saying what limits it, unless it says that it is within tolerance
    if (resolution.back().value("same_branch", false))
      resolution_rule.emplace_back(resolution.back()["status"] != "within_tolerance",
                                   number(resolution.back()["error"]) > settings.mesh.tolerance);
  }
  for (const Ingredient* ingredient : list)
    rows.push_back(account(*ingredient, of_ingredient[ingredient]));
  Json report = {{"fabrics", abouts},
                 {"ingredients", rows},
                 {"contact_rule", agreement(contact_rule)},
                 {"resolution_rule", agreement(resolution_rule)},
                 {"cells", cells}};
  report["contact_rule"]["cells"] = contact;
  report["resolution_rule"]["cells"] = resolution;
  return report;
}

void print_ingredients(const std::string& title, const Json& rows) {
  std::printf("%-26s %9s %6s %11s %9s %8s %8s %6s %9s\n", title.c_str(), "followed", "snaps",
              "|DC| median", "largest", "rms mm", "miss mm", "nodes", "CPU ratio");
  for (const Json& row : rows)
    std::printf("%-26s %4d of %2d %6d %11.3f %9.3f %8.3f %8.3f %6d %9.2f\n",
                row["name"].get<std::string>().c_str(), row["followed"].get<int>(),
                row["drapes"].get<int>(), row["snaps"].get<int>(), number(row["change_median"]),
                number(row["change_largest"]), number(row["outline_rms_mm_median"]),
                row.contains("miss_change_mm_median") ? number(row["miss_change_mm_median"]) : NAN,
                row["node_changes"].get<int>(), number(row["cpu_ratio_median"]));
}

}  // namespace drape
