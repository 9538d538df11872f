// Settings of a drape that solves in well under a second.
#pragma once

#include "experiments/settings.h"

namespace drape::test {

inline Settings small_drape() {
  Settings settings;
  settings.mesh.vertices = 300;
  settings.mesh.clamp_refinement = 1;
  settings.start.protocol = StartProtocol::lobes;
  settings.start.lobes = 5;
  settings.start.phase = 0.1;
  return settings;
}

}  // namespace drape::test
