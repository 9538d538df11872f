#include "core/coarse_level.h"

#include <utility>

namespace drape {

std::shared_ptr<const Discretization> make_disc(const Scene& scene, const DiscMeshOptions& options,
                                                FactorBackend backend) {
  return with_coarse_level(make_disc_mesh(scene, options), scene, options, backend);
}

std::shared_ptr<const Discretization> with_coarse_level(Mesh mesh, const Scene& scene,
                                                        DiscMeshOptions options,
                                                        FactorBackend backend) {
  std::shared_ptr<const CoarseLevel> coarse;
  if (2 * mesh.vertex_count() >= 3 * kCoarseVertices) {
    options.vertices = kCoarseVertices;
    Mesh coarse_mesh = make_disc_mesh(scene, options);
    Transfer transfer(coarse_mesh, mesh);
    coarse = std::make_shared<const CoarseLevel>(
        CoarseLevel{std::make_shared<const Discretization>(std::move(coarse_mesh), backend),
                    std::move(transfer)});
  }
  return std::make_shared<const Discretization>(std::move(mesh), backend, std::move(coarse));
}

}  // namespace drape
