#include "estimation/fabric_types.h"

#include <algorithm>
#include <array>

namespace drape {
namespace {

// Weights: ranges of trade charts (shop and mill pages, widened to hold the fabrics that the source
// prints) but for the lines marked as assumed, for which no chart was found.
constexpr std::array kTypes = std::to_array<FabricType>({
    {"Woven", "Dobby", "Dobby", 236, 0.09, 0.22},                  // assumed
    {"Woven", "Double weave", "Double weave", 69, 0.16, 0.38},     // assumed
    {"Woven", "Eyelet", "Eyelet", 58, 0.09, 0.18},                 // assumed
    {"Woven", "Jacquard", "Clip jacquard", 152, 0.06, 0.2},        // assumed
    {"Woven", "Jacquard", "Jacquard / Brocade", 213, 0.11, 0.32},  // assumed
    {"Woven", "Pile", "Boucle", 19, 0.22, 0.48},                   // assumed
    {"Woven", "Pile", "Corduroy", 135, 0.2, 0.34},
    {"Woven", "Pile", "Velvet / Velveteen", 27, 0.2, 0.38},  // assumed
    {"Woven", "Plain", "Canvas", 26, 0.24, 0.5},
    {"Woven", "Plain", "Challis", 115, 0.1, 0.17},
    {"Woven", "Plain", "Chambray / Oxford", 66, 0.1, 0.19},  // assumed
    {"Woven", "Plain", "Chiffon", 114, 0.03, 0.1},
    {"Woven", "Plain", "Crepe / CDC", 241, 0.07, 0.18},
    {"Woven", "Plain", "Dewspo", 102, 0.045, 0.11},
    {"Woven", "Plain", "Flannel", 167, 0.13, 0.28},              // assumed
    {"Woven", "Plain", "Gauze / Double gauze", 75, 0.07, 0.15},  // assumed
    {"Woven", "Plain", "Georgette", 45, 0.055, 0.13},            // assumed
    {"Woven", "Plain", "Memory", 41, 0.08, 0.17},                // assumed
    {"Woven", "Plain", "Organza", 42, 0.022, 0.06},
    {"Woven", "Plain", "Ottoman", 2, 0.18, 0.35},  // assumed
    {"Woven", "Plain", "Plaid", 52, 0.11, 0.26},
    {"Woven", "Plain", "Plain", 178, 0.1, 0.2},
    {"Woven", "Plain", "Poplin", 58, 0.1, 0.16},
    {"Woven", "Plain", "Taffeta", 40, 0.06, 0.15},  // assumed
    {"Woven", "Plain", "Voile", 45, 0.055, 0.12},
    {"Woven", "Ripstop", "Ripstop", 37, 0.045, 0.18},  // assumed
    {"Woven", "Satin", "Satin", 103, 0.08, 0.19},
    {"Woven", "Seersucker", "Seersucker", 26, 0.09, 0.16},  // assumed
    {"Woven", "TRS", "TRS", 53, 0.17, 0.3},                 // assumed
    {"Woven", "Twill", "Denim", 108, 0.2, 0.44},
    {"Woven", "Twill", "Melton / Boiled", 57, 0.28, 0.7},
    {"Woven", "Twill", "Tweed", 104, 0.22, 0.45},  // assumed
    {"Woven", "Twill", "Twill", 137, 0.15, 0.29},
    {"Cut & Sew knit", "Double", "Double knit / Interlock", 211, 0.18, 0.3},
    {"Cut & Sew knit", "Double", "Neoprene / Scuba", 29, 0.22, 0.468},
    {"Cut & Sew knit", "Double", "Pointelle", 13, 0.12, 0.24},  // assumed
    {"Cut & Sew knit", "Double", "Ponte", 69, 0.23, 0.36},
    {"Cut & Sew knit", "Double", "Quilted knit", 8, 0.22, 0.45},       // assumed
    {"Cut & Sew knit", "Double", "Rib", 131, 0.15, 0.33},              // assumed
    {"Cut & Sew knit", "Double", "Waffle", 24, 0.15, 0.29},            // assumed
    {"Cut & Sew knit", "Jacquard", "Dobby mesh", 4, 0.1, 0.22},        // assumed
    {"Cut & Sew knit", "Jacquard", "Jacquard knit", 264, 0.15, 0.34},  // assumed
    {"Cut & Sew knit", "Pile", "Fleece", 54, 0.22, 0.36},
    {"Cut & Sew knit", "Pile", "French terry", 60, 0.19, 0.36},
    {"Cut & Sew knit", "Pile", "Loop terry", 46, 0.2, 0.42},
    {"Cut & Sew knit", "Pile", "Polar fleece", 30, 0.18, 0.33},         // assumed
    {"Cut & Sew knit", "Pile", "Sherpa", 27, 0.26, 0.48},               // assumed
    {"Cut & Sew knit", "Pile", "Velour", 33, 0.2, 0.33},                // assumed
    {"Cut & Sew knit", "Single", "ITY / Matte jersey", 2, 0.15, 0.24},  // assumed
    {"Cut & Sew knit", "Single", "Jersey", 298, 0.09, 0.22},
    {"Cut & Sew knit", "Texture", "Crepe knit", 20, 0.14, 0.29},     // assumed
    {"Cut & Sew knit", "Texture", "Flatback rib", 21, 0.17, 0.3},    // assumed
    {"Cut & Sew knit", "Texture", "Low gauge knit", 11, 0.18, 0.4},  // assumed
    {"Cut & Sew knit", "Texture", "Pique", 46, 0.17, 0.26},
    {"Cut & Sew knit", "Warp knit", "Crochet", 90, 0.12, 0.35},  // assumed
    {"Cut & Sew knit", "Warp knit", "Lace", 155, 0.06, 0.22},
    {"Cut & Sew knit", "Warp knit", "Mesh / Tulle", 200, 0.025, 0.16},
    {"Cut & Sew knit", "Warp knit", "Tricot", 28, 0.09, 0.22},        // assumed
    {"Cut & Sew knit", "Warp knit", "Velvet", 60, 0.18, 0.34},        // assumed
    {"Animal alternatives", "Vegan fur", "Vegan fur", 43, 0.3, 0.8},  // assumed
    {"Animal alternatives", "Vegan leather", "Vegan leather", 111, 0.23, 0.64},
    {"Animal alternatives", "Vegan suede", "Vegan suede", 35, 0.13, 0.32},  // assumed
    {"Non-fabric", "PVC", "PVC", 63, 0.2, 0.64},
    {"Non-fabric", "Tyvek", "Tyvek", 16, 0.042, 0.105},  // assumed
});

}  // namespace

std::span<const FabricType> fabric_types() { return kTypes; }

const FabricType* find_type(std::string_view name) {
  const auto found = std::find_if(kTypes.begin(), kTypes.end(),
                                  [name](const FabricType& type) { return type.name == name; });
  return found == kTypes.end() ? nullptr : &*found;
}

}  // namespace drape
