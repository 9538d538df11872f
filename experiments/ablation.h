// What one ingredient (ingredients.h) changes of one drape, and whether the rules behind "auto"
// act where they have to.
//
// The changed drape is followed from the unchanged one, so that the change is the ingredient's and
// not that of a start that happens to end on another branch. A change of the fabric is followed
// along a path of fabrics by continuation (adjoint/fold.h): snaps on the way are counted and what
// they do to the drape coefficient is given apart. Other changes have no path: the changed drape is
// solved from the unchanged one, and counts as followed if the way back leads where it began.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>

#include "core/contact.h"
#include "core/potential.h"
#include "experiments/ingredients.h"

namespace drape {

/// What a silhouette shows.
struct SeenDrape {
  double coefficient;  ///< [per cent]
  VecX profile;        ///< [m]
  int nodes;
};
SeenDrape see(const Scene& scene, const Mesh& mesh, const VecX& x);

/// The fabric with all bending stiffnesses times a factor such that its drape by the protocol, on
/// the coarse mesh, has nearly the drape coefficient asked for [per cent]: the nearest of a
/// bisection, for the coefficient jumps where the protocol's branch changes.
Fabric fabric_of_coefficient(const Settings& settings,
                             const std::shared_ptr<const Discretization>& coarse, double percent);

/// The drape that changes are followed from. Throws std::runtime_error if it is no minimum.
struct UnchangedDrape {
  /// observed: the radii of a photograph of it, if there is one.
  UnchangedDrape(const Settings& settings, std::shared_ptr<const Discretization> discretization,
                 VecX observed = {});

  /// rms distance of the profile of a drape from the photograph's [m].
  double miss(const SeenDrape& drape) const;

  Settings settings;
  VecX observed;         ///< [m], empty without a photograph
  VecX without_contact;  ///< the drape before contact was decided about (3n)
  double penetration;    ///< of that [m]
  Potential potential;   ///< with the support where it acts
  ContactDrape drape;
  SeenDrape seen;
};

/// The change: status, "followed" (the branch was kept, or every snap on the way is known), "snaps"
/// and "snap_change" [points], "change" of the drape coefficient [points] with them, "outline_rms"
/// [m], "node_change" and, where there is a photograph, "miss_change", of the rms distance from it
/// [m]; "cold_change" [points] and "cpu_ratio" of the drape by the protocol.
/// changed: discretization of the changed settings.
nlohmann::ordered_json ablate(const UnchangedDrape& unchanged, const Ingredient& ingredient,
                              std::shared_ptr<const Discretization> changed);

/// The rule of contact = "auto" (more than kAllowedPenetration inside): "acts"; what contact
/// changes; "needed": more than a tolerance. Reads mesh.tolerance and ablation.outline_tolerance.
nlohmann::ordered_json check_contact_rule(const UnchangedDrape& unchanged);

/// The rule of mesh.vertices = "auto", on a ladder up to ablation.largest_vertices: its estimate
/// and the difference from a mesh twice as large as those, on the same branch, in points.
nlohmann::ordered_json check_resolution_rule(const Settings& settings);

}  // namespace drape
