#include "experiments/study_fabrics.h"

#include <array>

namespace drape {

StudyFabric study_fabric(int index) {
  constexpr std::array<const char*, 3> kSoftness{"stiff", "medium", "soft"};
  constexpr std::array<double, 3> kBending{1.5e-5, 3e-6, 7.5e-7};  // [N m]
  const auto softness = static_cast<size_t>(index % 3);
  const int variant = index / 3;
  Fabric fabric;
  const double k = kBending[softness];
  fabric.k_bu = fabric.k_bv = fabric.k_bh = k;
  if (variant == 1) {  // a stiff weft
    fabric.k_bu = 1.6 * k;
    fabric.k_bv = 0.7 * k;
    fabric.k_v = 1200;
  } else if (variant == 2) {  // a stiff bias, lighter and easy to shear
    fabric.k_bu = 0.6 * k;
    fabric.k_bv = 0.9 * k;
    fabric.k_bh = 1.4 * k;
    fabric.areal_density = 0.15;
    fabric.k_h = 30;
  }
  return {kSoftness[softness], variant == 0, fabric};
}

}  // namespace drape
