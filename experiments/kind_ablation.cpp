// kind = "ablation": what each ingredient of the model, the discretisation and the solver changes
// of drapes from stiff to soft, one at a time, and what it costs; and whether the rules of
// contact = "auto" and mesh.vertices = "auto" act where they have to.
//
// What the drapes are is said in ablation_subjects.h, what "change" and "followed" mean in
// ablation.h. The cost of an ingredient is the CPU time of the drape by the protocol with it
// changed, over that without.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/coarse_level.h"
#include "core/durable_file.h"
#include "experiments/ablation.h"
#include "experiments/ablation_report.h"
#include "experiments/ablation_subjects.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/summary.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

std::vector<const Ingredient*> chosen_ingredients(const AblationSettings& study) {
  std::vector<const Ingredient*> list;
  for (const AblatedIngredient i : study.ingredients)
    list.push_back(&ingredients()[static_cast<size_t>(i)]);
  if (list.empty())
    for (const Ingredient& i : ingredients()) list.push_back(&i);
  return list;
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
  using Key = std::tuple<int, std::uint64_t, double, double>;
  static Key key(const MeshSettings& mesh) {
    return {mesh.vertices.value(), mesh.seed, mesh.clamp_wing_factor, mesh.clamp_refinement};
  }
  void add(const Settings& settings) {
    auto& mesh = meshes_[key(settings.mesh)];
    if (!mesh) mesh = make_discretization(settings);
  }

  std::map<Key, std::shared_ptr<const Discretization>> meshes_;
};

/// One drape with all that is not in the store yet.
class SubjectStudy {
 public:
  SubjectStudy(const AblationSubject& subject, const OutputFolder& folder, const JsonStore& store)
      : subject_(subject), folder_(folder), store_(store) {}

  void run(const Settings& settings, const Meshes& meshes,
           const std::shared_ptr<const Discretization>& coarse,
           const std::vector<const Ingredient*>& list, Progress& progress) {
    const std::string fabric_item = item_name(subject_, kFabricItem);
    Json about;
    try {
      if (store_.has(fabric_item)) about = store_.load(fabric_item);
      if (!about.contains("parameters"))
        about = find_fabric(settings, subject_, meshes.of(settings), coarse);
      const auto [own, observed] = settings_of(settings, subject_, about, folder_);
      const UnchangedDrape unchanged(own, meshes.of(own), observed);
      about["status"] = "converged";
      about["drape_coefficient_percent"] = unchanged.seen.coefficient;
      about["node_count"] = unchanged.seen.nodes;
      if (subject_.capture) about["miss_mm"] = 1e3 * unchanged.miss(unchanged.seen);
      about["cpu_seconds"] = unchanged.drape.equilibrium.cpu_seconds;
      about["contact"] = unchanged.drape.contact.acting();
      about["wings_past_threshold"] =
          unchanged.potential.wings_past_threshold(unchanged.drape.equilibrium.x);
      store_.save(fabric_item, about);
      keep(kContactRule, progress, [&] { return check_contact_rule(unchanged); });
      for (const Ingredient* ingredient : list)
        keep(ingredient->name, progress, [&] {
          Settings changed = unchanged.settings;
          ingredient->change(changed);
          return ablate(unchanged, *ingredient, meshes.of(changed));
        });
      if (checks_resolution(settings, subject_))
        keep(kResolutionRule, progress, [&] { return check_resolution_rule(unchanged.settings); });
    } catch (const std::exception& error) {
      about["status"] = error.what();
      store_.save(fabric_item, about);
    }
  }

 private:
  template <class Work>
  void keep(std::string_view what, Progress& progress, const Work& work) {
    const std::string item = item_name(subject_, what);
    if (interrupted() || store_.has(item)) return;
    try {
      store_.save(item, work());
    } catch (const std::exception& error) {  // an outline that cannot be traced
      store_.save(item, {{"status", error.what()}, {"followed", false}});
    }
    progress.advance();
  }

  const AblationSubject& subject_;
  const OutputFolder& folder_;
  const JsonStore& store_;
};

bool is_photograph(const AblationSubject& subject) { return subject.capture.has_value(); }

}  // namespace

RunOutcome run_ablation(const Settings& settings, OutputFolder& folder) {
  const std::vector<const Ingredient*> list = chosen_ingredients(settings.ablation);
  const std::vector<AblationSubject> subjects = ablation_subjects(settings);
  if (subjects.size() == settings.ablation.drape_coefficients.size() &&
      !settings.photographs.folder.empty())
    std::cout << "photographs.folder " << settings.photographs.folder.string()
              << " is not there: only scaled fabrics\n";
  const JsonStore store(folder, "cells");
  int total = 0, resumed = 0;
  for (const AblationSubject& subject : subjects) {
    std::vector<std::string_view> names{kContactRule};
    for (const Ingredient* ingredient : list) names.push_back(ingredient->name);
    if (checks_resolution(settings, subject)) names.push_back(kResolutionRule);
    total += static_cast<int>(names.size());
    for (const std::string_view name : names) resumed += store.has(item_name(subject, name));
  }
  if (resumed < total) {
    const Meshes meshes(settings, list);
    const auto coarse = make_discretization(settings, kCoarseVertices);
    Progress progress("ablation", total, resumed);
    for_each_item(static_cast<int>(subjects.size()), settings.experiment.thread_count(),
                  [&](int i) {
                    SubjectStudy(subjects[static_cast<size_t>(i)], folder, store)
                        .run(settings, meshes, coarse, list, progress);
                  });
    if (interrupted()) return {"partial", {}};
  }

  std::vector<AblationSubject> scaled, photographs;
  std::partition_copy(subjects.begin(), subjects.end(), std::back_inserter(photographs),
                      std::back_inserter(scaled), is_photograph);
  RunOutcome outcome;
  Json& summary = outcome.summary;
  summary["vertices"] = settings.mesh.vertices.value();
  summary["tolerance_points"] = settings.mesh.tolerance;
  summary["outline_tolerance_mm"] = 1e3 * settings.ablation.outline_tolerance;
  summary.update(ablation_report(settings, store, scaled, list));
  if (!scaled.empty()) print_ingredients("ingredient", summary["ingredients"]);
  if (!photographs.empty()) {
    summary["photographs"] = ablation_report(settings, store, photographs, list);
    print_ingredients("ingredient, photographs", summary["photographs"]["ingredients"]);
  }
  std::fflush(stdout);  // the script prints as well
  size_t draped = 0;
  for (const AblationSubject& subject : subjects)
    draped += store.load(item_name(subject, kFabricItem))["status"] == "converged";
  outcome.status = draped == subjects.size() ? "ok" : draped == 0 ? "failed" : "partial";
  write_text_durably(folder / "ablation.json", summary_text(summary));
  draw_figure("ablation.py", folder / "ablation.json", folder / "ablation");
  if (!photographs.empty())
    draw_figure("ablation_photographs.py", folder / "ablation.json", folder / "photographs");
  return outcome;
}

}  // namespace drape
