// The unknowns of an estimation: logarithms of the chosen parameters (threshold controls t_b
// linear).
#pragma once

#include <vector>

#include "core/fabric.h"

namespace drape {

/// Maps between a fabric and its vector of unknowns z. Parameters that are not chosen keep the
/// values of `reference`.
struct ParameterSpace {
  std::vector<Parameter> parameters;
  Fabric reference;

  int size() const { return static_cast<int>(parameters.size()); }
  /// z of a fabric: ln p, or p for a threshold control.
  VecX encode(const Fabric& fabric) const;
  /// The fabric of z. Throws std::invalid_argument when z leaves the valid range.
  Fabric decode(const VecX& z) const;
  /// dp/dz at z: p, or 1 for a threshold control.
  VecX derivative(const VecX& z) const;
};

/// Whether a parameter enters by its logarithm.
bool is_logarithmic(Parameter parameter);

}  // namespace drape
