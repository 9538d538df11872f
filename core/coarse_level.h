// The coarse mesh of a specimen, on which a drape chooses its branch, and the way back.
//
// Which of many equilibria a start leads to depends on the mesh as much as on the start. Choosing
// it on one coarse mesh, whatever the resolution asked for, makes drapes of different resolutions
// comparable, and is cheap: the fine mesh sees only the last solve.
#pragma once

#include <memory>

#include "core/discretization.h"
#include "core/disc_mesh.h"
#include "core/transfer.h"

namespace drape {

struct CoarseLevel {
  std::shared_ptr<const Discretization> discretization;
  Transfer transfer;  ///< states on the coarse mesh to states on the fine one
};

/// Vertices of the mesh on which branches are chosen.
inline constexpr int kCoarseVertices = 600;

/// A disc mesh with all that depends on it; from 1.5 times kCoarseVertices on with a coarse level
/// of the same seed, rotation and clamp. Throws like make_disc_mesh.
std::shared_ptr<const Discretization> make_disc(const Scene& scene, const DiscMeshOptions& options,
                                                FactorBackend backend = default_factor_backend());

/// The same for a mesh of the specimen that is there already; `options` are those of the coarse
/// level.
std::shared_ptr<const Discretization> with_coarse_level(
    Mesh mesh, const Scene& scene, DiscMeshOptions options,
    FactorBackend backend = default_factor_backend());

}  // namespace drape
