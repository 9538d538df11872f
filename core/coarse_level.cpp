#include "core/coarse_level.h"

#include <utility>

namespace drape {

std::shared_ptr<const Discretization> make_disc(const Scene& scene, const DiscMeshOptions& options,
                                                FactorBackend backend) {
  Mesh mesh = make_disc_mesh(scene, options);
  std::shared_ptr<const CoarseLevel> coarse;
  if (2 * options.vertices >= 3 * kCoarseVertices) {
    DiscMeshOptions fewer = options;
    fewer.vertices = kCoarseVertices;
    Mesh coarse_mesh = make_disc_mesh(scene, fewer);
    Transfer transfer(coarse_mesh, mesh);
    coarse = std::make_shared<const CoarseLevel>(
        CoarseLevel{std::make_shared<const Discretization>(std::move(coarse_mesh), backend),
                    std::move(transfer)});
  }
  return std::make_shared<const Discretization>(std::move(mesh), backend, std::move(coarse));
}

}  // namespace drape
