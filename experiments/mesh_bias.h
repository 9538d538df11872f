// Does the mesh choose the drape? The same fabrics on meshes of several seeds, turned under the
// fabric: drape coefficient, nodes and the direction of the folds.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/output_folder.h"
#include "experiments/settings.h"

namespace drape {

/// All drapes, one JSON file each in the subfolder "mesh_bias". Returns early when interrupted.
std::vector<nlohmann::ordered_json> drape_turned_meshes(const Settings& settings,
                                                        const OutputFolder& folder);

/// Per fabric, size and protocol: mean and standard deviation of the drape coefficient (over all,
/// over rotations within a seed, over seeds), histogram of nodes, and two coherences of the
/// direction of the folds over the rotations of one mesh, in [0, 1]: with the fabric's axes, and
/// with the mesh's. A mesh that turns the folds with it has the second near 1.
/// The ramp's noise differs from turn to turn.
nlohmann::ordered_json mesh_bias_table(const std::vector<nlohmann::ordered_json>& drapes);

}  // namespace drape
