#include "experiments/model.h"

#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/coarse_level.h"
#include "core/drape_protocol.h"
#include "core/guided.h"
#include "core/lowering.h"
#include "core/outline.h"
#include "core/profile.h"
#include "core/settled.h"
#include "core/version.h"
#include "experiments/config_text.h"
#include "experiments/start_outline.h"

namespace drape {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

DiscMeshOptions mesh_options(const Settings& settings, int vertices) {
  return {.vertices = vertices,
          .seed = settings.mesh.seed,
          .rotation = settings.mesh.rotation,
          .clamp_wing_factor = settings.mesh.clamp_wing_factor,
          .clamp_refinement = settings.mesh.clamp_refinement};
}

Observation nothing_seen(const PixelGrid& grid) {
  return {VecX::Constant(kProfileSize, kNaN), CoverageImage::Zero(grid.rows, grid.columns), kNaN,
          0};
}

}  // namespace

std::shared_ptr<const Discretization> make_discretization(const Settings& settings, int vertices) {
  return make_disc(settings.scene,
                   mesh_options(settings, vertices > 0 ? vertices : settings.mesh.vertices.value()),
                   settings.solver.factorization);
}

Potential make_potential(std::shared_ptr<const Discretization> discretization, const Fabric& fabric,
                         const Settings& settings) {
  return {std::move(discretization), fabric, settings.reading, settings.scene.gravity};
}

EquilibriumOptions equilibrium_options(const Settings& settings) {
  EquilibriumOptions options;
  options.tolerance = settings.solver.tolerance;
  options.max_iterations = settings.solver.max_iterations;
  return options;
}

namespace {

Equilibrium first_drape(const Settings& settings, const Potential& potential) {
  const StartSettings& start = settings.start;
  const EquilibriumOptions options = equilibrium_options(settings);
  switch (start.protocol) {
    case StartProtocol::coarse_ramp:
      return drape_by_coarse_ramp(potential, start.seed, options);
    case StartProtocol::ramp:
      return drape_by_ramp(potential, start.seed, options);
    case StartProtocol::lobes:
      return drape_by_lobes(potential, settings.scene, start.lobes, start.phase, options);
    case StartProtocol::lowering:
      return drape_by_lowering(potential, {.largest_step = start.plate_step, .seed = start.seed},
                               options);
    case StartProtocol::guided:
      return drape_guided(potential, settings.scene,
                          {.radius = harmonics(start_profile(settings), start.guide_harmonics)},
                          start.guide, options);
    case StartProtocol::ensemble:
      return lowest_of_ensemble(potential, settings.scene, ensemble_options(settings), options);
  }
  throw std::logic_error("a start protocol without a function");
}

Equilibrium drape_by_protocol(const Settings& settings, const Potential& potential) {
  Equilibrium drape = first_drape(settings, potential);
  if (!settings.start.settled) return drape;
  return settle(potential, settings.scene, std::move(drape), equilibrium_options(settings));
}

}  // namespace

ContactDrape drape(const Settings& settings, Potential& potential) {
  return drape(settings, potential,
               [&](const Potential& of) { return drape_by_protocol(settings, of); });
}

ContactDrape drape(const Settings& settings, Potential& potential,
                   const std::function<Equilibrium(const Potential&)>& from) {
  return drape_with_contact(potential, settings.scene, settings.contact, from,
                            equilibrium_options(settings));
}

ResolvedDrape drape_resolved(const Settings& settings, int largest_vertices) {
  ResolutionOptions resolution{.tolerance = settings.mesh.tolerance / 100};
  std::erase_if(resolution.vertices, [&](int vertices) { return vertices > largest_vertices; });
  const DiscMeshOptions mesh = mesh_options(settings, resolution.vertices.front());
  return drape_resolved(
      settings.scene, mesh,
      [&](const DiscMeshOptions& size) {
        return make_potential(
            std::make_shared<const Discretization>(make_disc_mesh(settings.scene, size),
                                                   settings.solver.factorization),
            settings.fabric, settings);
      },
      settings.contact, [&](const Potential& of) { return drape_by_protocol(settings, of); },
      resolution, equilibrium_options(settings));
}

EnsembleOptions ensemble_options(const Settings& settings) {
  EnsembleOptions options = settings.start.ensemble;
  options.seed = settings.start.seed;
  return options;
}

