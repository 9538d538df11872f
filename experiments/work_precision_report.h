// What the runs of a work-precision study come to: median curves of error against CPU time, and the
// CPU time that each method needs to get within a tolerance for good.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/statistics.h"

namespace drape {

/// One method in one panel of a chart: its runs on other meshes of the same size.
struct ComparedRuns {
  std::string method, label;
  std::vector<nlohmann::ordered_json> runs;  ///< as kept by the kind, see kind_work_precision.cpp
};

/// The first CPU time from which on the run's error (an array of its trace) stays within the
/// tolerance [s]; infinite if it does not end there.
double time_within(const nlohmann::ordered_json& run, const std::string& error, double tolerance);

/// Median error of the runs at geometrically spaced CPU times up to `budget`, and the percentiles
/// `low` and 100 - `low`; a run that has ended keeps its last error. Arrays cpu_seconds, median,
/// low, high, and outcomes, one a run.
nlohmann::ordered_json error_curve(const ComparedRuns& compared, const std::string& error,
                                   double budget, double low = 0);

/// Tolerances of the tables, largest first.
const std::vector<double>& tolerances(const std::string& error);

/// Outcomes, residuals, share of runs that ended in the basin of core's own, and median CPU times
/// to the tolerances of "residual" and "rms_mm" (null: less than half of the runs got there).
nlohmann::ordered_json account(const ComparedRuns& compared);

/// Of accounts by method: per tolerance that the start does not meet, the cheapest method, its CPU
/// time, and core's over that.
nlohmann::ordered_json cheapest(const nlohmann::ordered_json& accounts);

}  // namespace drape
