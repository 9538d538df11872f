// The unit in which work is reported: one Hessian assembly and one numeric factorisation.
//
// Work in these units hardly depends on the machine. Measured beside the work itself, on one
// thread, because processors change their pace.
#pragma once

#include "core/potential.h"

namespace drape {

/// CPU of one Hessian assembly and one numeric factorisation (CHOLMOD with METIS where built in) on
/// the potential's mesh at x (3n), the best of five [s]. To be called on one thread.
double factorization_unit(const Potential& potential, const VecX& x);

}  // namespace drape
