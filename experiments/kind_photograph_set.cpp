// kind = "photograph_set": the photographs of many fabrics, as a table names them; every fabric is
// a run of kind "photograph" in a subfolder of its own.
#include <cmath>
#include <iostream>
#include <sstream>

#include "core/durable_file.h"
#include "experiments/interrupt.h"
#include "experiments/parallel_items.h"
#include "experiments/photograph_fit.h"
#include "experiments/progress.h"
#include "experiments/run_part.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

/// A fit that throws is kept as such, and is tried again by the next run of the same command.
Json fit(const Settings& settings, const std::string& id, const OutputFolder& folder) {
  try {
    return run_part(id, run_photograph, Kind::photograph, settings, folder);
  } catch (const std::exception& error) {
    return {{"status", "failed"}, {"outcome", "failed"}, {"message", error.what()}};
  }
}

/// One line a fabric: how its fit ended, and the parameters with the standard deviations of their
/// logarithms.
std::string table_of(const std::vector<PhotographedFabric>& fabrics, const std::vector<Json>& fits,
                     const std::vector<Parameter>& parameters) {
  std::ostringstream text;
  text << "id,outcome,outline_rms_mm,iou";
  for (const Parameter p : all_parameters()) text << ',' << name(p);
  for (const Parameter p : parameters) text << ",log_sd_" << name(p);
  text << '\n';
  for (size_t i = 0; i < fabrics.size(); ++i) {
    const Json& fit = fits[i];
    const auto cell = [&](const char* group, const std::string& key) {
      text << ',';
      if (fit.contains(group) && fit[group].contains(key)) text << fit[group][key].dump();
    };
    text << fabrics[i].id << ',' << fit["outcome"].get<std::string>();
    for (const char* key : {"outline_rms_mm", "iou"})
      text << ',' << (fit.contains(key) ? fit[key].dump() : "");
    for (const Parameter p : all_parameters()) cell("parameters", std::string(name(p)));
    for (const Parameter p : parameters) cell("log_sd", std::string(name(p)));
    text << '\n';
  }
  return text.str();
}

}  // namespace

RunOutcome run_photograph_set(const Settings& settings, OutputFolder& folder) {
  const std::vector<PhotographedFabric> fabrics =
      read_photograph_manifest(settings.photograph_set.manifest);
  const int count = static_cast<int>(fabrics.size());
  std::vector<Json> fits(fabrics.size());
  {
    Progress progress("photographs", count);
    for_each_item(count, settings.experiment.thread_count(), [&](int i) {
      const PhotographedFabric& fabric = fabrics[static_cast<size_t>(i)];
      Json& one = fits[static_cast<size_t>(i)];
      one = fit(with_photographs(settings, fabric), fabric.id, folder);
      if (one["status"] != "ok" && one.contains("outcome"))
        progress.note(fabric.id + ": " + one["outcome"].get<std::string>());
      progress.advance();
    });
  }
  if (interrupted()) return {"partial", {}};

  Json summary = {{"fabrics", count}, {"succeeded", 0}, {"fits", Json::object()}};
  int succeeded = 0;
  for (size_t i = 0; i < fabrics.size(); ++i) {
    succeeded += fits[i]["outcome"] == "succeeded";
    summary["fits"][fabrics[i].id] = fits[i];
  }
  summary["succeeded"] = succeeded;
  write_text_durably(folder / "parameters.csv",
                     table_of(fabrics, fits, settings.estimate.parameters));
  std::cout << succeeded << " of " << count
            << " fabrics fitted: " << (folder / "parameters.csv").string() << "\n";
  return {succeeded == count ? "ok" : succeeded > 0 ? "partial" : "failed", std::move(summary)};
}

}  // namespace drape
