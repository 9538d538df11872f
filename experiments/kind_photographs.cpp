// kind = "photographs": fits of real drapes, and what the parameters of one picture say of another
// picture of the same fabric.
//
// Of every fabric a few captures are fitted one by one. From the first fit the others are
// predicted: with the branch taken from the picture, as a fit is (this flatters), and without it
// (branch_free_prediction.h).
#include <cmath>
#include <functional>
#include <iostream>
#include <map>

#include "core/durable_file.h"
#include "experiments/branch_free_prediction.h"
#include "experiments/config_names.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/photograph_study.h"
#include "experiments/progress.h"
#include "experiments/statistics.h"
#include "experiments/summary.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kStiffEnough = 55;  // drape coefficient above which fits are expected [percent]

/// One piece of work, kept under its name.
struct Item {
  std::string name;
  std::function<Json()> work;
};

/// Does what is not done yet. A picture that cannot be read or a fit that throws is kept as such.
void work_through(const Settings& settings, const JsonStore& store, const std::string& title,
                  const std::vector<Item>& items) {
  std::vector<const Item*> missing;
  for (const Item& item : items)
    if (!store.has(item.name)) missing.push_back(&item);
  const int total = static_cast<int>(items.size()), left = static_cast<int>(missing.size());
  Progress progress(title, total, total - left);
  for_each_item(left, settings.experiment.thread_count(), [&](int i) {
    const Item& item = *missing[static_cast<size_t>(i)];
    Json result;
    try {
      result = item.work();
    } catch (const std::exception& error) {
      result = {{"outcome", "failed"}, {"message", error.what()}};
    }
    store.save(item.name, result);
    if (result.contains("outcome") && result["outcome"] != "succeeded")
      progress.note(item.name + ": " + result["outcome"].get<std::string>());
    progress.advance();
  });
}

std::string fit_name(const Capture& capture, PhotographModel model) {
  return capture.name() + "_" + to_name(model);
}

bool is_fit(const Json& item) { return item.contains("parameters"); }
bool is_free(const Json& item) { return is_fit(item) && item["free"] && item["certified"]; }
bool has_nodes_within_one(const Json& item) {
  return std::abs(item["node_count"].get<int>() - item["seen"]["node_count"].get<int>()) <= 1;
}
double error_of_drape_coefficient(const Json& item) {
  return number(item["drape_coefficient_percent"]) -
         number(item["seen"]["drape_coefficient_percent"]);
}

/// How well a set of fits or predictions succeeded.
Json account(const std::vector<Json>& items) {
  std::vector<double> rms, iou, error, cpu;
  int free = 0, free_with_nodes = 0, succeeded = 0;
  Json failures = Json::object();
  for (const Json& item : items) {
    if (is_fit(item)) cpu.push_back(number(item["cpu_seconds"]));
    const std::string outcome = item["outcome"];
    if (outcome == "succeeded")
      ++succeeded;
    else
      failures[outcome] = failures.value(outcome, 0) + 1;
    if (!is_free(item)) continue;
    ++free;
    free_with_nodes += has_nodes_within_one(item);
    rms.push_back(number(item["outline_rms_mm"]));
    iou.push_back(number(item["iou"]));
    error.push_back(std::abs(error_of_drape_coefficient(item)));
  }
  return {{"pictures", items.size()},
          {"free_and_certified", free},
          {"within_one_node", free_with_nodes},
          {"succeeded", succeeded},
          {"failures", failures},
          {"outline_rms_mm_median", median(rms)},
          {"iou_median", median(iou)},
          {"drape_coefficient_error_median", median(error)},
          {"cpu_seconds_median", median(cpu)}};
}

