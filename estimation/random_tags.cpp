#include "estimation/random_tags.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "core/random.h"
#include "estimation/fabric_types.h"
#include "estimation/fibre_affinity.h"
#include "estimation/fibre_kinds.h"

namespace drape {
namespace {

constexpr double kTenthBelow = 1.2816;  // standard deviations of a normal

/// Fibres of one fabric as indices of fibre_kinds(), the main one first.
using Blend = std::vector<int>;

template <class T>
void shuffle(std::vector<T>& values, Random& random) {
  for (size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1],
              values[static_cast<size_t>(random.uniform() * static_cast<double>(i))]);
}

/// Assumed, about what the source's twenty printed blends show: every further fibre of a blend is
/// half as likely as the one before.
double openness(const Blend& blend) { return std::pow(2, 1 - static_cast<double>(blend.size())); }

/// Fibres by number of mentions, the rarest first.
std::vector<int> rarest_first(const std::vector<int>& mentions) {
  std::vector<int> order(mentions.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return mentions[static_cast<size_t>(a)] < mentions[static_cast<size_t>(b)];
  });
  return order;
}

class Mixer {
 public:
  /// `types`: of every fabric, as indices of fabric_types().
  Mixer(const std::vector<size_t>& types, Random& random)
      : types_(types), blends_(types.size()), random_(random) {}

  /// Adds the fibre to `count` fabrics that may take it: those without any fibre, or those that
  /// have others. Drawn without replacement (Efraimidis and Spirakis 2006): the smallest of
  /// -log(u)/weight.
  void add(int fibre, int count, bool as_main) {
    if (count == 0) return;
    std::vector<double> affinity;
    for (const FabricType& type : fabric_types())
      affinity.push_back(fibre_affinity(type, fibre_kinds()[static_cast<size_t>(fibre)]));
    std::vector<std::pair<double, size_t>> keys;
    for (size_t i = 0; i < blends_.size(); ++i) {
      const Blend& blend = blends_[i];
      if (as_main ? !blend.empty() : std::find(blend.begin(), blend.end(), fibre) != blend.end())
        continue;
      const double weight = affinity[types_[i]] * (as_main ? 1 : openness(blend));
      keys.emplace_back(-std::log1p(-random_.uniform()) / weight, i);
    }
    const auto end = keys.begin() + count;
    std::nth_element(keys.begin(), end - 1, keys.end());
    for (auto key = keys.begin(); key != end; ++key) blends_[key->second].push_back(fibre);
  }

  const Blend& blend(size_t fabric) const { return blends_[fabric]; }

 private:
  const std::vector<size_t>& types_;
  std::vector<Blend> blends_;
  Random& random_;
};

int whole_percent(double value, int most) {
  return std::clamp(static_cast<int>(std::lround(value)), 1, most);
}

/// Whole percentages. Assumed, about what the source prints: elastane 2 to 15 %, metal 5 to 20 %,
/// and all other companions together 8 to 45 %.
std::vector<Fibre> composition(const Blend& blend, Random& random) {
  std::vector<Fibre> fibres;
  for (const int fibre : blend)
    fibres.push_back({std::string(fibre_kinds()[static_cast<size_t>(fibre)].name), 0});
  const auto is_accent = [](const Fibre& fibre) {
    return fibre.name == kElastane || fibre.name == "Metallic" || fibre.name == "Aluminium";
  };
  const auto others = std::count_if(fibres.begin() + 1, fibres.end(),
                                    [&](const Fibre& f) { return !is_accent(f); });
  int left = 100;
  for (size_t i = 1; i < fibres.size(); ++i) {
    const int percent =
        is_accent(fibres[i])
            ? whole_percent((fibres[i].name == kElastane ? 5 : 9) * std::exp(0.6 * random.normal()),
                            20)
            : whole_percent(random.uniform(8, 45) / static_cast<double>(others), 45);
    fibres[i].percent = percent;
    left -= percent;
  }
  fibres[0].percent = left;
  return fibres;
}

/// Log-normal, to the gram.
double areal_density(const FabricType& type, Random& random) {
  const double sd = std::log(type.heavy / type.light) / (2 * kTenthBelow);
  const double drawn = std::sqrt(type.light * type.heavy) * std::exp(sd * random.normal());
  return 1e-3 * std::max(15.0, std::round(1e3 * drawn));
}

}  // namespace

std::vector<int> apportion(int total, std::span<const double> weights,
                           std::span<const int> limits) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<int> given(weights.size(), 0);
  // One by one to whoever is furthest from his quota: first all whole parts, then the largest
  // remainders.
  for (int i = 0; i < total; ++i) {
    size_t next = weights.size();
    double furthest = 0;
    for (size_t j = 0; j < weights.size(); ++j) {
      if (!limits.empty() && given[j] >= limits[j]) continue;
      const double missing = total * weights[j] / sum - given[j];
      if (next < weights.size() && missing <= furthest) continue;
      next = j;
      furthest = missing;
    }
    if (next == weights.size())
      throw std::invalid_argument("apportion: the limits hold less than " + std::to_string(total));
    ++given[next];
  }
  return given;
}

std::vector<Tag> random_tags(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> weights;
  for (const FabricType& type : fabric_types()) weights.push_back(type.fabrics);
  const std::vector<int> of_type = apportion(count, weights);
  std::vector<size_t> types;
  for (size_t t = 0; t < of_type.size(); ++t)
    types.insert(types.end(), static_cast<size_t>(of_type[t]), t);
  shuffle(types, random);

  weights.clear();
  for (const FibreKind& kind : fibre_kinds()) weights.push_back(kind.fabrics);
  const auto all_mentions =
      static_cast<int>(std::lround(static_cast<double>(count) * kTableMentions / kTableFabrics));
  const std::vector<int> at_most(weights.size(), count);
  const std::vector<int> mentions = apportion(all_mentions, weights, at_most);
  weights.clear();
  for (const FibreKind& kind : fibre_kinds()) weights.push_back(kind.fabrics * kind.main_share);
  const std::vector<int> as_main = apportion(count, weights, mentions);

  Mixer mixer(types, random);
  for (const bool main : {true, false})
    for (const int fibre : rarest_first(mentions)) {
      const auto f = static_cast<size_t>(fibre);
      mixer.add(fibre, main ? as_main[f] : mentions[f] - as_main[f], main);
    }

  std::vector<Tag> tags;
  for (size_t i = 0; i < types.size(); ++i) {
    const FabricType& type = fabric_types()[types[i]];
    tags.push_back({std::to_string(i), std::string(type.category), std::string(type.subcategory),
                    std::string(type.name), composition(mixer.blend(i), random),
                    areal_density(type, random)});
  }
  return tags;
}

}  // namespace drape
