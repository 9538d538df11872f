#include "estimation/fibre_kinds.h"

#include <algorithm>
#include <array>

namespace drape {
namespace {

// Counts: Table 2. Shares as the main fibre: assumed, but for the 100 % elastane that the source
// prints for one vegan leather. Moduli: Morton and Hearle, Physical Properties of Textile Fibres,
// Tables 13.1 and 13.2 (initial modulus per tex) times Table 5.1 (density); jute and ramie: npj
// Materials Degradation 2022, s41529-022-00277-7, Table 3; aluminium as metal.
constexpr std::array kKinds = std::to_array<FibreKind>({
    {"Acetate", 14, 0.6, 4.8},
    {"Acrylic", 299, 0.5, 7.4},
    {"Alpaca", 1, 0.5, 3.0},  // modulus of the closest fibre
    {"Aluminium", 3, 0, 76},
    {"Angora", 11, 0.1, 3.0},          // modulus of the closest fibre
    {"Bamboo viscose", 16, 0.7, 7.2},  // modulus of the closest fibre
    {"Camel", 1, 0.5, 2.8},            // modulus of the closest fibre
    {"Cashmere", 5, 0.2, 3.0},         // modulus of the closest fibre
    {"Cation", 3, 0.3, 12.2},          // modulus of the closest fibre
    {"Cork", 2, 1, 0},
    {"Cotton", 1807, 0.8, 7.6},
    {"Cupro", 7, 0.6, 7.2},  // modulus of the closest fibre
    {"EVA", 3, 0.7, 0},
    {"Jute", 2, 0.6, 22.4},
    {"Linen", 163, 0.6, 27.5},
    {"Lyocell", 64, 0.6, 19.7},  // modulus of the closest fibre
    {"Metallic", 129, 0, 0},
    {"Modal", 32, 0.4, 19.7},  // modulus of the closest fibre
    {"Mohair", 2, 0.3, 3.9},   // modulus of the closest fibre
    {"Nylon", 699, 0.45, 3.0},
    {"Organic cotton", 2, 0.8, 7.6},  // modulus of the closest fibre
    {"PE", 31, 0.6, 0.9},
    {"PTT", 1, 0.3, 0},
    {"PVC", 23, 0.9, 4.9},
    {"Pima cotton", 5, 0.8, 11.1},  // modulus of the closest fibre
    {"Polyester", 3069, 0.72, 14.7},
    {"Ramie", 3, 0.5, 21.9},
    {"Recycled nylon", 8, 0.7, 3.0},        // modulus of the closest fibre
    {"Recycled polyester", 34, 0.8, 14.7},  // modulus of the closest fibre
    {"Silk", 60, 0.8, 9.8},
    {"Spandex / Elastane", 1248, 0.005, 0},
    {"Supima cotton", 7, 0.8, 11.1},  // modulus of the closest fibre
    {"TENCEL", 75, 0.7, 19.7},        // modulus of the closest fibre
    {"TPU", 14, 0.7, 0},
    {"Triacetate", 2, 0.7, 4.1},
    {"Viscose rayon", 714, 0.65, 9.7},
    {"Wool", 320, 0.7, 3.0},
});

}  // namespace

std::span<const FibreKind> fibre_kinds() { return kKinds; }

const FibreKind* find_fibre(std::string_view name) {
  const auto found = std::find_if(kKinds.begin(), kKinds.end(),
                                  [name](const FibreKind& kind) { return kind.name == name; });
  return found == kKinds.end() ? nullptr : &*found;
}

}  // namespace drape