PixelGrid observation_grid(const Settings& settings) {
  return centred_grid(settings.dataset.pixels, settings.dataset.image_width);
}

Observation observe(const Scene& scene, const Mesh& mesh, const VecX& x, const PixelGrid& grid) {
  const Points2 outline = trace_outline(mesh, scene, x).points;
  const VecX profile = radial_profile(outline).radius;
  return {profile, coverage(outline, grid), drape_coefficient(scene, area(outline)),
          node_count(profile)};
}

RecordsHeader records_header(const Settings& settings, const Mesh& mesh) {
  RecordsHeader header;
  header.config = write_settings(settings);
  header.seed = settings.experiment.seed;
  header.git_commit = git_commit();
  header.compiler = compiler();
  header.rest_uv = mesh.rest_uv;
  header.triangles = mesh.triangles;
  header.fixed = mesh.fixed;
  header.clamp_wing_factor = mesh.clamp_wing_factor;
  header.scene = settings.scene;
  header.reading = settings.reading;
  header.grid = observation_grid(settings);
  return header;
}

SolveStats solve_stats(const Potential& potential, const Scene& scene,
                       const Equilibrium& equilibrium) {
  SolveStats stats;
  stats.status = name(equilibrium.status);
  stats.protocol = equilibrium.protocol;
  stats.residual_relative = equilibrium.residual;
  stats.rounding_floor = equilibrium.rounding_floor;
  stats.newton_iterations = equilibrium.newton_iterations;
  stats.factorizations = equilibrium.factorizations;
  stats.negative_eigenvalues = equilibrium.negative_eigenvalues;
  stats.wings_past_threshold = potential.wings_past_threshold(equilibrium.x);
  stats.energy = equilibrium.energy;
  stats.cpu_seconds = equilibrium.cpu_seconds;
  Contact contact;
  contact.support = potential.support().has_value();
  stats.contact = contact.acting();
  if (!equilibrium.converged()) return stats;
  contact = check_contact(potential, scene, equilibrium.x);
  stats.self_intersections = contact.self_intersections;
  stats.support_penetration = contact.penetration;
  return stats;
}

void write_contact(nlohmann::ordered_json& summary, const SolveStats& stats,
                   const std::string& reason) {
  using Json = nlohmann::ordered_json;
  const bool checked = stats.self_intersections >= 0;
  summary["contact"] = stats.contact;
  summary["contact_checked"] = checked;
  summary["contact_reason"] = reason;
  summary["support_penetration_mm"] = checked ? Json(1e3 * stats.support_penetration) : Json();
  summary["self_intersections"] = checked ? Json(stats.self_intersections) : Json();
}

Record make_record(const Settings& settings, const Potential& potential,
                   const Equilibrium& equilibrium) {
  if (!equilibrium.converged()) {
    Record record = failed_record(settings, potential.mesh(), potential.fabric(), "");
    record.stats = solve_stats(potential, settings.scene, equilibrium);
    return record;
  }
  Record record;
  record.fabric = potential.fabric();
  record.positions = equilibrium.x;
  if (potential.support()) record.contact_force = potential.contact_force(equilibrium.x);
  record.stats = solve_stats(potential, settings.scene, equilibrium);
  record.observation =
      observe(settings.scene, potential.mesh(), equilibrium.x, observation_grid(settings));
  return record;
}

Record failed_record(const Settings& settings, const Mesh& mesh, const Fabric& fabric,
                     const std::string& status) {
  Record record;
  record.fabric = fabric;
  record.positions = VecX::Constant(3 * mesh.vertex_count(), kNaN);
  record.stats.status = status;
  record.stats.residual_relative = kNaN;
  record.stats.rounding_floor = kNaN;
  record.stats.negative_eigenvalues = -1;
  record.stats.energy = kNaN;
  record.observation = nothing_seen(observation_grid(settings));
  return record;
}

std::string fill_record(Record& record, int index, const std::function<void()>& work) {
  std::string message;
  try {
    work();
  } catch (const std::exception& error) {
    message = record.stats.status = error.what();
  }
  record.id = record.name = std::to_string(index);
  return message;
}

bool converged(const Record& record) {
  return record.stats.status == name(EquilibriumStatus::converged);
}

}  // namespace drape
