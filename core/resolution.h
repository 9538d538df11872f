// How fine a mesh a drape needs: the coarsest of a ladder of meshes whose drape coefficient is
// within a tolerance of the refined one on the same branch.
//
// The start protocol chooses the branch on the first rung; every finer rung starts from the state
// on the one before (transfer.h). With errors of order h^2, that is 1/n, the difference of two
// rungs gives the error of either (Roache 1994, grid convergence index). The hinge energy does not
// converge to one plate under refinement, so a second mesh of each rung, of another seed and 15 %
// larger, says how far the coefficient hangs on the mesh; what refinement does not take away is
// reported, not refined.
#pragma once

#include <cmath>
#include <functional>
#include <string_view>
#include <vector>

#include "core/contact.h"
#include "core/disc_mesh.h"
#include "core/equilibrium.h"
#include "core/potential.h"
#include "core/scene.h"

namespace drape {

struct ResolutionOptions {
  double tolerance = 0.005;  ///< of the drape coefficient, as a fraction
  /// Sizes of the meshes, ascending; the protocol runs on the first.
  std::vector<int> vertices{600, 1000, 2000, 4000, 8000, 16000, 30000};
};

enum class ResolutionStatus {
  within_tolerance,         ///< the estimated error is within the tolerance
  limited_by_mesh_scatter,  ///< the two meshes of a rung differ by more, and finer ones do too
  limited_by_size,          ///< the finest mesh is not fine enough
  limited_by_solver,        ///< the solve on the next mesh failed
};
std::string_view name(ResolutionStatus status);

/// A drape as far as meshes are compared by it.
struct DrapeSeen {
  bool converged = false;
  int vertices = 0;  ///< of the mesh
  double drape_coefficient = 0;
  VecX profile;  ///< [m], kProfileSize values
};

/// Same nodes, and outlines less than 2 mm apart (rms) once one is turned over the other: folds
/// may slide around the disc together, which hardly changes anything where a fabric is isotropic.
bool same_branch(const DrapeSeen& a, const DrapeSeen& b);

/// Coefficients and errors as fractions; NaN where not known.
struct Rung {
  int vertices;
  double drape_coefficient;
  int node_count;
  bool same_branch;  ///< as on the rung before; true on the first
  double estimate;   ///< of the error by refinement, from the neighbouring rungs
  double scatter;    ///< difference from the rung's other mesh
  bool other_mesh_same_branch;
  double cpu_seconds;  ///< of this thread: mesh, transfer and solve, on both meshes

  /// The root of the sum of the squares of estimate and scatter.
  double error() const { return std::hypot(estimate, scatter); }
};

struct Resolution {
  ResolutionStatus status = ResolutionStatus::limited_by_solver;
  int chosen = 0;  ///< index of the rung
  std::vector<Rung> rungs;
};

/// Climbs the ladder as far as needed. `drape_on(rung, other_mesh)` drapes on the mesh of a rung,
/// or on its other mesh from that drape's state; it is called in ascending order. Where a
/// tolerance cannot be kept the finest rung draped is chosen, which need not have converged if it
/// is the first.
Resolution climb(int rung_count, double tolerance,
                 const std::function<DrapeSeen(int rung, bool other_mesh)>& drape_on);

struct ResolvedDrape {
  Potential potential;  ///< on the chosen mesh, with the support where it acts
  ContactDrape drape;   ///< on the chosen mesh; its work is that of the solves that led there
  Resolution resolution;
};

/// Drapes on the coarsest sufficient mesh. `mesh`: its vertices are ignored; `potential_on` makes
/// the potential on a mesh. Throws std::invalid_argument unless the tolerance is positive and there
/// is a size, and like trace_outline.
ResolvedDrape drape_resolved(const Scene& scene, const DiscMeshOptions& mesh,
                             const std::function<Potential(const DiscMeshOptions&)>& potential_on,
                             ContactMode contact,
                             const std::function<Equilibrium(const Potential&)>& protocol,
                             const ResolutionOptions& resolution = {},
                             const EquilibriumOptions& options = {});

}  // namespace drape
