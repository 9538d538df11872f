// A fabric so soft that its folds swing under the rim of the support: bending length 9 mm.
#pragma once

#include "tests/support/shapes.h"

namespace drape::test {

inline Fabric soft_fabric() {
  Fabric fabric = medium_fabric();
  fabric.k_bu = 4e-7;
  fabric.k_bv = 3e-7;
  fabric.k_bh = 3.5e-7;
  return fabric;
}

}  // namespace drape::test
