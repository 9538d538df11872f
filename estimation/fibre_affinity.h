// How readily a fibre goes into a type of fabric: weights for drawing tags.
#pragma once

#include "estimation/fabric_types.h"
#include "estimation/fibre_kinds.h"

namespace drape {

/// Relative to other types, for the same fibre; positive: everything can happen, as the source's
/// vegan leather of pure elastane shows.
double fibre_affinity(const FabricType& type, const FibreKind& fibre);

}  // namespace drape
