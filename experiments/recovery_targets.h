// The fabrics whose parameters a recovery is to find, with their drapes.
#pragma once

#include <memory>

#include "core/discretization.h"
#include "core/records.h"
#include "experiments/settings.h"

namespace drape {

/// The `index`-th random target of kind = "estimate": fabrics are drawn from the distribution and
/// draped by the protocol that is its turn until one lies within the ranges of anisotropy and drape
/// coefficient. Depends on experiment.seed and the index alone. A drape that failed is the record
/// of that failure. Throws std::invalid_argument when 500 fabrics drawn all lie outside.
Record random_target(const Settings& settings, std::shared_ptr<const Discretization> discretization,
                     int index);

}  // namespace drape