/// Standard deviation over the fits of one fabric of ln(mean k_b) and of the logarithms of B.
Json scatter_over_captures(const std::vector<Json>& fits) {
  std::vector<double> mean_k;
  std::vector<std::vector<double>> rigidity(3);
  for (const Json& fit : fits) {
    if (!is_free(fit)) continue;
    const Json& p = fit["parameters"];
    mean_k.push_back(std::log((number(p["k_bu"]) + number(p["k_bv"]) + number(p["k_bh"])) / 3));
    for (size_t i = 0; i < 3; ++i) rigidity[i].push_back(std::log(number(fit["rigidity"][i])));
  }
  return {{"fits", mean_k.size()},
          {"ln_mean_k_b_sd", standard_deviation(mean_k)},
          {"ln_B_u_sd", standard_deviation(rigidity[0])},
          {"ln_B_v_sd", standard_deviation(rigidity[1])},
          {"ln_B_45_sd", standard_deviation(rigidity[2])}};
}

Json all_seen(const Settings& settings, const std::vector<Capture>& captures) {
  Json seen = {{"drape_coefficients", Json::array()}, {"node_counts", Json::array()}};
  Json unread = Json::array();
  for (const Capture& capture : captures) try {
      const Json one = seen_in(
          settings,
          read_photograph(capture.file, 1e-3 * settings.photograph.mm_per_pixel, settings.scene));
      seen["drape_coefficients"].push_back(one["drape_coefficient_percent"]);
      seen["node_counts"].push_back(one["node_count"]);
    } catch (const PhotographError& error) {
      unread.push_back(error.what());
    }
  seen["unread"] = unread;
  return seen;
}

std::vector<double> numbers(const Json& list) {
  std::vector<double> values;
  for (const Json& value : list) values.push_back(number(value));
  return values;
}

void print_row(const std::string& label, const Json& row) {
  std::printf("%-34s %8d %6d %10d %9.2f %7.3f %9.2f %8.1f\n", label.c_str(),
              row["pictures"].get<int>(), row["free_and_certified"].get<int>(),
              row["within_one_node"].get<int>(), number(row["outline_rms_mm_median"]),
              number(row["iou_median"]), number(row["drape_coefficient_error_median"]),
              number(row["cpu_seconds_median"]));
}

void print_without_branch(const Json& summary) {
  const auto print = [](const std::string& label, const Json& row) {
    std::printf("branch not given, %-17s %8d %27.1f nodes %18.2f\n", label.c_str(),
                row["fabrics"].get<int>(), number(row["node_bias_median"]),
                number(row["drape_coefficient_error_median"]));
  };
  for (const auto& [protocol, row] : summary["by_protocol"].items()) print(protocol, row);
  print("best on others", summary);
  std::printf("photographs of one fabric scatter by %.2f points (median sd)\n",
              number(summary["drape_coefficient_sd_of_photographs_median"]));
}

