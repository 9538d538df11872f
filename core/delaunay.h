// Delaunay triangulation of points in the plane (Qhull, by lifting to a paraboloid).
#pragma once

#include "core/types.h"

namespace drape {

/// Counter-clockwise triangles. Throws std::runtime_error where Qhull fails (fewer than three
/// points, all on a line, non-finite).
Triangles delaunay(const Points2& points);

}  // namespace drape
