#include "experiments/interval_coverage.h"

#include <cmath>

#include "estimation/estimate.h"
#include "experiments/statistics.h"

namespace drape {

nlohmann::ordered_json interval_coverage(const std::vector<Record>& records,
                                         const std::vector<Parameter>& parameters,
                                         double deviations) {
  nlohmann::ordered_json shares;
  for (Parameter p : parameters) {
    const ParameterSpace space{{p}, {}};
    std::vector<double> covered;
    for (const Record& record : records) {
      if (!record.estimate || record.estimate->outcome != name(EstimateOutcome::succeeded))
        continue;
      const double miss = (space.encode(record.estimate->fabric) - space.encode(record.fabric))[0];
      covered.push_back(std::abs(miss) <=
                        deviations * record.estimate->log_sd[static_cast<int>(p)]);
    }
    shares[std::string(name(p))] = mean(covered);
  }
  return shares;
}

}  // namespace drape
