// The fabrics whose parameters a recovery is to find, with their drapes.
#pragma once

#include <memory>
#include <vector>

#include "core/discretization.h"
#include "core/random.h"
#include "core/records.h"
#include "estimation/tag.h"
#include "experiments/settings.h"

namespace drape {

/// Random targets of kind = "estimate": fabrics are drawn from the distribution and draped by the
/// protocol that is their turn until one lies within the ranges of anisotropy and drape
/// coefficient.
class RandomTargets {
 public:
  RandomTargets(const Settings& settings, std::shared_ptr<const Discretization> discretization);

  /// Depends on experiment.seed and the index alone. A drape that failed is the record of that
  /// failure. Throws std::invalid_argument when 500 fabrics drawn all lie outside.
  Record operator[](int index) const;

 private:
  /// Tag, if the distribution has them, and parameters; no drape yet.
  Record fabric(Random& random) const;

  const Settings& settings_;
  std::shared_ptr<const Discretization> discretization_;
  std::vector<Tag> tags_;  ///< to draw from; empty unless the distribution is of tags
};

}  // namespace drape
