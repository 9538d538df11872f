#include "experiments/stability_report.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "benchmarks/baselines/methods.h"
#include "experiments/json_store.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

/// As short as in a text: 1e4, 2.5e-6.
std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  std::string number = text;
  if (const size_t e = number.find('e'); e != std::string::npos) {
    const bool negative = number[e + 1] == '-';
    const size_t first = std::min(number.find_first_not_of('0', e + 2), number.size() - 1);
    number = number.substr(0, e + 1) + (negative ? "-" : "") + number.substr(first);
  }
  return number;
}

/// To two digits.
std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", value);
  return short_number(std::stod(text));
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

/// "by vertices 3/4 at 250, 0/4 at 500; by ..."
std::string by_axes(const Json& axes) {
  static constexpr std::pair<const char*, const char*> kWords[]{
      {"vertices", "vertices"},
      {"membrane_to_bending", "membrane over bending"},
      {"areal_density", "density [kg/m²]"},
      {"time_step", "time step given [s]"}};
  std::string text;
  for (const auto& [axis, words] : kWords) {
    if (!axes.contains(axis)) continue;
    text += (text.empty() ? "By " : "; by ") + std::string(words);
    const char* separator = " ";
    for (const auto& [value, entry] : axes[axis].items()) {
      text += separator + entry["converged"].dump() + "/" + entry["cells"].dump() + " at " + value;
      separator = ", ";
    }
  }
  return text.empty() ? text : " " + text + ".";
}

/// The hard cases that were reached (or not).
std::string cases_where(const Json& axes, bool converged) {
  std::string list;
  if (!axes.contains("case")) return list;
  for (const auto& [name, entry] : axes["case"].items())
    if ((entry["converged"] == entry["cells"]) == converged) {
      list += (list.empty() ? "" : ", ") + name;
    }
  std::replace(list.begin(), list.end(), '_', ' ');
  return list;
}

/// The outcomes but convergence, with the smallest residuals of their cells.
std::string failures(const Json& account) {
  std::string list;
  for (const auto& [outcome, cells] : account["outcomes"].items()) {
    if (outcome == "converged") continue;
    list += (list.empty() ? "" : ", ") + cells.dump() + " " + outcome;
    if (!account.contains("smallest_residuals") || !account["smallest_residuals"].contains(outcome))
      continue;
    const Json& range = account["smallest_residuals"][outcome];
    const std::string least = rounded(range[0]), most = rounded(range[1]);
    list += " (smallest residual " + (least == most ? least : least + " to " + most) + ")";
  }
  std::replace(list.begin(), list.end(), '_', ' ');
  return list;
}

std::string in_words(const Json& account, int converged, int cells) {
  if (converged == cells) return "Converged in all of " + std::to_string(cells) + " runs.";
  if (converged == 0)
    return "Converged in none of " + std::to_string(cells) + " runs: " + failures(account) + ".";
  const Json& axes = account["axes"];
  std::string text = "Converged in " + std::to_string(converged) + " of " + std::to_string(cells) +
                     " runs." + by_axes(axes);
  const std::string reached = cases_where(axes, true), missed = cases_where(axes, false);
  if (!reached.empty()) text += " Hard cases reached: " + reached + ".";
  if (!missed.empty()) text += " Hard cases missed: " + missed + ".";
  return text + " The others: " + failures(account) + ".";
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
      if (cell.contains("smallest_residual") && !cell["smallest_residual"].is_null())
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
    int total = 0;
    for (const Json& number_of_cells : row["outcomes"]) total += number_of_cells.get<int>();
    if (total == 0) continue;
    const int converged = row["outcomes"].value("converged", 0);
    row["measured"] = in_words(row, converged, total);
    row["limits"] = converged < total ? method.limits : "";
    all[std::string(method.name)] = row;
  }
  return all;
}

std::string paragraph(const Json& account) {
  const auto words = [&](const char* part) { return account[part].get<std::string>(); };
  return words("label") + ": " + words("measured") +
         (words("limits").empty() ? "" : " " + words("limits"));
}

}  // namespace drape