/// The fabrics' fits and predictions, gathered for summary and figure.
Json summarise(const Settings& settings, const std::vector<FabricCaptures>& fabrics,
               const JsonStore& fits, const JsonStore& predictions, const JsonStore& protocols) {
  Json summary;
  std::map<std::string, std::vector<Json>> groups, changes;
  std::vector<DrapedByProtocols> draped;
  for (const FabricCaptures& f : fabrics) {
    Json row = {{"fabric", f.fabric},
                {"areal_density", areal_density_of(settings, f.fabric)},
                {"photographs", all_seen(settings, f.all)}};
    for (const PhotographModel model : settings.photographs.models) {
      std::vector<Json> own;
      for (const Capture& capture : f.chosen) {
        own.push_back(fits.load(fit_name(capture, model)));
        own.back()["capture"] = capture.name();
        const std::string label = to_name(model);
        const bool known = is_fit(own.back());
        const bool stiff =
            known && number(own.back()["seen"]["drape_coefficient_percent"]) > kStiffEnough;
        groups[label + (!known  ? ", unread"
                        : stiff ? ", DC above 55"
                                : ", DC below 55")]
            .push_back(own.back());
      }
      row["fits"][to_name(model)] = own;
      row["scatter"][to_name(model)] = scatter_over_captures(own);
    }
    for (size_t i = 1; i < f.chosen.size(); ++i) {
      if (!predictions.has(f.chosen[i].name())) continue;
      Json predicted = predictions.load(f.chosen[i].name());
      const std::string change(name(change_between(f.chosen.front(), f.chosen[i])));
      predicted["capture"] = f.chosen[i].name();
      predicted["change"] = change;
      changes["branch given, other " + change].push_back(predicted);
      row["predictions"].push_back(predicted);
    }
    const std::string item = f.chosen.front().name();
    draped.push_back({protocols.has(item) ? protocols.load(item)["drapes"] : Json::array(),
                      numbers(row["photographs"]["drape_coefficients"]),
                      numbers(row["photographs"]["node_counts"])});
    summary["fabrics"].push_back(row);
  }
  std::printf("%-34s %8s %6s %10s %9s %7s %9s %8s\n", "", "pictures", "free", "+-1 node", "rms mm",
              "IoU", "DC error", "CPU s");
  for (const auto& [label, items] : groups)
    print_row(label, summary["fits"][label] = account(items));
  for (const auto& [label, items] : changes)
    print_row(label, summary["predictions"][label] = account(items));
  const BranchFreePredictions free = predict_without_branch(draped);
  for (size_t i = 0; i < draped.size(); ++i)
    if (!free.fabrics[i].is_null()) summary["fabrics"][i]["without_branch"] = free.fabrics[i];
  summary["without_branch"] = free.summary;
  print_without_branch(free.summary);
  return summary;
}

}  // namespace

RunOutcome run_photographs(const Settings& settings, OutputFolder& folder) {
  if (!std::filesystem::is_directory(settings.photographs.folder)) {
    const std::string reason = "photographs.folder " + settings.photographs.folder.string() +
                               " is not there: nothing to fit";
    std::cout << reason << "\n";
    return {"ok", {{"skipped", reason}}};
  }
  const std::vector<FabricCaptures> fabrics = captures_by_fabric(settings);
  const auto discretization = make_discretization(settings);
  const JsonStore fits(folder, "fits"), predictions(folder, "predictions"),
      protocols(folder, "protocols");

  std::vector<Item> work;
  for (const FabricCaptures& f : fabrics)
    for (const PhotographModel model : settings.photographs.models)
      for (const Capture& capture : f.chosen)
        work.push_back({fit_name(capture, model), [&, model] {
                          return fit_capture(with_model(settings, model), discretization, capture);
                        }});
  work_through(settings, fits, "fits", work);
  if (interrupted()) return {"partial", {}};

  // predictions with the first model, from the first capture
  const PhotographModel model = settings.photographs.models.front();
  const Settings modelled = with_model(settings, model);
  std::vector<Item> predicted, draped;
  for (const FabricCaptures& f : fabrics) {
    const Json fit = fits.load(fit_name(f.chosen.front(), model));
    if (!is_free(fit)) continue;
    for (size_t i = 1; i < f.chosen.size(); ++i)
      predicted.push_back({f.chosen[i].name(), [&, i, fit] {
                             return predict_capture(modelled, discretization, f.chosen[i], fit);
                           }});
    draped.push_back({f.chosen.front().name(),
                      [&, fit] { return drape_by_protocols(modelled, discretization, fit); }});
  }
  work_through(settings, predictions, "predictions", predicted);
  if (interrupted()) return {"partial", {}};
  work_through(settings, protocols, "protocols", draped);
  if (interrupted()) return {"partial", {}};

  RunOutcome outcome{"ok", summarise(settings, fabrics, fits, predictions, protocols)};
  write_text_durably(folder / "photographs.json", summary_text(outcome.summary));
  draw_figure("photographs.py", folder / "photographs.json", folder / "photographs");
  return outcome;
}

}  // namespace drape
