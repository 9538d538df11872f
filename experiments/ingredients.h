// The ingredients of a drape that an ablation changes one at a time: of the model, of the
// discretisation and of the solver. Each is a change of the settings.
#pragma once

#include <string_view>
#include <vector>

#include "experiments/settings.h"

namespace drape {

/// How the changed drape is reached from the unchanged one.
enum class AblationWay {
  path,       ///< a change of the fabric: along a path of fabrics, snaps noticed
  warm,       ///< a change that has no path: solved from the unchanged drape, there and back
  tolerance,  ///< a looser tolerance: against the minimum of its own basin
};

struct Ingredient {
  std::string_view name;   ///< in configs and results
  std::string_view label;  ///< in figures
  AblationWay way;
  void (*change)(Settings&);  ///< of settings whose mesh.vertices is a count
};

/// In the order of figures.
const std::vector<Ingredient>& ingredients();

}  // namespace drape
