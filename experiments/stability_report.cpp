#include "experiments/stability_report.h"

#include <cstdio>

#include "benchmarks/baselines/methods.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

void count(Json& axis, const std::string& value, bool converged) {
  Json& entry = axis[value];
  if (entry.is_null()) entry = {{"converged", 0}, {"cells", 0}};
  entry["converged"] = entry["converged"].get<int>() + converged;
  entry["cells"] = entry["cells"].get<int>() + 1;
}

}  // namespace

Json account_of_methods(const std::vector<Json>& cells) {
  Json all = Json::object();
  for (const baselines::Method& method : baselines::methods()) {
    Json row = {{"label", method.label}, {"limit", method.limit}, {"outcomes", Json::object()}};
    for (const Json& cell : cells) {
      if (cell["method"] != method.name) continue;
      const auto outcome = cell["outcome"].get<std::string>();
      const bool converged = outcome == "converged";
      row["outcomes"][outcome] = row["outcomes"].value(outcome, 0) + 1;
      if (cell["case"] != "map") {
        count(row["case"], cell["case"].get<std::string>(), converged);
      } else if (cell["time_step"].get<double>() > 0) {
        count(row["time_step"], short_number(cell["time_step"].get<double>()), converged);
      } else {
        for (const char* axis : {"vertices", "membrane_to_bending", "areal_density"})
          count(row[axis], short_number(cell[axis].get<double>()), converged);
      }
    }
    if (!row["outcomes"].empty()) all[std::string(method.name)] = row;
  }
  return all;
}

std::string sentence(const std::string& method, const Json& account) {
  std::string text = method + ":";
  for (const auto& [outcome, cells] : account["outcomes"].items())
    text += " " + outcome + " " + std::to_string(cells.get<int>()) + ";";
  for (const auto& [axis, values] : account.items()) {
    if (axis == "label" || axis == "limit" || axis == "outcomes") continue;
    text += "\n  converged by " + axis + ":";
    for (const auto& [value, entry] : values.items())
      text += " " + value + " " + std::to_string(entry["converged"].get<int>()) + "/" +
              std::to_string(entry["cells"].get<int>());
  }
  return text + "\n  " + account["limit"].get<std::string>() + "\n";
}

}  // namespace drape
