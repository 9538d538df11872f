// Mean, spread and percentiles of a few values.
#pragma once

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace drape {

/// NaN of nothing.
double mean(const std::vector<double>& values);

/// Of a sample; NaN for fewer than two values.
double standard_deviation(const std::vector<double>& values);

/// Linear between ranks, percent in [0, 100]; NaN values are left out, NaN if none is left.
double percentile(std::vector<double> values, double percent);
inline double median(std::vector<double> values) { return percentile(std::move(values), 50); }

/// {"50": .., "95": .., "100": ..}
nlohmann::ordered_json percentiles(const std::vector<double>& values);

}  // namespace drape
