#include "estimation/fibre_affinity.h"

#include <array>

namespace drape {
namespace {

constexpr std::string_view kAny = "";

struct Rule {
  std::string_view fibre;  ///< kAny: all
  std::string_view where;  ///< a category or a type
  double weight;
};

// Assumed throughout: common trade knowledge of what denim, tweed or a puffer shell is made of. Of
// several rules that match, the last one counts; without one the weight is 1.
constexpr std::array kRules = std::to_array<Rule>({
    {kAny, "Non-fabric", 1e-4},
    {kAny, "Animal alternatives", 0.02},
    {"Polyester", "Animal alternatives", 3},
    {"Polyester", "Non-fabric", 3},
    {"Acrylic", "Vegan fur", 10},
    {"Viscose rayon", "Vegan leather", 1},
    {"Cotton", "Vegan leather", 0.2},
    {"Cork", "Vegan leather", 1e4},
    {"TPU", kAny, 1e-3},
    {"TPU", "Vegan leather", 1},
    {"TPU", "PVC", 3},
    {"EVA", kAny, 1e-3},
    {"EVA", "PVC", 3},
    {"EVA", "Vegan leather", 1},
    {"PVC", kAny, 1e-4},
    {"PVC", "PVC", 100},
    {"PVC", "Vegan leather", 1},
    {"PE", kAny, 0.01},
    {"PE", "Tyvek", 1e4},
    {"PE", "Ripstop", 1},
    {"PE", "Mesh / Tulle", 0.3},

    {"Cotton", "Woven", 1},
    {"Cotton", "Cut & Sew knit", 0.8},
    {"Cotton", "Lace", 0.2},
    {"Cotton", "Mesh / Tulle", 0.1},
    {"Cotton", "Tricot", 0.1},
    {"Cotton", "Velvet", 0.3},
    {"Cotton", "Denim", 20},
    {"Cotton", "Corduroy", 8},
    {"Cotton", "Canvas", 8},
    {"Cotton", "Chambray / Oxford", 8},
    {"Cotton", "Poplin", 6},
    {"Cotton", "Gauze / Double gauze", 6},
    {"Cotton", "Eyelet", 6},
    {"Cotton", "Seersucker", 5},
    {"Cotton", "Flannel", 4},
    {"Cotton", "Voile", 3},
    {"Cotton", "Plaid", 2},
    {"Cotton", "French terry", 5},
    {"Cotton", "Loop terry", 5},
    {"Cotton", "Pique", 3},
    {"Cotton", "Waffle", 3},
    {"Cotton", "Jersey", 2},
    {"Cotton", "Rib", 2},
    {"Cotton", "Crochet", 1},
    {"Cotton", "Chiffon", 0.02},
    {"Cotton", "Organza", 0.05},
    {"Cotton", "Georgette", 0.02},
    {"Cotton", "Crepe / CDC", 0.1},
    {"Cotton", "Dewspo", 0.005},
    {"Cotton", "Memory", 0.1},
    {"Cotton", "Taffeta", 0.1},
    {"Cotton", "Satin", 0.3},
    {"Cotton", "Melton / Boiled", 0.05},
    {"Cotton", "Tweed", 0.2},
    {"Cotton", "TRS", 0.01},
    {"Cotton", "Polar fleece", 0.05},
    {"Cotton", "Neoprene / Scuba", 0.05},

    {"Wool", kAny, 0.03},
    {"Wool", "Melton / Boiled", 20},
    {"Wool", "Tweed", 10},
    {"Wool", "Boucle", 8},
    {"Wool", "Plaid", 2},
    {"Wool", "Flannel", 2},
    {"Wool", "Twill", 1},
    {"Wool", "Double weave", 1},
    {"Wool", "Low gauge knit", 2},
    {"Wool", "Jacquard knit", 0.5},
    {"Wool", "Jersey", 0.3},
    {"Acrylic", "Woven", 0.1},
    {"Acrylic", "Tweed", 5},
    {"Acrylic", "Boucle", 5},
    {"Acrylic", "Melton / Boiled", 2},
    {"Acrylic", "Low gauge knit", 5},
    {"Acrylic", "Sherpa", 2},

    {"Linen", "Cut & Sew knit", 0.1},
    {"Linen", "Plain", 4},
    {"Linen", "Canvas", 2},
    {"Linen", "Twill", 2},
    {"Linen", "Dobby", 2},
    {"Silk", kAny, 0.1},
    {"Silk", "Chiffon", 5},
    {"Silk", "Georgette", 5},
    {"Silk", "Organza", 4},
    {"Silk", "Satin", 4},
    {"Silk", "Crepe / CDC", 2},
    {"Viscose rayon", "Challis", 12},
    {"Viscose rayon", "TRS", 10},
    {"Viscose rayon", "Ponte", 8},
    {"Viscose rayon", "Crepe / CDC", 1.5},
    {"Viscose rayon", "Jersey", 3},
    {"Viscose rayon", "Denim", 0.2},
    {"Viscose rayon", "Dewspo", 0.01},
    {"Viscose rayon", "Ripstop", 0.02},
    {"Nylon", "Dewspo", 6},
    {"Nylon", "Ripstop", 8},
    {"Nylon", "Taffeta", 3},
    {"Nylon", "Memory", 3},
    {"Nylon", "Organza", 2},
    {"Nylon", "Lace", 6},
    {"Nylon", "Mesh / Tulle", 4},
    {"Nylon", "Tricot", 4},
    {"Nylon", "Denim", 0.1},
    {"Nylon", "Flannel", 0.1},
    {"Recycled polyester", "Dewspo", 5},
    {"Recycled nylon", "Ripstop", 5},
    {"Metallic", kAny, 0.2},
    {"Metallic", "Jacquard / Brocade", 5},
    {"Metallic", "Clip jacquard", 5},
    {"Metallic", "Lace", 3},
    {"Metallic", "Mesh / Tulle", 2},
    {"Metallic", "Jacquard knit", 2},
    {"Metallic", "Tweed", 2},

    {kElastane, "Woven", 0.35},
    {kElastane, "Cut & Sew knit", 1.5},
    {kElastane, "Jersey", 3},
    {kElastane, "Rib", 3},
    {kElastane, "Ponte", 6},
    {kElastane, "Neoprene / Scuba", 6},
    {kElastane, "Tricot", 4},
    {kElastane, "TRS", 5},
    {kElastane, "Denim", 1},
    {kElastane, "Satin", 0.6},
    {kElastane, "Vegan leather", 0.5},
    {kElastane, "Chiffon", 0.03},
    {kElastane, "Organza", 0.03},
    {kElastane, "Gauze / Double gauze", 0.03},
});

constexpr bool matches(const Rule& rule, const FabricType& type, const FibreKind& fibre) {
  return (rule.fibre == kAny || rule.fibre == fibre.name) &&
         (rule.where == kAny || rule.where == type.category || rule.where == type.name);
}

}  // namespace

double fibre_affinity(const FabricType& type, const FibreKind& fibre) {
  double weight = 1;
  for (const Rule& rule : kRules)
    if (matches(rule, type, fibre)) weight = rule.weight;
  return weight;
}

}  // namespace drape
