#include "experiments/work_precision_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "experiments/json_store.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kFirstTime = 1e-3, kTimeSpacing = 1.15;  // of curves [s]
constexpr const char* kErrors[] = {"residual", "rms_mm"};

double error_at(const Json& run, const std::string& error, double time) {
  const Json& times = run["trace"]["cpu_seconds"];
  size_t i = 0;
  while (i + 1 < times.size() && times[i + 1].get<double>() <= time) ++i;
  return number(run["trace"][error][i]);
}

/// The middle one; of two the worse, so that half of the runs got there at least.
double upper_median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::infinity();
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

double time_within(const Json& run, const std::string& error, double tolerance) {
  const Json& times = run["trace"]["cpu_seconds"];
  const Json& errors = run["trace"][error];
  double since = std::numeric_limits<double>::infinity();
  if (run["outcome"] == "diverged") return since;
  for (size_t i = times.size(); i-- > 0 && number(errors[i]) <= tolerance;)
    since = times[i].get<double>();
  return since;
}

Json error_curve(const ComparedRuns& compared, const std::string& error, double budget,
                 double low) {
  Json curve = {{"method", compared.method}, {"label", compared.label}};
  for (const char* name : {"cpu_seconds", "median", "low", "high"}) curve[name] = Json::array();
  curve["outcomes"] = Json::array();
  for (const Json& run : compared.runs) curve["outcomes"].push_back(run["outcome"]);
  double longest = 0;
  for (const Json& run : compared.runs)
    longest = std::max(longest, run["trace"]["cpu_seconds"].back().get<double>());
  for (double time = kFirstTime;; time *= kTimeSpacing) {
    time = std::min({time, longest, budget});
    std::vector<double> errors;
    for (const Json& run : compared.runs) errors.push_back(error_at(run, error, time));
    curve["cpu_seconds"].push_back(time);
    curve["median"].push_back(median(errors));
    curve["low"].push_back(percentile(errors, low));
    curve["high"].push_back(percentile(errors, 100 - low));
    if (time >= std::min(longest, budget)) return curve;
  }
}

const std::vector<double>& tolerances(const std::string& error) {
  static const std::vector<double> residual{1, 1e-2, 1e-4, 1e-6, 1e-8}, rms{10, 1, 0.1, 1e-2, 1e-4};
  return error == "residual" ? residual : rms;
}

Json account(const ComparedRuns& compared) {
  std::map<std::string, int> outcomes;
  std::vector<double> residuals, smallest, cpu;
  double same = 0;
  for (const Json& run : compared.runs) {
    ++outcomes[run["outcome"].get<std::string>()];
    residuals.push_back(number(run["trace"]["residual"].back()));
    smallest.push_back(number(run["smallest_residual"]));
    cpu.push_back(run["trace"]["cpu_seconds"].back().get<double>());
    same += run["same_minimum_as_core"].get<bool>();
  }
  Json row = {{"runs", compared.runs.size()},
              {"outcomes", outcomes},
              {"residual_median", median(residuals)},
              {"smallest_residual_median", median(smallest)},
              {"cpu_seconds_median", median(cpu)},
              {"same_minimum_as_core_share", same / static_cast<double>(compared.runs.size())}};
  for (const std::string error : kErrors) {
    Json times = Json::array();
    for (const double tolerance : tolerances(error)) {
      std::vector<double> reached;
      for (const Json& run : compared.runs) reached.push_back(time_within(run, error, tolerance));
      times.push_back({{"tolerance", tolerance}, {"cpu_seconds", upper_median(reached)}});
    }
    row["time_to_" + error] = times;
  }
  return row;
}

Json cheapest(const Json& accounts) {
  Json rows = Json::array();
  for (const std::string error : kErrors)
    for (size_t i = 0; i < tolerances(error).size(); ++i) {
      std::string best;
      double least = std::numeric_limits<double>::infinity(), core = least;
      for (const auto& [method, row] : accounts.items()) {
        const double time = row["time_to_" + error][i]["cpu_seconds"].get<double>();
        if (method == "core") core = time;
        if (time < least) {
          least = time;
          best = method;
        }
      }
      if (least == 0) continue;
      rows.push_back({{"error", error},
                      {"tolerance", tolerances(error)[i]},
                      {"method", best},
                      {"cpu_seconds", least},
                      {"core_over_cheapest", core / least}});
    }
  return rows;
}

}  // namespace drape
