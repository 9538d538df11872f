#include "experiments/stability_report.h"

#include <algorithm>
#include <cstdio>

#include "benchmarks/baselines/methods.h"
#include "experiments/json_store.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

std::string short_number(double value, int digits = 6) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

void count(Json& axis, const std::string& value, bool converged) {
  Json& entry = axis[value];
  if (entry.is_null()) entry = {{"converged", 0}, {"cells", 0}};
  entry["converged"] = entry["converged"].get<int>() + converged;
  entry["cells"] = entry["cells"].get<int>() + 1;
}

/// Takes a value into the range [least, largest].
void widen(Json& range, double value) {
  if (range.is_null()) range = {value, value};
  range = {std::min(range[0].get<double>(), value), std::max(range[1].get<double>(), value)};
}

/// The values of all axes at which all (or none) of the cells converged, as "axis value, ...".
std::string values_where(const Json& axes, bool all) {
  std::string list;
  for (const auto& [axis, values] : axes.items())
    for (const auto& [value, entry] : values.items()) {
      if (entry["converged"] != (all ? entry["cells"] : Json(0))) continue;
      list += (list.empty() ? "" : ", ") + axis + " " + value;
    }
  return list.empty() ? "no value of an axis alone" : list;
}

}  // namespace

Json account_of_methods(const std::vector<Json>& cells) {
  Json all = Json::object();
  for (const baselines::Method& method : baselines::methods()) {
    Json row = {{"label", method.label}, {"outcomes", Json::object()}, {"axes", Json::object()}};
    for (const Json& cell : cells) {
      if (cell["method"] != method.name) continue;
      const auto outcome = cell["outcome"].get<std::string>();
      const bool converged = outcome == "converged";
      row["outcomes"][outcome] = row["outcomes"].value(outcome, 0) + 1;
      if (cell.contains("smallest_residual"))
        widen(row["smallest_residuals"][outcome], number(cell["smallest_residual"]));
      if (cell["case"] != "map") {
        count(row["axes"]["case"], cell["case"].get<std::string>(), converged);
      } else if (cell["time_step"].get<double>() > 0) {
        count(row["axes"]["time_step"], short_number(cell["time_step"].get<double>()), converged);
      } else {
        for (const char* axis : {"vertices", "membrane_to_bending", "areal_density"})
          count(row["axes"][axis], short_number(cell[axis].get<double>()), converged);
      }
    }
    if (!row["outcomes"].empty()) all[std::string(method.name)] = row;
  }
  return all;
}

std::string sentence(const std::string& method, const Json& account) {
  std::string text = method + ":";
  for (const auto& [outcome, cells] : account["outcomes"].items()) {
    text += " " + outcome + " " + std::to_string(cells.get<int>());
    if (outcome != "converged" && account.contains("smallest_residuals") &&
        account["smallest_residuals"].contains(outcome)) {
      const Json& range = account["smallest_residuals"][outcome];
      text += " (smallest residuals " + short_number(range[0], 2) + " to " +
              short_number(range[1], 2) + ")";
    }
    text += ";";
  }
  for (const auto& [axis, values] : account["axes"].items()) {
    text += "\n  converged by " + axis + ":";
    for (const auto& [value, entry] : values.items())
      text += " " + value + " " + std::to_string(entry["converged"].get<int>()) + "/" +
              std::to_string(entry["cells"].get<int>());
  }
  return text + "\n  always converged at " + values_where(account["axes"], true) + "; never at " +
         values_where(account["axes"], false) + "\n";
}

}  // namespace drape
