#include "benchmarks/drape_fixture.h"

#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/disc_mesh.h"

namespace drape::bench {
namespace {

SolvedDrape solve(int vertices) {
  Potential potential(disc(vertices), medium_fabric(), {}, kScene.gravity);
  Equilibrium equilibrium = drape_by_lobes(potential, kScene, kLobes, 0.1);
  if (!equilibrium.converged())
    throw std::runtime_error("drape of " + std::to_string(vertices) +
                             " vertices: " + std::string(name(equilibrium.status)));
  Outline outline = trace_outline(potential.mesh(), kScene, equilibrium.x);
  return {std::move(potential), std::move(equilibrium), std::move(outline)};
}

}  // namespace

Fabric medium_fabric() {
  Fabric fabric;
  fabric.k_u = 1500;
  fabric.k_v = 900;
  fabric.k_h = 50;
  fabric.k_bu = 5e-6;
  fabric.k_bv = 3e-6;
  fabric.k_bh = 4e-6;
  fabric.s_bu = fabric.s_bv = fabric.s_bh = 0.6;
  return fabric;
}

std::shared_ptr<const Discretization> disc(int vertices) {
  static std::map<int, std::shared_ptr<const Discretization>> discs;
  auto& disc = discs[vertices];
  if (!disc)
    disc = std::make_shared<const Discretization>(make_disc_mesh(kScene, {.vertices = vertices}));
  return disc;
}

const SolvedDrape& solved_drape(int vertices) {
  static std::map<int, SolvedDrape> drapes;
  auto found = drapes.find(vertices);
  if (found == drapes.end()) found = drapes.emplace(vertices, solve(vertices)).first;
  return found->second;
}

}  // namespace drape::bench
