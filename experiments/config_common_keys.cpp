#include "experiments/config_key_list.h"

namespace drape {

void add_common_keys(ConfigKeyList& add) {
  add("experiment", "kind", "", kAny, "What to do; the one key that must be given.",
      DRAPE_MEMBER(experiment.kind));
  add("experiment", "seed", "", kNotNegative,
      "Of everything random that has no seed of its own (fabrics, perturbations, noise).",
      DRAPE_MEMBER(experiment.seed));
  add("experiment", "threads", "", kNotNegative,
      "Number of threads; 0 means all. No result depends on it.", DRAPE_MEMBER(experiment.threads));

  for (Parameter p : all_parameters()) {
    const ParameterInfo& about = info(p);
    add.keys.push_back(key("fabric", std::string(about.name),
                           about.unit == "1" ? "" : std::string(about.unit),
                           {about.minimum, about.maximum, about.minimum_allowed},
                           "The fabric's " + std::string(about.meaning) + ".",
                           [p](auto& s) -> decltype(auto) { return s.fabric[p]; }));
  }
  add("fabric", "bending_law", "", kAny,
      "Reading of Eq. 6: scale the tangent stiffness past the threshold (the energy is smooth), or "
      "the secant stiffness (the energy jumps; for comparison).",
      DRAPE_MEMBER(reading.law));
  add("fabric", "bending_threshold", "", kAny,
      "Reading of Eq. 7: as printed (past when cos(delta/2) <= L/(2 R_b)), or by the radius of the "
      "bend (past when sin(delta/2) >= L/(2 R_b)).",
      DRAPE_MEMBER(reading.threshold));

  add("scene", "specimen_radius", "m", kPositive, "Radius of the round specimen.",
      DRAPE_MEMBER(scene.specimen_radius));
  add("scene", "support_radius", "m", kPositive,
      "Radius of the disc that holds the specimen; less than specimen_radius.",
      DRAPE_MEMBER(scene.support_radius));
  add("scene", "gravity", "m/s^2", kPositive, "Acceleration of gravity.",
      DRAPE_MEMBER(scene.gravity));
  add("scene", "column_radius", "m", kNotNegative,
      "Radius of the column below that disc, at most support_radius; 0 for the same.",
      DRAPE_MEMBER(scene.column_radius));
  add("scene", "contact", "", kAny,
      "Contact with the column: \"auto\" solves again with it where a drape is more than 1 mm "
      "inside (branches: never), \"support\" always solves with it, \"off\" only looks.",
      DRAPE_MEMBER(contact));

  add("mesh", "vertices", "", kVertices,
      "Number of vertices aimed at, fixed ring included. \"auto\" (of the kind drape): refined "
      "until the "
      "estimated error of the drape coefficient is within mesh.tolerance.",
      DRAPE_MEMBER(mesh.vertices));
  add("mesh", "tolerance", "points", {0, 100, false},
      "vertices = \"auto\": largest error of the drape coefficient, in points (per cent).",
      DRAPE_MEMBER(mesh.tolerance));
  add("mesh", "kind", "", kAny, "Kind of mesh; isotropic prefers no direction.",
      DRAPE_MEMBER(mesh.kind));
  add("mesh", "seed", "", kNotNegative, "Another seed, another mesh of the same kind.",
      DRAPE_MEMBER(mesh.seed));
  add("mesh", "rotation", "rad", kAny, "Turns the mesh under the fabric.",
      DRAPE_MEMBER(mesh.rotation));
  add("mesh", "clamp_wing_factor", "", kPositive,
      "Weight of the wings on the clamp line; 1 makes the rim too soft.",
      DRAPE_MEMBER(mesh.clamp_wing_factor));
  add("mesh", "clamp_refinement", "", {1, 4, true},
      "Edges at the rim over edges at the clamp, where drapes bend most; 1: all alike.",
      DRAPE_MEMBER(mesh.clamp_refinement));

  add("solver", "tolerance", "", {0, 1, false},
      "Relative residual at rest: largest nodal force over largest nodal weight.",
      DRAPE_MEMBER(solver.tolerance));
  add("solver", "max_iterations", "", at_least(1), "Iterations of one solve at most.",
      DRAPE_MEMBER(solver.max_iterations));
  add("solver", "factorization", "", kAny,
      "Sparse factorisation: CHOLMOD supernodal with METIS, or Eigen's LDLT (slower, for checks).",
      DRAPE_MEMBER(solver.factorization));

  add("start", "protocol", "", kAny,
      "How one of the many equilibria is chosen: gravity ramp from flat on a coarse mesh, a start "
      "folded into lobes, the ramp in careful steps on the mesh itself, a plate lowered from under "
      "it, a given outline, or the lowest in energy of an ensemble of starts.",
      DRAPE_MEMBER(start.protocol));
  add("start", "lobes", "", {1, 60, true}, "Number of lobes of the folded start.",
      DRAPE_MEMBER(start.lobes));
  add("start", "phase", "rad", kAny, "Direction of the first lobe from the weft.",
      DRAPE_MEMBER(start.phase));
  add("start", "seed", "", kNotNegative,
      "Of the small noise that ramp, lowering and ensemble start with.", DRAPE_MEMBER(start.seed));
  add("start", "plate_step", "m", kPositive, "lowering: largest step of the plate.",
      DRAPE_MEMBER(start.plate_step));
  add("start", "outline", "", kAny,
      "guided: CSV of an outline's corners, counter-clockwise, with a first line x,y; in metres, "
      "centred on the support.",
      DRAPE_MEMBER(start.outline));
  add("start", "dataset", "", kAny, "guided: a results.h5 with the outline, instead of a CSV.",
      DRAPE_MEMBER(start.dataset));
  add("start", "record", "", kNotNegative, "guided: which record of that dataset.",
      DRAPE_MEMBER(start.record));
  add("start", "guide", "", kPositive,
      "guided: strengths of the guide, released one after the other; then none.",
      DRAPE_MEMBER(start.guide));
  add("start", "guide_harmonics", "", {1, 180, true},
      "guided: harmonics of the outline's profile that start and guide follow.",
      DRAPE_MEMBER(start.guide_harmonics));
  add("start", "settled", "", kAny,
      "Follow the drape's outline to the drape it leads to, until one is its own: without vertices "
      "popped where they do not belong.",
      DRAPE_MEMBER(start.settled));
  add("start", "ramps", "", kNotNegative, "ensemble: gravity ramps, each with other noise.",
      DRAPE_MEMBER(start.ensemble.ramps));
  add("start", "fewest_lobes", "", {1, 60, true}, "ensemble: folded starts from this many lobes.",
      DRAPE_MEMBER(start.ensemble.fewest_lobes));
  add("start", "most_lobes", "", {1, 60, true}, "ensemble: up to this many.",
      DRAPE_MEMBER(start.ensemble.most_lobes));
  add("start", "phases", "", kNotNegative,
      "ensemble: directions of the first lobe, for each number of lobes.",
      DRAPE_MEMBER(start.ensemble.phases));
  add("start", "flats", "", kNotNegative, "ensemble: flat starts, each with other noise.",
      DRAPE_MEMBER(start.ensemble.flats));
  add("start", "same_distance", "m", kPositive,
      "ensemble: two drapes are the same when no vertex lies further apart.",
      DRAPE_MEMBER(start.ensemble.same_distance));
}

}  // namespace drape
