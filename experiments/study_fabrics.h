// The fabrics of the mesh studies: three stiff, three medium and three soft ones, of each the first
// bending alike in all directions, the second and third anisotropic.
#pragma once

#include <string>

#include "core/fabric.h"

namespace drape {

inline constexpr int kStudyFabrics = 9;

struct StudyFabric {
  std::string softness;  ///< "stiff", "medium" or "soft"
  bool isotropic;        ///< in bending and stretch
  Fabric fabric;
};

/// index in [0, kStudyFabrics): stiff, medium, soft in turn. Flexural rigidities about 6e-5, 1.2e-5
/// and 3e-6 N m at 0.2 kg/m^2, within the 5 to 95 % of measured fabrics.
StudyFabric study_fabric(int index);

}  // namespace drape
