// The scenes of the validation: what the model gives for a bent strip, a hanging strip and a little
// bent annulus, beside the reference solution (references.h).
#pragma once

#include <string>

#include "core/fabric.h"
#include "core/disc_mesh.h"
#include "core/mesh.h"
#include "core/strip_mesh.h"
#include "experiments/references.h"

namespace drape {

/// Rigidity of a mesh bent to a cylinder in the direction at `angle` from u, for wings with both
/// sides bent [N m].
struct CylinderRigidity {
  double bulk;  ///< energy of the wings over their own area, a third of their two triangles'
  double mean;  ///< over the area of the mesh: less, where sides lack wings across them
};
CylinderRigidity cylinder_rigidity(const Mesh& mesh, const Fabric& fabric, double angle);

/// A number of the model beside the reference's.
struct Comparison {
  std::string status;  ///< of the solve; the numbers count only if it is "converged"
  int vertices = 0;
  double rigidity_over_k = 0;       ///< bulk B/k_b of the mesh; 0 where it plays no part
  double mean_rigidity_over_k = 0;  ///< CylinderRigidity::mean / k_b
  /// Plate: energy of the mesh over that of the plate when the overhang is bent to a constant
  /// radial curvature; less than 1 where the mesh is softer across its circles than in its bulk.
  double radial_energy_ratio = 0;
  double measured = 0, expected = 0;
  double worst_place =
      0;  ///< hanging strip: largest displacement error over the tip's displacement
  double residual = 0, cpu_seconds = 0;

  double error() const { return measured / expected - 1; }
};

/// The strip clamped horizontally, its length `slenderness` times (B/q)^(1/3) with B the bulk
/// rigidity of its mesh: drop of the tip's middle [m]. Bends alike in all directions; density and
/// stretch stiffness of `fabric`.
Comparison cantilever(const StripMeshOptions& strip, Fabric fabric, double slenderness,
                      double gravity);

/// The strip hung up by its clamp: displacement of its lower end relative to a quarter of its
/// length, below which the clamp is not felt [m].
Comparison hanging_strip(const StripMeshOptions& strip, const Fabric& fabric, double gravity);

/// The Cusick specimen so stiff that it sags by less than a thousandth of the overhang: mean sag of
/// the rim [m]. Expected with the mesh's bulk rigidity and nu = -1/3.
Comparison annulus_sag(const DiscMeshOptions& disc);

}  // namespace drape
