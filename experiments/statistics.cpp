#include "experiments/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drape {

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double standard_deviation(const std::vector<double>& values) {
  if (values.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  const double m = mean(values);
  double sum = 0;
  for (const double value : values) sum += std::pow(value - m, 2);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double percentile(std::vector<double> values, double percent) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double rank = percent / 100 * static_cast<double>(values.size() - 1);
  const auto below = static_cast<size_t>(rank);
  const size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (rank - std::floor(rank)) * (values[above] - values[below]);
}

nlohmann::ordered_json percentiles(const std::vector<double>& values) {
  return {{"50", percentile(values, 50)},
          {"95", percentile(values, 95)},
          {"100", percentile(values, 100)}};
}

}  // namespace drape
