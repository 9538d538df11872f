#include "benchmarks/baselines/line_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace drape::baselines {
namespace {

constexpr double kDecrease = 1e-4;
constexpr double kRoundingSlack = 1e-13;  // of energies
constexpr double kWidening = 4;
constexpr int kMostEvaluations = 40;

struct End {
  double step, slope;
};

}  // namespace

LinePoint wolfe_point(const Potential& potential, const VecX& x, const VecX& d, double energy,
                      const VecX& gradient, double first, double flatness) {
  const double slope = gradient.dot(d);
  LinePoint point;
  if (!(slope < 0)) return point;
  const double noise = kRoundingSlack * std::abs(energy);
  End low{0, slope};
  std::optional<End> high;  // the minimum is below it
  double step = first;
  for (int i = 0; i < kMostEvaluations; ++i) {
    point.x = x + step * d;
    point.energy = potential.energy_and_gradient(point.x, point.gradient);
    const double here = point.gradient.dot(d);
    const bool low_enough = point.energy <= energy + noise;
    const bool decreased = point.energy <= energy + kDecrease * step * slope ||
                           (low_enough && here <= (2 * kDecrease - 1) * slope);
    if (decreased && std::abs(here) <= flatness * std::abs(slope)) {
      point.step = step;
      return point;
    }
    if (!(point.energy <= energy + noise) || !std::isfinite(here)) {
      high = End{step, -slope};  // no slope to trust: bisect
    } else if (here >= 0) {
      high = End{step, here};
    } else {
      low = {step, here};
    }
    if (!high) {
      step *= kWidening;
      continue;
    }
    const double width = high->step - low.step;
    const double secant = low.step + width * low.slope / (low.slope - high->slope);
    step = std::clamp(secant, low.step + 0.05 * width, high->step - 0.05 * width);
    if (width < 1e-14 * high->step) break;
  }
  // a decrease without the slope is still a step
  if (low.step > 0) {
    point.x = x + low.step * d;
    point.energy = potential.energy_and_gradient(point.x, point.gradient);
    point.step = low.step;
  }
  return point;
}

}  // namespace drape::baselines
