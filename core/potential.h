// Total potential energy of a hanging cloth and its derivatives.
//
//   E(x) = sum over triangles (Eqs. 1, 2) + sum over wings (Eqs. 3 to 11)
//          + areal_density g sum_i A_i z_i  [+ a guide, guide.h] [+ a plate, plate.h]
//          [+ contact, support_contact.h]
//
// with A_i the nodal areas. Fixed vertices have no unknowns: their rows of a gradient are zero.
// Evaluations are serial, several elements at a time (lanes.h): drapes are parallel over fabrics,
// and sums have one order whatever the number of threads.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/batched_bending.h"
#include "core/batched_membrane.h"
#include "core/bending.h"
#include "core/discretization.h"
#include "core/fabric.h"
#include "core/guide.h"
#include "core/membrane.h"
#include "core/plate.h"
#include "core/support_contact.h"
#include "core/types.h"

namespace drape {

class Potential {
 public:
  /// Throws std::invalid_argument for an invalid fabric or a gravity that is not finite and >= 0.
  Potential(std::shared_ptr<const Discretization> discretization, const Fabric& fabric,
            BendingReading reading, double gravity);

  const Discretization& discretization() const { return *discretization_; }
  std::shared_ptr<const Discretization> shared_discretization() const { return discretization_; }
  const Mesh& mesh() const { return discretization_->mesh(); }
  const Fabric& fabric() const { return fabric_; }
  BendingReading reading() const { return reading_; }
  double gravity() const { return gravity_; }

  void set_fabric(const Fabric& fabric);
  void set_gravity(double gravity);
  void set_guide(std::optional<Guide> guide) { guide_ = std::move(guide); }
  const std::optional<Guide>& guide() const { return guide_; }
  void set_plate(const std::optional<Plate>& plate) { plate_ = plate; }
  const std::optional<Plate>& plate() const { return plate_; }
  void set_support(const std::optional<SupportContact>& support) { support_ = support; }
  const std::optional<SupportContact>& support() const { return support_; }

  /// x: 3n. Energy [J]; not finite for a collapsed triangle.
  double energy(const VecX& x) const;

  /// dE/dx (3n) [N].
  VecX gradient(const VecX& x) const;

  /// Both at once, for little more than the gradient alone; gradient: resized to 3n.
  double energy_and_gradient(const VecX& x, VecX& gradient) const;

  /// Force of the support on every vertex (3n) [N]; zero where contact is off.
  VecX contact_force(const VecX& x) const;

  /// d2E/dx2 over the unknowns (free order, lower triangle) [N/m]. A matrix that has the sparsity
  /// of Discretization::hessian_pattern already is filled in place. The negative geometric parts
  /// are scaled by 1 - blend: 0 is the true Hessian, 1 a positive semidefinite one for Newton steps
  /// only.
  void hessian(const VecX& x, double blend, SparseMatrix& H) const;

  /// d(dE/dx)/d(parameter) for all parameters in order (3n x 13), at constant x.
  MatX gradient_dfabric(const VecX& x) const;

  /// lambda^T d(dE/dx)/d(parameter) without forming that matrix; lambda: 3n.
  ParameterVector gradient_dfabric_transposed(const VecX& x, const VecX& lambda) const;

  /// Largest weight of a vertex [N], the scale of residuals.
  double largest_nodal_weight() const;
  /// Weight of the free vertices [N].
  double free_weight() const;
  /// Largest nodal force on a free vertex over the largest nodal weight [1]; gradient: 3n.
  double residual(const VecX& gradient) const;
  /// Change of the residual when every coordinate of x moves by one unit in the last place: no
  /// state stored in doubles can be expected to have a smaller residual.
  double rounding_floor(const VecX& x) const;

  /// Number of wings past their bending threshold, and for each wing whether it is.
  int wings_past_threshold(const VecX& x) const;
  std::vector<bool> wing_regimes(const VecX& x) const;

 private:
  Corners3<double> triangle_corners(int triangle, const VecX& x) const;
  Corners4<double> wing_corners(int wing, const VecX& x) const;
  void weigh();
  WingSet wings() const;
  /// The terms of single vertices: weight, guide, plate and support, all in proportion to the areal
  /// density. The gradient is added at free vertices only.
  double vertex_energy(const VecX& x) const;
  void add_vertex_gradient(const VecX& x, VecX& gradient) const;
  void add_vertex_hessian(const VecX& x, double blend, SparseMatrix& H) const;
  VecX vertex_gradient_ddensity(const VecX& x) const;
  double guide_stiffness() const;
  double support_weight(int vertex) const;

  std::shared_ptr<const Discretization> discretization_;
  Fabric fabric_;
  BendingReading reading_;
  double gravity_ = 0;
  std::vector<WingLaw> laws_;              // one a wing
  std::vector<WingLawBatch> law_batches_;  // the same for the batches
  VecX weight_;                            // gradient of the gravity term (3n) [N]
  std::optional<Guide> guide_;
  std::optional<Plate> plate_;
  std::optional<SupportContact> support_;
  Rim rim_;
};

}  // namespace drape
